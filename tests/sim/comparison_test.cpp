// The comparison on real physics: the reference agrees with itself; a backend that is a little wrong does not.

#include "host/sim/comparison.h"

#include "host/backend/reference/reference.h"
#include "tests/support/catch.h"

using namespace vkdose;

namespace {

/// Passes everything on to a reference, with something changed in the world.
class Wrong : public Backend {
  public:
    explicit Wrong(std::function<void(RuledWorld&)> change)
        : change_(std::move(change)), inner_(makeReferenceBackend()) {}
    void load(const World& world, const ContactLaw& law, const Particles& p) override {
        RuledWorld w{world, law};
        change_(w);
        inner_->load(w, p);
    }
    void setLaw(const ContactLaw& law) override {
        RuledWorld w{{}, law};
        change_(w);
        inner_->setLaw(w.law);
    }
    void setGravity(const Vec3& gravity) override { inner_->setGravity(gravity); }
    void addParticles(std::size_t first, const std::vector<Vec3>& positions) override {
        inner_->addParticles(first, positions);
    }
    void setClocks(const std::vector<BodyClock>& clocks) override { inner_->setClocks(clocks); }
    Sensors advance(std::uint32_t n, double rate) override { return inner_->advance(n, rate); }
    Record snapshot() const override { return inner_->snapshot(); }
    void restore(const Record& record) override { inner_->restore(record); }
    Particles particles() const override { return inner_->particles(); }
    std::vector<FreeBody> freeBodies() const override { return inner_->freeBodies(); }
    std::vector<Contact> contacts() const override { return inner_->contacts(); }
    FieldPoints fields(const FieldRequest& request) override { return inner_->fields(request); }
    double coilAngle() const override { return inner_->coilAngle(); }
    std::string description() const override { return "wrong"; }

  private:
    std::function<void(RuledWorld&)> change_;
    std::unique_ptr<Backend> inner_;
};

/// Eleven soft spheres fall a radius onto a plate, some onto each other.
Case fallingSpheres() {
    Case c;
    c.name = "falling";
    c.world.density() = 1500;
    c.world.timeStep = 1e-5;
    c.world.skin = 2e-4;
    c.world.domain = {Vec3(-1), Vec3(1)};
    c.world.walls.push_back(geometry::Plane{Vec3(0), Vec3(0, 1, 0)});
    for (ContactParameters& p : c.dosingLaw.pairs) {
        p.k1 = 400;
        p.k2Max = 2000;
        p.kc = 100;
        p.plasticityDepth = 0.05;
        p.gamma = 0.01;
        p.kt = 500;
        p.gammaT = 0.003;
        p.mu = 0.4;
        p.kr = 500;
        p.gammaR = 0.003;
        p.muR = 0.2;
    }
    c.settlingLaw = c.dosingLaw;
    c.schedule.settleTime = 0.04;
    c.sensorInterval = 0.01;
    Particles p;
    for (int i = 0; i < 11; ++i) {
        const double r = 1e-3 + 2e-5 * i;
        p.add(Vec3(1.3e-3 * (i % 4), 2e-3 + 2.5e-3 * (i / 4), 2.6e-3 * (i % 3) + 1e-4 * i), r);
    }
    c.filling.list = p;
    return c;
}

Comparison against(Backend& candidate, std::uint64_t steps = 4000) {
    const Case c = fallingSpheres();
    const Insertion filled = insertParticles(c);
    const auto reference = makeReferenceBackend(), fine = makeReferenceBackend(), rough = makeReferenceBackend();
    const std::atomic<bool> stop{false};
    return compareBackends(
        c, filled, *reference, {fine.get(), {rough.get()}}, candidate, steps, [](std::uint64_t) {}, stop);
}

}  // namespace

TEST_CASE("the reference agrees with itself to the last bit") {
    const auto same = makeReferenceBackend();
    const Comparison c = against(*same);
    CHECK(c.verdict() == Verdict::Agrees);
    CHECK(c.steps == 4000);
    CHECK(c.particles.size() > 40);
    bool touched = false;
    for (const ParticleRow& r : c.particles) {
        CHECK(r.position == 0);
        touched = touched || (r.contacts > 0 && r.verdict == Verdict::Agrees);
    }
    CHECK(touched);  // else the case judges no contact at all
}

TEST_CASE("a backend that is a little wrong is found out") {
    SECTION("gravity 0.1 % too strong") {
        Wrong wrong([](RuledWorld& w) { w.gravity *= 1.001; });
        CHECK(against(wrong).verdict() == Verdict::Differs);
    }
    SECTION("5 % more stiffness") {
        Wrong wrong([](RuledWorld& w) {
            for (ContactParameters& p : w.law.pairs) p.k1 *= 1.05;
        });
        CHECK(against(wrong).verdict() == Verdict::Differs);
    }
    SECTION("5 % less damping") {
        Wrong wrong([](RuledWorld& w) {
            for (ContactParameters& p : w.law.pairs) p.gamma *= 0.95;
        });
        CHECK(against(wrong).verdict() == Verdict::Differs);
    }
    SECTION("no rolling resistance") {
        Wrong wrong([](RuledWorld& w) {
            for (ContactParameters& p : w.law.pairs) p.muR = 0;
        });
        CHECK(against(wrong).verdict() == Verdict::Differs);
    }
}

TEST_CASE("a comparison stops when asked to") {
    const Case c = fallingSpheres();
    const auto a = makeReferenceBackend(), b = makeReferenceBackend(), fine = makeReferenceBackend();
    const std::atomic<bool> stop{true};
    const Comparison result = compareBackends(
        c, insertParticles(c), *a, {fine.get(), {}}, *b, 100, [](std::uint64_t) {}, stop);
    CHECK(result.interrupted);
    CHECK(result.steps == 0);
    CHECK(result.verdict() == Verdict::Undecided);
}
