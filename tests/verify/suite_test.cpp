// The suite on the reference backend: green with the right physics, red where the physics is wrong.

#include "host/verify/suite.h"

#include <functional>
#include <set>

#include "host/backend/reference/reference.h"
#include "host/verify/table.h"
#include "tests/support/catch.h"

using namespace vkdose;
using namespace vkdose::verify;

namespace {

/// The reference with something wrong about the world it is given or the rate it turns the coil at.
class Skewed final : public Backend {
  public:
    std::function<void(World&)> world = [](World&) {};
    double rate = 1;

    void load(const World& given, const Particles& particles) override {
        World changed = given;
        world(changed);
        sound_->load(changed, particles);
    }
    void setLaw(const ContactLaw& law) override { sound_->setLaw(law); }
    Sensors advance(std::uint32_t steps, double coilRate) override { return sound_->advance(steps, rate * coilRate); }
    Record snapshot() const override { return sound_->snapshot(); }
    void restore(const Record& record) override { sound_->restore(record); }
    Particles particles() const override { return sound_->particles(); }
    std::vector<Contact> contacts() const override { return sound_->contacts(); }
    FieldPoints fields(const FieldRequest& request) override { return sound_->fields(request); }
    double coilAngle() const override { return sound_->coilAngle(); }
    std::string description() const override { return "skewed"; }

  private:
    std::unique_ptr<Backend> sound_ = makeReferenceBackend();
};

/// A change of one parameter of every class.
std::function<void(World&)> scaled(double ContactParameters::*parameter, double factor) {
    return [=](World& world) {
        for (ContactParameters& p : world.law.classes) p.*parameter *= factor;
    };
}

/// The cases whose name contains `part` that fail on this backend.
std::set<std::string> failing(Backend& backend, const std::string& part) {
    std::set<std::string> names;
    for (const Scene& scene : scenesNamed(part))
        if (failures(play(scene, backend)) > 0) names.insert(scene.name);
    return names;
}

}  // namespace

TEST_CASE("the suite passes on the reference") {
    const auto backend = makeReferenceBackend();
    for (const Scene& scene : scenes())
        for (const Check& check : play(scene, *backend)) {
            INFO(tableLine(check));
            CHECK(check.passes());
        }
}

TEST_CASE("the wrong physics fails the cases that are about it, and those it has no part in still pass") {
    struct Mutant {
        const char* name;
        std::function<void(World&)> world;
        double rate;
        std::set<std::string> fails;  ///< at least these
        const char* spared;           ///< part of the names of cases that must not notice
    };
    const Mutant mutants[] = {
        {"friction 5 % up",
         scaled(&ContactParameters::mu, 1.05),
         1,
         {"collisions/oblique-sliding", "sliding/slip-then-roll", "sliding/steep-incline", "coil/pressed-sphere"},
         "head-on"},
        {"k_c 2 % down",
         scaled(&ContactParameters::kc, 0.98),
         1,
         {"collisions/head-on", "energy/plastic"},
         "integrator"},
        {"the other Coulomb limit",
         [](World& w) {
             w.law.coulombLimit =
                 w.law.coulombLimit == CoulombLimit::Luding ? CoulombLimit::Absolute : CoulombLimit::Luding;
         },
         1,
         {"sliding/coulomb-limit"},
         "integrator"},
        {"k_1 1 % up",
         scaled(&ContactParameters::k1, 1.01),
         1,
         {"integrator/elastic-order", "collisions/head-on", "coil/pressed-sphere", "bed/column"},
         "torsion"},
        {"phi_f 1 % up", scaled(&ContactParameters::plasticityDepth, 1.01), 1, {"collisions/head-on"}, "sliding/"},
        {"damping 5 % up",
         scaled(&ContactParameters::gamma, 1.05),
         1,
         {"integrator/bounce", "collisions/head-on-damped", "energy/damping"},
         "oblique"},
        {"k_t 5 % up", scaled(&ContactParameters::kt, 1.05), 1, {"collisions/oblique-sticking"}, "head-on"},
        {"rolling friction 5 % up", scaled(&ContactParameters::muR, 1.05), 1, {"rolling/resistance"}, "sliding/"},
        {"torsion friction 5 % up", scaled(&ContactParameters::muTo, 1.05), 1, {"torsion/spin-decay"}, "rolling"},
        {"torsion stiffness 5 % up", scaled(&ContactParameters::kTo, 1.05), 1, {"torsion/spin-decay"}, "rolling"},
        {"the wrong rolling lever",
         [](World& w) {
             w.law.rollingLever = w.law.rollingLever == RollingLever::Full ? RollingLever::Half : RollingLever::Full;
         },
         1,
         {"rolling/resistance", "torsion/spin-decay"},
         "head-on"},
        {"gravity 1 % up",
         [](World& w) { w.gravity *= 1.01; },
         1,
         {"integrator/free-fall", "integrator/bounce", "sliding/steep-incline", "bed/column", "bed/weight",
          "size-ratio/roll-off"},
         "head-on"},
        {"the coil 1 % fast", [](World&) {}, 1.01, {"coil/pressed-sphere", "coil/pushed-sphere"}, "rolling"},
        {"a coil of the other hand",
         [](World& w) {
             if (w.coil) w.coil->hand = -1;
         },
         1,
         {"coil/pressed-sphere", "coil/pushed-sphere"},
         "rolling"},
        {"density 1 % up", [](World& w) { w.density *= 1.01; }, 1, {"collisions/head-on", "bed/weight"}, "free-fall"},
    };
    for (const Mutant& mutant : mutants) {
        Skewed backend;
        backend.world = mutant.world;
        backend.rate = mutant.rate;
        CAPTURE(mutant.name);
        for (const std::string& name : mutant.fails) {
            CAPTURE(name);
            CHECK_FALSE(failing(backend, name).empty());
        }
        CHECK(failing(backend, mutant.spared).empty());
    }
}

TEST_CASE("friction makes the heap: without it the check fails") {
    Skewed backend;
    backend.world = [](World& w) {
        for (ContactParameters& p : w.law.classes) p.mu = p.muR = 0;
    };
    CHECK(failing(backend, "bed/heap").size() == 1);
    CHECK(failing(backend, "bed/weight").size() == 1);
}
