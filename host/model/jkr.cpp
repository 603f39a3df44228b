#include "host/model/jkr.h"

#include <algorithm>
#include <cmath>

#include "host/core/vec.h"

namespace vkdose {
namespace {

/// sqrt(a/a0) where the contact is lost: s^3 = 1/6.
const double kLast = std::cbrt(1.0 / 6);

/// s = sqrt(a/a0) on the stable branch of 2 s^4 - 4/3 s = y, from the resolvent cubic of the quartic.
double rootOfPatch(double y) {
    y = std::max(y, -kLast);
    const double u = std::cbrt(2.0 / 9 + std::sqrt(std::max(0.0, 4.0 / 81 + 8.0 / 27 * y * y * y)));
    const double w = 2.0 / 3 * y / u;
    const double alpha = std::sqrt(4.0 / 9 / (u * u + u * w + w * w));
    return (alpha + std::sqrt(std::max(0.0, 4 / (3 * alpha) - alpha * alpha))) / 2;
}

/// Area under the path from the separated spheres, in units of 4 Fc and the length 6^(1/3) delta_c.
double areaAt(double s) {
    const double cube = s * s * s;
    return s * cube * (0.8 * cube * cube - 4.0 / 3 * cube + 1.0 / 3);
}

}  // namespace

JkrContact::JkrContact(const ContactParameters& p, double reduced)
    : modulus(p.modulus),
      size(reduced / 2),
      freeRadius(std::cbrt(9 * kPi * p.surfaceEnergy * size * size / (2 * modulus))),
      pullOff(1.5 * kPi * p.surfaceEnergy * size),
      reach(freeRadius * freeRadius / (2 * std::cbrt(6.0) * size)) {}

double JkrContact::radius(double overlap) const {
    if (freeRadius == 0) return std::sqrt(size * std::max(0.0, overlap));
    const double s = rootOfPatch(2 * size * overlap / (freeRadius * freeRadius));
    return freeRadius * s * s;
}

double JkrContact::force(double overlap) const {
    const double a = radius(overlap);
    if (freeRadius == 0) return 4.0 / 3.0 * modulus * a * a * a / size;
    const double root = std::pow(a / freeRadius, 1.5);
    return 4 * pullOff * root * (root - 1);
}

double JkrContact::energy(double overlap) const {
    const double a = radius(overlap);
    if (freeRadius == 0) return 8.0 / 15.0 * modulus * a * a * a * overlap / size;
    return 4 * pullOff * std::cbrt(6.0) * reach * (areaAt(std::sqrt(a / freeRadius)) - areaAt(kLast));
}

double JkrContact::overlapUnder(double load) const {
    if (freeRadius == 0) return std::pow(load / (4.0 / 3.0 * modulus * std::sqrt(size)), 2.0 / 3.0);
    const double s = std::cbrt((1 + std::sqrt(std::max(0.0, 1 + load / pullOff))) / 2);
    return freeRadius * freeRadius / (2 * size) * (2 * s * s * s * s - 4.0 / 3 * s);
}

}  // namespace vkdose
