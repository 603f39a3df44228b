#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "host/law/law.h"

namespace vkdose {

#define LAW(number, Name, name, reaches, stiffens, keepsOverlap) const Law& name##Law();
#include "shaders/shared/laws.h"
const Law& userLaw();

std::span<const Law* const> laws() {
    static const Law* const kLaws[] = {
#define LAW(number, Name, name, reaches, stiffens, keepsOverlap) &name##Law(),
#include "shaders/shared/laws.h"
    };
    return kLaws;
}

const Law& normalLaw(NormalLaw kind) {
    switch (kind) {
#define LAW(number, Name, name, reaches, stiffens, keepsOverlap) \
    case NormalLaw::Name:                                        \
        return name##Law();
#include "shaders/shared/laws.h"
        case NormalLaw::User:
            return userLaw();
    }
    throw std::logic_error("no law has this number");
}

double Law::overlapOfStrongestPull(const ContactParameters& /*p*/, double /*reduced*/) const {
    return std::numeric_limits<double>::infinity();
}

double Law::lost(const NormalStep& step) const {
    if (!step.touched) return step.arriving - step.gained;
    if (!step.touches) return -step.forceBefore * step.overlapBefore / 2 - step.gained;
    return step.taken - step.gained;
}

void scaleSliders(ContactParameters& p, double k, double gamma) {
    for (double ContactParameters::*stiffness :
         {&ContactParameters::kt, &ContactParameters::kr, &ContactParameters::kTo})
        p.*stiffness *= k;
    for (double ContactParameters::*damping :
         {&ContactParameters::gammaT, &ContactParameters::gammaR, &ContactParameters::gammaTo})
        p.*damping *= gamma;
}

double reducedSize(double a, double b) {
    return std::isinf(b) ? 2 * a : 2 * a * b / (a + b);
}

double pullOffUnder(const ContactParameters& p, double reduced, double load) {
    const Law& law = normalLaw(p);
    return law.pullOff(p, reduced,
                       std::isinf(load) ? law.overlapOfStrongestPull(p, reduced) : law.overlapUnder(p, reduced, load));
}

double springsKept(double was, double is) {
    return was > 0 && was < is ? was / is : 1;
}

double springsKept(const ContactParameters& p, double reduced, double mass, double before, double now) {
    constexpr unsigned kStiffening = 0U  // bit k: the overlap makes the springs of the law k stiffer
#define LAW(number, Name, name, reaches, stiffens, keepsOverlap) | unsigned(stiffens) << unsigned(number)
#include "shaders/shared/laws.h"
        ;
    if ((kStiffening >> unsigned(p.law) & 1U) == 0) return 1;
    const Law& law = normalLaw(p);
    const double was = law.linearised(p, mass, reduced, before).k1, is = law.linearised(p, mass, reduced, now).k1;
    return was < is ? was / is : 1;
}

}  // namespace vkdose
