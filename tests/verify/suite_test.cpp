// The suite on the reference backend: green with the right physics, red where the physics is wrong.

#include "host/verify/suite.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include "host/backend/reference/reference.h"
#include "host/verify/findings_table.h"
#include "host/verify/setups.h"
#include "tests/support/catch.h"

using namespace vkdose;
using namespace vkdose::verify;

namespace {

/// The reference with something wrong about the world it is given, the rate it turns the coil at, its state after every
/// call, or what it tells.
class Skewed final : public Backend {
  public:
    std::function<void(RuledWorld&)> world = [](RuledWorld&) {};
    double rate = 1;
    std::function<void(Record&)> state;
    std::function<void(Sensors&)> sensors = [](Sensors&) {};

    void load(const World& given, const ContactLaw& law, const Particles& particles) override {
        RuledWorld changed{given, law};
        world(changed);
        sound_->load(changed, particles);
    }
    void setLaw(const ContactLaw& law) override { sound_->setLaw(law); }
    void setGravity(const Vec3& gravity) override { sound_->setGravity(gravity); }
    void addParticles(std::size_t first, const std::vector<Vec3>& positions) override {
        sound_->addParticles(first, positions);
    }
    void setClocks(const std::vector<BodyClock>& clocks) override { sound_->setClocks(clocks); }
    Sensors advance(std::uint32_t steps, double coilRate) override {
        Sensors told = sound_->advance(steps, rate * coilRate);
        if (state) {
            Record record = sound_->snapshot();
            state(record);
            sound_->restore(record);
        }
        sensors(told);
        return told;
    }
    Record snapshot() const override { return sound_->snapshot(); }
    void restore(const Record& record) override { sound_->restore(record); }
    Particles particles() const override { return sound_->particles(); }
    std::vector<FreeBody> freeBodies() const override { return sound_->freeBodies(); }
    std::vector<Contact> contacts() const override { return sound_->contacts(); }
    FieldPoints fields(const FieldRequest& request) override { return sound_->fields(request); }
    double coilAngle() const override { return sound_->coilAngle(); }
    std::string description() const override { return "skewed"; }

