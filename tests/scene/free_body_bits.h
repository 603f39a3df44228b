#pragma once
// The third body of a world moves freely over `tubeBed`: the same bits however the device comes to them.

#include <functional>
#include <thread>

#include "tests/scene/body_beds.h"
#include "tests/support/catch.h"
#include "tests/support/records.h"

namespace vkdose::test {

inline bool sameBody(const Backend& a, const Backend& b) {
    const FreeBody one = a.freeBodies().at(2), other = b.freeBodies().at(2);
    return one.shift == other.shift && one.velocity == other.velocity && one.angle == other.angle &&
           one.rate == other.rate;
}

/// In other batches, after a restart and beside other canisters. `met`: whether it has met the bed after 2501 steps.
inline void checkSameBitsOverBed(const RuledWorld& w, const std::function<bool(const FreeBody&)>& met) {
    const Particles p = tubeBed();
    VulkanOptions small;
    small.batch = 7;
    const auto whole = gpu(), other = gpu(small), second = gpu(byAddress());
    for (Backend* b : {whole.get(), other.get(), second.get()}) b->load(w, p);
    whole->advance(2501, 0);
    other->advance(2501, 0);
    CHECK(met(whole->freeBodies().at(2)));
    CHECK(sameBody(*whole, *other));
    CHECK(sameBits(whole->particles(), other->particles()));

    const Record taken = whole->snapshot();
    second->restore(taken);
    checkSameArrays(taken, second->snapshot());
    for (int call = 0; call < 2; ++call) {
        whole->advance(701, 0);
        second->advance(701, 0);
        CHECK(sameBody(*whole, *second));
        CHECK(sameBits(whole->particles(), second->particles()));
        CHECK(sameBits(whole->contacts(), second->contacts()));
    }

    // Beside a canister in which nothing moves freely.
    auto members = gpuEnsemble(2);
    RuledWorld fewer = w;
    fewer.bodies.pop_back();
    std::thread first([&] {
        members[0]->load(fewer, tubeBed());
        members[0]->advance(2501, 0);
        members[0].reset();  // nobody waits for it any more
    });
    members[1]->load(w, p);
    members[1]->advance(2501, 0);
    const Particles together = members[1]->particles();
    CHECK(sameBody(*members[1], *other));
    requireClean(*members[1]);
    first.join();
    CHECK(sameBits(together, other->particles()));
    requireClean(*whole);
}

}  // namespace vkdose::test
