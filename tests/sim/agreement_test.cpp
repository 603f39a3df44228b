#include "host/sim/agreement.h"

#include <limits>

#include "tests/sim/fake_backend.h"
#include "tests/support/catch.h"

using namespace vkdose;

namespace {

const double kNan = std::numeric_limits<double>::quiet_NaN();

Particles three(double shift = 0) {
    Particles p;
    for (int i = 0; i < 3; ++i) p.add(Vec3(0.01 * i + shift, 0, 0), 1e-3, Vec3(0, -0.1, 0));
    return p;
}

const Scales kScales{1e-3, 1e-5, 3e-5};

History flat(double value) {
    History h;
    for (int i = 1; i <= 6; ++i) {
        Moment m;
        m.time = i;
        m.phase = i <= 2 ? Phase::Settle : Phase::Rotate;
        m.lateInPhase = i >= 5;
        m.kineticEnergy = m.meanKineticEnergy = m.meanTorque = m.maxOverlap = m.contactsEach = value;
        m.meanHeight = m.freeWay = value * 1e-3;
        m.dosedMass = value * 3e-5;
        h.push_back(m);
    }
    return h;
}

const QuantityRow& named(const std::vector<QuantityRow>& rows, const std::string& name) {
    for (const QuantityRow& r : rows) {
        if (r.name == name) return r;
    }
    throw std::logic_error("no quantity " + name);
}

}  // namespace

TEST_CASE("equal states agree, and a difference beyond rounding does not") {
    const Particles reference = three(), twin = three(1e-10);
    ParticleJudge judge(kScales);
    CHECK(judge.row(1, 1e-6, 0, reference, twin, reference).verdict == Verdict::Agrees);
    // Positions hold two floats: losing the second one (2 nm at 4 cm) must show before the first contact.
    CHECK(judge.row(2, 2e-6, 0, reference, twin, three(2e-9)).verdict == Verdict::Differs);
    Particles fast = reference;
    fast.velocity[1].x += 1e-4;  // 1e-3 of the velocity scale, after two steps
    CHECK(judge.row(2, 2e-6, 0, reference, twin, fast).verdict == Verdict::Differs);
}

TEST_CASE("NaN and a missing particle differ") {
    const Particles reference = three(), twin = three(1e-10);
    ParticleJudge judge(kScales);
    Particles bad = reference;
    bad.position[0].x = kNan;
    CHECK(judge.row(1, 1e-6, 0, reference, twin, bad).verdict == Verdict::Differs);
    bad = reference;
    bad.velocity[2].z = kNan;
    CHECK(judge.row(1, 1e-6, 0, reference, twin, bad).verdict == Verdict::Differs);
    Particles fewer = three();
    fewer.position.pop_back();
    CHECK(judge.row(1, 1e-6, 0, reference, twin, fewer).verdict == Verdict::Differs);
}

TEST_CASE("what the twins amplified, the candidate may have amplified, until it says nothing") {
    const Particles reference = three();
    ParticleJudge judge(kScales);
    // The twin's 1e-7 of a radius became 1e-3: errors grew ten thousand times.
    const Particles twin = three(1e-6);
    const ParticleRow row = judge.row(1000, 1e-3, 1, reference, twin, three(1e-6));
    CHECK(row.positionLimit > 1e-3);
    CHECK(row.verdict == Verdict::Agrees);
    const Particles lost = three(5e-4);
    CHECK(judge.row(2000, 2e-3, 1, reference, lost, three(5e-4)).verdict == Verdict::Undecided);
    // Once chaotic, always chaotic.
    CHECK(judge.row(3000, 3e-3, 1, reference, reference, reference).verdict == Verdict::Undecided);
}

TEST_CASE("a history agrees with itself in every quantity") {
    const History h = flat(1);
    const auto rows = judgeQuantities(h, {&h}, h, kScales);
    CHECK(rows.size() == 10);
    for (const QuantityRow& r : rows) CHECK(r.verdict == Verdict::Agrees);
}

