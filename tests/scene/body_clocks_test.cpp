// Bodies with clocks of their own on the device: they stand in some phases, go on, start anew, and set off in time.

#include <cmath>
#include <thread>

#include "tests/scene/body_beds.h"
#include "tests/support/catch.h"
#include "tests/support/records.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

/// The device of body_beds.h whose drum turns by a clock of its own.
RuledWorld phasedWorld() {
    RuledWorld w = deviceWorld();
    w.bodies[0].clock = Clock::Phases;
    w.bodies[0].phases = {Phase::Rotate};
    return w;
}

/// A heap, and eight spheres that meet the drum one after another, every 150 steps or so.
Particles atDrum() {
    Particles p = layers(30);
    const double radius = single(1.25e-3);
    int k = 0;
    for (const double degrees : {95, 115, 135, 155, 205, 225, 245, 265}) {
        const Vec3 out(std::cos(degrees * kPi / 180), std::sin(degrees * kPi / 180), 0);
        const double gap = (0.05 + 0.12 * k++) * 1e-3;
        p.add((20e-3 - radius - gap) * out + Vec3(0, 0, 5e-3), radius, 0.4 * out);
    }
    return p;
}

std::vector<BodyClock> drumClock(std::uint64_t steps, bool runs) {
    std::vector<BodyClock> clocks(3);
    clocks[0] = {steps, runs, BodyClock::kNever};
    return clocks;
}

}  // namespace

TEST_CASE("bodies: by a clock of its own that runs from the start a body moves as by time, bit by bit") {
    for (const bool onDevice : {false, true}) {
        CAPTURE(onDevice);
        const auto byTime = onDevice ? gpu() : makeReferenceBackend(), own = onDevice ? gpu() : makeReferenceBackend();
        byTime->load(deviceWorld(), atDrum());
        own->load(phasedWorld(), atDrum());
        own->setClocks(drumClock(0, true));
        for (const std::uint32_t steps : {701U, 400U}) {  // the backend counts on
            const Sensors a = byTime->advance(steps, kDrive), b = own->advance(steps, kDrive);
            CHECK(a.bodies.at(0).work == b.bodies.at(0).work);
            CHECK(std::abs(a.bodies.at(0).work) > 0);
        }
        CHECK(sameBits(byTime->particles(), own->particles()));
        CHECK(sameBits(byTime->contacts(), own->contacts()));
    }
}

TEST_CASE("bodies: one that stands in a phase does no work, and goes on from where it stood") {
    const RuledWorld w = phasedWorld();
    const Particles p = atDrum();
    VulkanOptions small;
    small.batch = 7;
    auto device = gpu(), other = gpu(small), restarted = gpu();
    auto reference = makeReferenceBackend();
    for (Backend* b : {device.get(), other.get(), reference.get(), restarted.get()}) b->load(w, p);
    std::uint64_t count = 0;
    for (const auto& [steps, runs] : {std::pair(601U, true), std::pair(400U, false), std::pair(301U, true)}) {
        std::vector<Sensors> s;
        for (Backend* b : {device.get(), other.get(), reference.get()}) {
            b->setClocks(drumClock(count, runs));
            s.push_back(b->advance(steps, kDrive));
        }
        if (runs) count += steps;
        for (const Sensors& each : s) CHECK((each.bodies.at(0).work != 0) == runs);
        const double scale = std::max(1e-3, glm::length(s[2].bodies[0].force));
        CHECK(near(s[0].bodies[0].force, s[2].bodies[0].force, scale, 2e-2));
        CHECK(sameBits(device->particles(), other->particles()));
    }
    CHECK(differences(*device, *reference, 0.5).position < 1e-2);

    const Record taken = device->snapshot();
    restarted->restore(taken);
    for (Backend* b : {device.get(), restarted.get()}) {
        b->setClocks(drumClock(count, true));
        b->advance(300, kDrive);
    }
    CHECK(sameBits(device->particles(), restarted->particles()));
    CHECK(sameBits(device->contacts(), restarted->contacts()));
    requireClean(*device);

    // Beside a canister whose drum stands.
    auto members = gpuEnsemble(2);
    std::thread standing([&] {
        members[0]->load(w, layers(13));
        members[0]->setClocks(drumClock(0, false));
        members[0]->advance(301, 0);
        members[0].reset();  // nobody waits for it any more
    });
    members[1]->load(w, p);
    members[1]->setClocks(drumClock(0, true));
    members[1]->advance(601, kDrive);
    const Particles together = members[1]->particles();
    standing.join();
    other->load(w, p);
    other->setClocks(drumClock(0, true));
    other->advance(601, kDrive);
    CHECK(sameBits(together, other->particles()));
}

TEST_CASE("bodies: one that starts anew within a call stands where it began") {
    // A ball that sinks by half a radius and comes back meets a sphere that rests on it in the air.
    RuledWorld w = emptyWorld();
    geometry::Table table{Vec3(0, 1, 0), Vec3(0), {}};
    const double dt = w.timeStep;
    for (const auto& [at, height] : {std::pair(0, 0.0), std::pair(40, -0.3e-3), std::pair(100, 0.0)})
        table.rows.push_back({at * dt, 0, Vec3(0, height, 0)});
    w.bodies.push_back(bodyOf("lift", {geometry::Ball{Vec3(0), 3e-3}}, table, Clock::Phases));
    Particles p;
    p.add(Vec3(0, 4.2e-3, 0), 1.25e-3);
    const auto whole = gpu(), cut = gpu();
    const auto reference = makeReferenceBackend();
    for (Backend* b : {whole.get(), cut.get(), reference.get()}) {
        b->load(w, p);
        b->setClocks({BodyClock{0, true, 100}});
    }
    const Sensors a = whole->advance(150, 0), r = reference->advance(150, 0);
    cut->advance(100, 0);
    cut->setClocks({BodyClock{0, true, BodyClock::kNever}});
    cut->advance(50, 0);
    CHECK(r.maxOverlapRatio > 1e-3);
    CHECK(sameBits(whole->particles(), cut->particles()));
    CHECK(near(a.bodies[0].work, r.bodies[0].work, std::abs(r.bodies[0].work), 1e-2));
    CHECK(differences(*whole, *reference, 0.5).position < 1e-4);
}

TEST_CASE("bodies: one that sets off after a rest is met in time") {
    // The lists of the rest leave out a sphere that is 20 micrometres away. The ball comes nearer by two in a step.
    RuledWorld w = emptyWorld();
    geometry::Table table{Vec3(0, 1, 0), Vec3(0), {}};
    const double dt = w.timeStep;
    for (const auto& [at, height] : {std::pair(0, 0.0), std::pair(64, 0.0), std::pair(164, 0.2e-3)})
        table.rows.push_back({at * dt, 0, Vec3(0, height, 0)});
    w.bodies.push_back(bodyOf("lift", {geometry::Ball{Vec3(0), 3e-3}}, table));
    Particles p;
    p.add(Vec3(0, 4.27e-3, 0), 1.25e-3);
    const auto device = gpu();
    const auto reference = makeReferenceBackend();
    for (Backend* b : {device.get(), reference.get()}) {
        b->load(w, p);
        b->advance(64, 0);
    }
    CHECK(device->advance(20, 0).maxOverlapRatio > 0);
    reference->advance(20, 0);
    CHECK(differences(*device, *reference, 0.5).position < 1e-4);
}
