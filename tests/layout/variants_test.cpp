// The variants of passes, as shaders/passes.cmake declares them and the host picks them.
#include "host/vk/variant.h"

#include "spirv/passes.h"
#include "tests/support/catch.h"

using namespace vkdose;

namespace {

bool same(std::span<const std::uint32_t> a, std::span<const std::uint32_t> b) {
    return a.data() == b.data() && a.size() == b.size();
}

}  // namespace

TEST_CASE("the variant with the most of the wanted macros is picked, never one with another macro") {
    const std::uint32_t code[6] = {};
    const std::span<const std::uint32_t> all(code);
    const vk::Variant variants[] = {{0, all.subspan(0, 1)},
                                    {1, all.subspan(1, 1)},
                                    {3, all.subspan(2, 1)},
                                    {4, all.subspan(3, 1)},
                                    {5, all.subspan(4, 1)}};
    const auto picked = [&](unsigned wanted) { return vk::pick(variants, wanted).data() - code; };
    CHECK(picked(0) == 0);
    CHECK(picked(1) == 1);
    CHECK(picked(2) == 0);  // there is none with this macro alone
    CHECK(picked(3) == 2);
    CHECK(picked(4) == 3);
    CHECK(picked(5) == 4);
    CHECK(picked(8) == 0);
}

TEST_CASE("each pass is compiled as the device and the energy book want it") {
    using namespace spirv;
    CHECK(same(vk::pick(clear, TEXEL_READS | PACKED_STORES | ENERGY_BOOK), clear_spv));
    CHECK(same(vk::pick(bin, TEXEL_READS | PACKED_STORES | ENERGY_BOOK), bin_texel_spv));
    CHECK(same(vk::pick(near, TEXEL_READS | PACKED_STORES | ENERGY_BOOK), near_texel_energy_spv));
    CHECK(same(vk::pick(near, ENERGY_BOOK), near_energy_spv));
    CHECK(same(vk::pick(near, TEXEL_READS | PACKED_STORES | WITH_BODIES), near_texel_bodies_spv));
    CHECK(same(vk::pick(near, WITH_BODIES), near_bodies_spv));
    CHECK(same(vk::pick(pairs, 0), pairs_spv));
    CHECK(same(vk::pick(pairs, TEXEL_READS), pairs_texel_spv));
    CHECK(same(vk::pick(pairs, TEXEL_READS | ENERGY_BOOK), pairs_texel_energy_spv));
    CHECK(same(vk::pick(pairs, TEXEL_READS | PACKED_STORES), pairs_packed_spv));
    CHECK(same(vk::pick(pairs, TEXEL_READS | PACKED_STORES | ENERGY_BOOK), pairs_packed_energy_spv));
    CHECK_FALSE(same(pairs_spv, pairs_texel_spv));
}
