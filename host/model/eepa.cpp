#include "host/model/eepa.h"

#include <algorithm>
#include <cmath>

#include "host/core/vec.h"

namespace vkdose {
namespace {

double threeHalves(double x) {
    return std::pow(x, 1.5);
}

}  // namespace

EepaPath eepaPath(const ContactParameters& p, double reduced, double maxOverlap) {
    EepaPath path{};
    path.constant = -p.constantPull;
    path.unloading = 4.0 / 3.0 * p.modulus * std::sqrt(reduced / 2) / (1 - p.plasticityRatio);
    path.flattened = std::cbrt(p.plasticityRatio * p.plasticityRatio) * maxOverlap;
    const double patch = std::sqrt(path.flattened * std::max(0.0, reduced - path.flattened));
    // The unloading line must meet the adhesive branch before the contact opens: at half of delta_p^(3/2) at the least.
    const double most = path.unloading * threeHalves(path.flattened) / 2;
    path.pull = std::min(1.5 * kPi * p.surfaceEnergy * patch, most);
    path.pole = std::cbrt(std::pow(threeHalves(path.flattened) - path.pull / path.unloading, 2));
    path.exponent = p.adhesionExponent;
    return path;
}

double EepaPath::force(double overlap) const {
    if (overlap < pole) return constant - pullAt(overlap);
    return constant + unloading * (threeHalves(overlap) - threeHalves(flattened));
}

double EepaPath::pullAt(double overlap) const {
    return pull > 0 ? pull * std::pow(overlap / pole, exponent) : 0;
}

double EepaPath::energy(double overlap) const {
    const double adhesive = std::min(overlap, pole);
    const double opening = -pullAt(adhesive) * adhesive / (exponent + 1);
    const auto area = [&](double x) { return x * (0.4 * threeHalves(x) - threeHalves(flattened)); };
    return constant * overlap + opening + unloading * (area(std::max(overlap, pole)) - area(pole));
}

}  // namespace vkdose