TEST_CASE("every quantity is able to differ, by being off and by NaN") {
    const History h = flat(1), off = flat(5), nan = flat(kNan);
    for (const QuantityRow& r : judgeQuantities(h, {&h}, off, kScales)) {
        CAPTURE(r.name);
        CHECK(r.verdict == Verdict::Differs);
    }
    for (const QuantityRow& r : judgeQuantities(h, {&h}, nan, kScales)) {
        CAPTURE(r.name);
        CHECK(r.verdict == Verdict::Differs);
    }
    for (const QuantityRow& r : judgeQuantities(h, {&h}, History(h.begin(), h.begin() + 1), kScales)) {
        CAPTURE(r.name);
        CHECK(r.verdict == Verdict::Differs);
    }
}

TEST_CASE("the twins' spread widens the tolerance, up to where agreement means nothing") {
    const History h = flat(1), twin = flat(1.05), near = flat(1.1), far = flat(1.4), wild = flat(2);
    const char* energy = "kinetic energy, settling";
    CHECK(named(judgeQuantities(h, {&h}, near, kScales), energy).verdict == Verdict::Differs);
    CHECK(named(judgeQuantities(h, {&h, &twin}, near, kScales), energy).verdict == Verdict::Agrees);
    CHECK(named(judgeQuantities(h, {&twin}, far, kScales), energy).verdict == Verdict::Differs);
    CHECK(named(judgeQuantities(h, {&wild}, far, kScales), energy).verdict == Verdict::Undecided);
    const History nan = flat(kNan);
    CHECK(named(judgeQuantities(h, {&nan}, h, kScales), energy).verdict == Verdict::Undecided);
    CHECK(named(judgeQuantities(h, {&nan}, nan, kScales), energy).verdict == Verdict::Differs);
}

TEST_CASE("a quantity in which hardly anything happens proves nothing, and has no row") {
    History h = flat(1), more = flat(1);
    for (Moment& m : h) m.dosedMass = 1.9e-5;  // less than two particles, the floor
    CHECK(judgeQuantities(h, {&h}, h, kScales).size() == 9);
    for (Moment& m : h) m.dosedMass = m.meanTorque = 0;
    CHECK(judgeQuantities(h, {&h}, h, kScales).size() == 8);
    // It has its row as soon as one of them shows something.
    CHECK(named(judgeQuantities(h, {&h}, more, kScales), "dosed mass").verdict == Verdict::Differs);
    CHECK(named(judgeQuantities(h, {&h}, flat(kNan), kScales), "dosed mass").verdict == Verdict::Differs);
    CHECK(named(judgeQuantities(h, {&more}, h, kScales), "dosed mass").verdict == Verdict::Undecided);
}

TEST_CASE("a comparison agrees only if something was judged, particle by particle and in the whole packing") {
    const auto row = [](auto kind, Verdict verdict) {
        kind.verdict = verdict;
        return kind;
    };
    const auto agrees = Verdict::Agrees, differs = Verdict::Differs, undecided = Verdict::Undecided;
    const ParticleRow p;
    const QuantityRow q;
    Comparison c;
    CHECK(c.verdict() == undecided);
    c.particles = {row(p, agrees), row(p, undecided)};
    CHECK(c.verdict() == undecided);
    c.quantities = {row(q, undecided), row(q, undecided)};
    CHECK(c.verdict() == undecided);
    CHECK(c.undecided() == 2);
    c.quantities.push_back(row(q, agrees));
    CHECK(c.verdict() == agrees);
    c.particles = {row(p, undecided)};
    CHECK(c.verdict() == undecided);
    c.quantities.push_back(row(q, differs));
    CHECK(c.verdict() == differs);
    c.quantities = {row(q, agrees)};
    c.particles = {row(p, agrees), row(p, differs)};
    CHECK(c.verdict() == differs);
}
