// The workloads are what their names say.

#include "host/bench/workloads.h"

#include <algorithm>
#include <set>

#include "host/backend/reference/reference.h"
#include "tests/support/catch.h"

using namespace vkdose;
using namespace vkdose::bench;

namespace {

Workload named(const std::string& name, const std::optional<Case>& bed = std::nullopt) {
    for (const Plan& plan : plans(bed))
        if (plan.name == name) return plan.make();
    throw std::runtime_error("no workload " + name);
}

Case settledBed() {
    return loadCase(VKDOSE_SOURCE_DIR "/tools/bench-data/bed-48g.toml");
}

}  // namespace

TEST_CASE("workloads have names of their own and sizes in their names") {
    std::set<std::string> names;
    const auto all = plans(settledBed());
    for (const Plan& plan : all) names.insert(plan.name);
    CHECK(names.size() == all.size());
    CHECK(names.count("bed-48g-rest") == 1);
    CHECK(names.count("bed-48g-turning") == 1);
    CHECK(named("bed-3k").particles.size() == 3375);
    CHECK(named("bed-27k").particles.size() == 27000);
}

TEST_CASE("nothing touches in free fall") {
    const Workload w = named("free-fall");
    const auto backend = makeReferenceBackend();
    backend->load(w.world, w.particles);
    CHECK(backend->advance(3, 0).maxOverlapRatio == 0);
    CHECK(backend->contacts().empty());
}

TEST_CASE("a box is full of contacts and at rest") {
    const Workload w = named("bed-3k");
    const auto backend = makeReferenceBackend();
    backend->load(w.world, w.particles);
    double stored = 0;  // at first loading
    backend->advance(1, 0);
    for (const Contact& c : backend->contacts())
        stored += 0.5 * w.world.law.of(c.kind).k1 * c.maxOverlap * c.maxOverlap;
    const Sensors s = backend->advance(100, 0);
    CHECK(s.count[std::size_t(Region::Canister)] == w.particles.size());
    CHECK(s.maxOverlapRatio < kMaxOverlapRatio);
    CHECK(s.kineticEnergy < 1e-3 * stored);
    CHECK(2.0 * double(backend->contacts().size()) / double(w.particles.size()) > 4);
}

TEST_CASE("a bed with a mesh is at rest around ten thousand triangles that its spheres touch") {
    const Workload w = named("bed-3k-mesh");
    CHECK(w.particles.size() == named("bed-3k").particles.size());
    REQUIRE(w.world.bodies.size() == 1);
    const auto& shape = std::get<std::shared_ptr<const geometry::MeshSurface>>(w.world.bodies[0].shapes.at(0));
    CHECK(shape->mesh().triangles.size() > 9800);
    CHECK(shape->mesh().triangles.size() < 10200);
    const auto backend = makeReferenceBackend();
    backend->load(w.world, w.particles);
    double stored = 0;  // at first loading
    backend->advance(1, 0);
    const auto contacts = backend->contacts();
    for (const Contact& c : contacts) stored += 0.5 * w.world.law.of(c.kind).k1 * c.maxOverlap * c.maxOverlap;
    const std::size_t walls = w.world.walls.size();
    CHECK(std::count_if(contacts.begin(), contacts.end(), [&](const Contact& c) {
              return c.kind == ContactClass::ParticleWall && c.other == walls;
          }) > 100);
    const Sensors s = backend->advance(60, 0);
    CHECK(s.maxOverlapRatio < kMaxOverlapRatio);
    CHECK(s.kineticEnergy < 1e-2 * stored);  // a facet lies a little under the wire on which the spheres were laid
    for (const Plan& plan : plans(std::nullopt))
        if (plan.name == "bed-3k-mesh") CHECK(plan.without == "bed-3k");
}

TEST_CASE("the settled bed is at rest although its contacts have lost their history") {
    const Workload rest = named("bed-48g-rest", settledBed()), turning = named("bed-48g-turning", settledBed());
    CHECK(rest.coilRate == 0);
    CHECK(std::abs(turning.coilRate) == Approx(90 * 2 * kPi / 60));
    const auto backend = makeReferenceBackend();
    backend->load(rest.world, rest.particles);
    const Sensors s = backend->advance(100, 0);
    // Weights move by a ten-thousandth of a radius at most.
    const double mass = s.mass[0] + s.mass[1];
    CHECK(s.kineticEnergy < 1e-4 * mass * 9.81 * 1.25e-3);
    CHECK(s.count[0] + s.count[1] == rest.particles.size());
    CHECK(2.0 * double(backend->contacts().size()) / double(rest.particles.size()) > 3);
}