  private:
    std::unique_ptr<Backend> sound_ = makeReferenceBackend();
};

/// A change of one parameter of every class.
std::function<void(RuledWorld&)> scaled(double ContactParameters::*parameter, double factor) {
    return [=](RuledWorld& world) {
        for (ContactParameters& p : world.law.pairs) p.*parameter *= factor;
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

namespace {

struct Mutant {
    const char* name;
    std::function<void(RuledWorld&)> world;
    double rate;
    std::set<std::string> fails;  ///< at least these
    const char* spared;           ///< part of the names of cases that must not notice
    std::function<void(Record&)> state = {};
    std::function<void(Sensors&)> sensors = [](Sensors&) {};
};

void asItIs(RuledWorld&) {}

std::vector<Mutant> mutants() {
    return {
        {"friction 5 % up",
         scaled(&ContactParameters::mu, 1.05),
         1,
         {"collisions/oblique-sliding", "sliding/slip-then-roll", "sliding/steep-incline", "coil/pressed-sphere",
          "hertz/oblique", "hertz/oblique-sticking", "hertz/spinning-wall", "hertz/spinning-pair",
          "hertz/spinning-unequal", "hertz/ledger", "eepa/ledger", "jkr/ledger", "increments/turns"},
         "head-on"},
        {"k_c 2 % down",
         scaled(&ContactParameters::kc, 0.98),
         1,
         {"collisions/head-on", "energy/plastic"},
         "integrator"},
        {"the other Coulomb limit",
         [](RuledWorld& w) {
             const bool luding = w.law.between(0, 0).coulombLimit == CoulombLimit::Luding;
             w.law.limitFriction(luding ? CoulombLimit::Absolute : CoulombLimit::Luding);
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
         {"integrator/bounce", "integrator/damped-order", "collisions/head-on-damped", "energy/damping"},
         "oblique"},
        {"k_t 5 % up",
         scaled(&ContactParameters::kt, 1.05),
         1,
         {"collisions/oblique-sticking", "size-ratio/wedge-rest", "hertz/oblique-sticking", "hertz/spinning-wall"},
         "head-on"},
        {"E* 0.5 % up",
         scaled(&ContactParameters::modulus, 1.005),
         1,
         {"hertz/spheres", "hertz/wall", "jkr/path"},
         "collisions/"},
        {"damping of elastic spheres 2 % up",
         scaled(&ContactParameters::dampingShare, 1.02),
         1,
         {"hertz/restitution", "hertz/ledger"},
         "collisions/"},
        {"plasticity ratio 2 % up",
         scaled(&ContactParameters::plasticityRatio, 1.02),
         1,
         {"eepa/path", "eepa/restitution", "eepa/ledger"},
         "hertz/"},
        {"surface energy 5 % up",
         scaled(&ContactParameters::surfaceEnergy, 1.05),
         1,
         {"eepa/path", "eepa/restitution", "jkr/path", "jkr/restitution", "jkr/ledger"},
         "eepa/ledger"},
        {"constant pull 5 % up",
         scaled(&ContactParameters::constantPull, 1.05),
         1,
         {"eepa/path", "eepa/restitution"},
         "eepa/ledger"},
        {"a pull that fades sooner",
         scaled(&ContactParameters::adhesionExponent, 1.2),
         1,
         {"eepa/path", "eepa/restitution"},
         "eepa/ledger"},
        {"a parameter of a user's law 2 % up",
         [](RuledWorld& w) {
             if (w.law.user)
                 for (ContactParameters& p : w.law.pairs) p.own[1] *= 1.02;
         },
         1,
         {"user-law/memory", "user-law/reach"},
         "hertz/"},
        {"what flows by a user's law 2 % up",
         [](RuledWorld& w) {
             if (!w.properties.empty())
                 for (ContactParameters& p : w.law.pairs) p.own[2] *= 1.02;
         },
         1,
         {"user-law/flow"},
         "user-law/reach"},
        {"sliding springs that grow",
         asItIs,
         1,
         {"energy/grazing"},
         "integrator",
         [](Record& r) {
             const std::size_t contacts = r.get<std::uint32_t>("contact_ends").size() / 3;
             std::vector<double> numbers = r.get<double>("contact_numbers");
             for (std::size_t c = 0; c < contacts; ++c)
                 for (std::size_t d = 1; d < 4; ++d) numbers[numbers.size() / contacts * c + d] *= 1.2;
             r.put("contact_numbers", std::move(numbers));
         }},
        {"rolling friction 5 % up", scaled(&ContactParameters::muR, 1.05), 1, {"rolling/resistance"}, "sliding/"},
        {"torsion friction 5 % up", scaled(&ContactParameters::muTo, 1.05), 1, {"torsion/spin-decay"}, "rolling"},
        {"torsion stiffness 5 % up", scaled(&ContactParameters::kTo, 1.05), 1, {"torsion/spin-decay"}, "rolling"},
        {"the wrong rolling lever",
         [](RuledWorld& w) {
             w.law.rollingLever = w.law.rollingLever == RollingLever::Full ? RollingLever::Half : RollingLever::Full;
         },
         1,
         {"rolling/resistance", "torsion/spin-decay"},
         "head-on"},
        {"gravity 1 % up",
         [](RuledWorld& w) { w.gravity *= 1.01; },
         1,
         {"integrator/free-fall", "integrator/bounce", "increments/falls", "increments/works", "sliding/steep-incline",
          "bed/column", "bed/weight", "rolling/gentle-incline", "size-ratio/roll-off", "size-ratio/wedge-rest",
          "size-ratio/neck"},
         "head-on"},
        {"the coil 1 % fast", asItIs, 1.01, {"coil/pressed-sphere", "coil/pushed-sphere"}, "rolling"},
        {"a coil of the other hand",
         [](RuledWorld& w) {
             if (w.coil) w.coil->hand = -1;
         },
         1,
         {"coil/pressed-sphere", "coil/pushed-sphere"},
         "rolling"},
        {"bodies that turn 1 % faster",
         [](RuledWorld& w) {
             for (RigidBody& body : w.bodies)
                 if (auto* turn = std::get_if<geometry::Turn>(&body.course.motion)) turn->rate *= 1.01;
         },
         1,
         {"bodies/drum-balance", "bodies/pushed-sphere", "bodies/held-sphere"},
         "rolling"},
        {"a period 1 % longer than the domain",
         [](RuledWorld& w) { w.period *= 1.01; },
         1,
         {"period/rebound", "period/incline"},
         "rolling"},
        {"a domain that does not repeat",
         [](RuledWorld& w) {
             if (w.repeats()) w.domain = {Vec3(-1), Vec3(1)};
             w.period = Vec3(0);
         },
         1,
         {"period/rebound", "period/momentum", "period/incline", "period/screw"},
         "rolling"},
        {"bodies that move freely 1 % heavier",
         [](RuledWorld& w) {
             for (RigidBody& body : w.bodies)
                 if (auto* free = std::get_if<geometry::Free>(&body.course.motion)) free->mass *= 1.01;
         },
         1,
         {"bodies/free-ball", "bodies/driven"},
         "drum"},
        {"forces that drive bodies 1 % larger",
         [](RuledWorld& w) {
             for (RigidBody& body : w.bodies)
                 if (auto* free = std::get_if<geometry::Free>(&body.course.motion))
                     for (geometry::Free::Row& row : free->rows) row.force *= 1.01;
         },
         1,
         {"bodies/driven"},
         "bodies/free-ball"},
        {"bodies on a hinge with 1 % more inertia",
         [](RuledWorld& w) {
             for (RigidBody& body : w.bodies)
                 if (auto* hinge = std::get_if<geometry::Hinge>(&body.course.motion)) hinge->inertia *= 1.01;
         },
         1,
         {"bodies/hinged-ball", "bodies/hinge"},
         "bodies/driven"},
        {"every body twice, so that spheres touch it twice",
         [](RuledWorld& w) {
             const std::vector<RigidBody> once = w.bodies;
             w.bodies.insert(w.bodies.end(), once.begin(), once.end());
         },
         1,
         {"bodies/mesh-incline", "bodies/mesh-block"},
         "rolling"},
        {"density 1 % up",
         [](RuledWorld& w) { w.density() *= 1.01; },
         1,
         {"collisions/head-on", "bed/weight", "energy/friction", "energy/cluster"},
         "free-fall"},
        {"the second powder 2 % heavier",
         [](RuledWorld& w) {
             if (w.materials.size() > 3) w.density(3) *= 1.02;
         },
         1,
         {"materials/hertz", "materials/luding", "materials/cluster"},
         "head-on"},
        {"every pair as the first powder's",
         [](RuledWorld& w) {
             for (int m = 3; m < int(w.materials.size()); ++m) w.law.between(0, m) = w.law.between(0, 0);
         },
         1,
         {"materials/hertz", "materials/luding", "materials/sliding"},
         "head-on"},
        {"one floor as another",
         [](RuledWorld& w) {
             for (Wall& wall : w.walls) wall.material = kWallMaterial;
         },
         1,
         {"materials/sliding"},
         "materials/cluster"},
        {"a wire 2 % thicker",
         [](RuledWorld& w) {
             if (w.coil) w.coil->wireRadius *= 1.02;
         },
         1,
         {"coil/empty-canister", "coil/pressed-sphere"},
         "rolling"},
        {"a hundred thousandth of gravity where there is none",
         [](RuledWorld& w) {
             if (w.gravity == Vec3(0)) w.gravity = Vec3(0, -1e-4, 0);
         },
         1,
         {"momentum/cluster"},
         "rolling"},
        {"contacts that should stick slip",
         [](RuledWorld& w) {
             for (ContactParameters& p : w.law.pairs) p.mu = std::min(p.mu, 0.2);
         },
         1,
         {"size-ratio/wedge-bounce", "size-ratio/wedge-rest", "size-ratio/neck", "collisions/oblique-sticking",
          "increments/stretches"},
         "steep-incline"},
        {"a time step four times as long as said",
         [](RuledWorld& w) { w.timeStep *= 4; },
         1,
         {"size-ratio/wedge-bounce", "energy/cluster", "bodies/merging"},
         "column"},
        {"neither friction nor rolling friction",
         [](RuledWorld& w) {
             for (ContactParameters& p : w.law.pairs) p.mu = p.muR = 0;
         },
         1,
         {"bed/heap", "bed/weight", "rolling/gentle-incline", "energy/friction"},
         "head-on"},
        {"a drive that is hard to turn by itself",
         asItIs,
         1,
         {"coil/empty-canister"},
         "rolling",
         {},
         [](Sensors& s) { s.coilTorque += 1e-15; }},
        {"spins that fade by a ten thousandth a call",
         asItIs,
         1,
         {"momentum/cluster"},
         "head-on",
         [](Record& record) {
             std::vector<double> spins = record.get<double>("spin");
             for (double& w : spins) w *= 1 - 1e-4;
             record.put("spin", std::move(spins));
         }},
        {"a book that forgets what slipping takes",
         asItIs,
         1,
         {"energy/friction", "energy/cluster"},
         "momentum",
         {},
         [](Sensors& s) {
             if (s.energy) s.energy->sliding = 0;
         }},
        {"a book that forgets a hundredth of what rolling takes",
         asItIs,
         1,
         {"energy/cluster"},
         "energy/friction",
         {},
         [](Sensors& s) {
             if (s.energy) s.energy->rolling *= 0.99;
         }},
    };
}

std::set<std::string> failingWith(const Mutant& mutant, const std::string& part) {
    Skewed backend;
    backend.world = mutant.world;
    backend.rate = mutant.rate;
    backend.state = mutant.state;
    backend.sensors = mutant.sensors;
    return failing(backend, part);
}

}  // namespace

TEST_CASE("the wrong physics fails the cases that are about it, and those it has no part in still pass") {
    for (const Mutant& mutant : mutants()) {
        CAPTURE(mutant.name);
        for (const std::string& name : mutant.fails) {
            CAPTURE(name);
            CHECK_FALSE(failingWith(mutant, name).empty());
        }
        CHECK(failingWith(mutant, mutant.spared).empty());
    }
}

TEST_CASE("every case has a mutant that it must fail") {
    std::set<std::string> judged;
    for (const Mutant& mutant : mutants()) judged.insert(mutant.fails.begin(), mutant.fails.end());
    for (const Scene& scene : scenes()) {
        CAPTURE(scene.name);
        CHECK(judged.count(scene.name) == 1);
    }
}
