// A snapshot carries everything: a backend that restores it goes on with the same bits as the one it was taken from.
#include <algorithm>

#include "tests/scene/beds.h"
#include "tests/support/catch.h"
#include "tests/support/records.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

constexpr double kRate = -2 * kPi * 1.5 * 1.0000001;  // no round number of 2^-64 turns a step

std::size_t coilContacts(const Backend& backend) {
    const auto contacts = backend.contacts();
    return std::size_t(std::count_if(contacts.begin(), contacts.end(),
                                     [](const Contact& c) { return c.kind == ContactClass::ParticleCoil; }));
}

std::vector<double> flatBook(const EnergyBook& b) {
    return {b.kinetic,        b.rotational, b.potential, b.elasticNormal, b.elasticSliding, b.elasticRolling,
            b.elasticTorsion, b.plastic,    b.adhesive,  b.viscous,       b.sliding,        b.rolling,
            b.torsion,        b.numerical,  b.coilWork,  b.left,          b.loaded};
}

/// `restored` has made no step, so that nothing has acted yet.
void checkSameButForces(std::vector<Contact> contacts, const std::vector<Contact>& restored) {
    for (Contact& c : contacts) c.force = Vec3(0);
    CHECK(sameBits(contacts, restored));
}

void restartAgrees(bool reference) {
    RuledWorld w = canisterWorld();
    w.maxOverlapRatio = 1;
    w.energyBook = GENERATE(false, true);
    const Particles p = thrownIn(203);
    const auto whole = made(reference);
    whole->load(w, p);
    whole->advance(4001, 0);
    w.law = paperLaw(0.87);
    whole->setLaw(w.law);
    whole->advance(3000, kRate);
    const Record taken = whole->snapshot();
    CHECK(taken == whole->snapshot());
    CHECK(coilContacts(*whole) > 3);
    CHECK(whole->contacts().size() > 100);

    const auto second = made(reference);
    second->load(w, p);
    second->advance(17, 3.0);  // traces of another life must not survive
    second->load(w, p);
    second->restore(taken);
    CHECK(sameBits(second->particles(), whole->particles()));
    CHECK(second->coilAngle() == whole->coilAngle());
    checkSameArrays(taken, second->snapshot());  // a run may be interrupted again before it has made a step
    checkSameButForces(whole->contacts(), second->contacts());
    for (int call = 0; call < 3; ++call) {
        const Sensors a = whole->advance(1501, kRate), b = second->advance(1501, kRate);
        CHECK(a.coilTorque == b.coilTorque);
        CHECK(a.kineticEnergy == b.kineticEnergy);
        CHECK(a.maxOverlapRatio == b.maxOverlapRatio);
        CHECK(a.count == b.count);
        REQUIRE(a.energy.has_value() == w.energyBook);
        if (w.energyBook) CHECK(flatBook(*a.energy) == flatBook(*b.energy));
        CHECK(sameBits(whole->particles(), second->particles()));
        CHECK(sameBits(whole->contacts(), second->contacts()));
        CHECK(whole->coilAngle() == second->coilAngle());
    }
    if (!reference) requireClean(*second);
}

}  // namespace

TEST_CASE("vulkan: restored and uninterrupted are the same bits", "[every-driver]") {
    restartAgrees(false);
}

TEST_CASE("reference: restored and uninterrupted are the same bits") {
    restartAgrees(true);
}

TEST_CASE("a snapshot that does not fit is refused") {
    const bool reference = GENERATE(false, true);
    const auto backend = made(reference), other = made(!reference);
    backend->load(canisterWorld(), thrownIn(20));
    other->load(canisterWorld(), thrownIn(20));
    CHECK_THROWS_AS(backend->restore(Record()), RecordError);
    CHECK_THROWS_AS(backend->restore(other->snapshot()), RecordError);
    const Record taken = backend->snapshot();
    backend->load(canisterWorld(), thrownIn(21));
    CHECK_THROWS_AS(backend->restore(taken), RecordError);
}

TEST_CASE("the bits do not depend on how many steps a submission holds") {
    RuledWorld w = canisterWorld();
    w.maxOverlapRatio = 1;
    const Particles p = thrownIn(67);
    const auto play = [&](std::uint32_t batch) {
        VulkanOptions options;
        options.batch = batch;
        auto backend = gpu(options);
        backend->load(w, p);
        for (int call = 0; call < 4; ++call) backend->advance(1999, kRate);
        return backend;
    };
    const auto one = play(1999), many = play(13);
    CHECK(coilContacts(*one) > 3);
    CHECK(sameBits(one->particles(), many->particles()));
    CHECK(sameBits(one->contacts(), many->contacts()));
    CHECK(one->snapshot() == many->snapshot());
    CHECK(one->coilAngle() == many->coilAngle());
}
