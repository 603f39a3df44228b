// Fields of single powders: they add up to those of all, and the device's are the reference's.
#include <algorithm>
#include <cmath>

#include "tests/scene/mixed_beds.h"
#include "tests/support/catch.h"

using namespace vkdose;
using namespace vkdose::test;

TEST_CASE("materials: fields of each powder add up to the field of all") {
    const bool onDevice = GENERATE(false, true);
    const RuledWorld w = mixedWorld();
    const Particles p = mixedParticles(150);
    const auto backend = onDevice ? gpu() : makeReferenceBackend();
    backend->load(w, p);
    backend->advance(500, kRate);
    FieldRequest request;
    request.grid = {{-0.012, -0.012, 0}, {0.012, 0.06, 0.06}, {2, 6, 4}};
    request.width = 0.01;
    const FieldPoints all = backend->fields(request);
    FieldPoints sum(all.size());
    double massOfSecond = 0, number = 0;
    for (const int powder : powdersOf(w)) {
        request.material = powder;
        const FieldPoints part = backend->fields(request);
        for (std::size_t k = 0; k < sum.size(); ++k) {
            sum[k].density += part[k].density;
            sum[k].momentum += part[k].momentum;
            sum[k].number += part[k].number;
            if (powder == kSecond) massOfSecond += part[k].density * request.grid.cellVolume();
        }
    }
    for (std::size_t k = 0; k < all.size(); ++k) {
        CHECK(std::abs(sum[k].density - all[k].density) <= 1e-5 * all[k].density);
        CHECK(std::abs(sum[k].number - all[k].number) <= 1e-5 * all[k].number);
        CHECK(glm::length(sum[k].momentum - all[k].momentum) <= 1e-5 * (glm::length(all[k].momentum) + all[k].density));
        number += all[k].number;
    }
    CHECK(number > 0);
    double known = 0;
    const Particles now = backend->particles();
    for (std::size_t i = 0; i < now.size(); ++i) {
        const Vec3& x = now.position[i];
        const bool within =
            glm::all(glm::greaterThanEqual(x, request.grid.low)) && glm::all(glm::lessThanEqual(x, request.grid.high));
        if (now.material[i] == kSecond && now.status[i] == Status::Active && within) known += massOf(w, now, i);
    }
    CHECK(nearRelative(massOfSecond, known, 1e-5));
}

TEST_CASE("materials: the contact stresses of the powders add up to that of all") {
    const RuledWorld w = mixedWorld();
    const auto backend = GENERATE(false, true) ? gpu() : makeReferenceBackend();
    backend->load(w, mixedParticles(150));
    backend->advance(500, kRate);
    FieldRequest request;
    request.grid = {{-0.012, -0.012, 0}, {0.012, 0.06, 0.06}, {2, 6, 4}};
    request.kernel = Kernel::Lucy;  // has no edge in which single nodes of a quadrature are and others are not
    request.width = 0.03;
    request.contactStress = true;
    const FieldPoints all = backend->fields(request);
    FieldPoints sum(all.size());
    for (const int powder : powdersOf(w)) {
        request.material = powder;
        const FieldPoints part = backend->fields(request);
        for (std::size_t k = 0; k < sum.size(); ++k)
            for (std::size_t row = 0; row < 3; ++row) sum[k].contactStress[row] += part[k].contactStress[row];
    }
    // Rounding, and two quadratures of a branch in place of one: its length is a tenth of the kernel's width.
    CHECK(stressDifference(sum, all) < 1e-4);
}

TEST_CASE("materials: the device divides the contact stress among the powders as the reference does") {
    const RuledWorld w = mixedWorld();
    const Particles p = packed(w);
    const auto device = gpu(), reference = makeReferenceBackend();
    for (Backend* b : {device.get(), reference.get()}) {
        b->load(w, p);
        b->advance(5, kRate);
    }
    int alike = 0, mixed = 0, others = 0;
    for (const Contact& c : reference->contacts()) {
        if (c.kind != ContactClass::ParticleParticle)
            ++others;
        else
            ++(p.material[c.particle] == p.material[c.other] ? alike : mixed);
    }
    REQUIRE(alike > 5);
    REQUIRE(mixed > 20);
    REQUIRE(others > 20);
    FieldRequest request;
    request.grid = {{-0.012, -0.012, 0}, {0.012, 0.06, 0.06}, {6, 15, 15}};
    request.width = 0.004;
    request.contactStress = true;
    for (const int powder : powdersOf(w)) {
        request.material = powder;
        CHECK(stressDifference(device->fields(request), reference->fields(request)) < 4e-4);
    }
}
