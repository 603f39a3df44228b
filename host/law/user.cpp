// The closed forms of a user's law. Its contacts act like springs and dashpots as stiff and as strong as its trial
// found them (user_law_trial.h).
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "host/law/impact.h"
#include "host/law/law_keys.h"

namespace vkdose {
namespace {

class User : public Law {
  public:
    NormalLaw kind() const override { return NormalLaw::User; }
    std::string_view word() const override { return "NAME.glsl"; }
    std::string_view meaning() const override { return ""; }
    std::vector<LawKey> keys() const override {
        return {{kSlidingStiffnessKey, &ContactParameters::kt}, {kSlidingDampingKey, &ContactParameters::gammaT}};
    }

    ContactParameters linearised(const ContactParameters& p, double /*mass*/, double /*reduced*/,
                                 double /*overlap*/) const override {
        ContactParameters linear = p;
        linear.law = NormalLaw::Luding;
        scaleSliders(linear, p.k2Max, p.gamma);
        return linear;
    }
    double reach(const ContactParameters& p, double /*reduced*/) const override { return p.reach; }
    double overlapUnder(const ContactParameters& p, double /*reduced*/, double load) const override {
        return load / p.k1;
    }
    double overlapOfImpact(const ContactParameters& p, double mass, double /*reduced*/, double speed) const override {
        return speed * std::sqrt(mass / p.k1);
    }
    double restitution(const ContactParameters& p, double mass) const override {
        return restitutionOf(p.gamma / (2 * std::sqrt(p.k1 * mass)));
    }
    /// Nobody knows.
    double pullOff(const ContactParameters& /*p*/, double /*reduced*/, double /*maxOverlap*/) const override {
        return std::numeric_limits<double>::quiet_NaN();
    }
    LawLanes lanes(const ContactParameters& p) const override {
        return {{std::min(mostStiffness(p), double(std::numeric_limits<float>::max()))}, p.reach, p.gamma};
    }

    NormalAnswer answer(const ContactParameters& /*p*/, double /*overlap*/, double /*reduced*/, double /*mass*/,
                        double& /*memory*/) const override {
        throw std::logic_error("the answer of a user's law is its program's");
    }
    double stored(const ContactParameters& /*p*/, double /*overlap*/, double /*reduced*/, double /*force*/,
                  double /*memory*/) const override {
        throw std::logic_error("what a user's law stores its program says");
    }
    /// What it took and did not store, it lost: nobody else can say.
    double lost(const NormalStep& step) const override { return step.taken - step.gained; }
};

}  // namespace

double mostStiffness(const ContactParameters& p) {
    constexpr double kFactor = 1000;
    return p.kMost > 0 ? kFactor * p.kMost : std::numeric_limits<double>::infinity();
}

const Law& userLaw() {
    static const User kLaw;
    return kLaw;
}

}  // namespace vkdose
