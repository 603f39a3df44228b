// Which members of a sweep share the device, and how many at a time.
#include "host/app/batches.h"

#include <limits>

#include "host/backend/vulkan/passes.h"
#include "host/law/user_law.h"
#include "tests/support/catch.h"

using namespace vkdose;

namespace {

constexpr std::uint64_t kPlenty = std::numeric_limits<std::uint64_t>::max();
const DeviceRoom kWide{kPlenty, kPlenty, 65535};

TableSizes tablesOf(std::size_t particles, std::size_t surfaces = 1) {
    World world;
    world.skin = 0.1e-3;
    for (std::size_t i = 0; i < surfaces; ++i) world.walls.emplace_back(geometry::Plane{{0, 0, 0}, {0, 0, 1}});
    Particles p;
    for (std::size_t i = 0; i < particles; ++i) p.add({}, 1e-3);
    return roomOf(world, p);
}

using Batches = std::vector<Batch>;

}  // namespace

TEST_CASE("a batch has no more places than asked for or filled, and its members with the most steps begin first") {
    const TableSizes t = tablesOf(100);
    const std::vector<BatchMember> members{{0, 10, t}, {1, 900, t}, {2, 11, t}, {3, 1000, t}, {4, 12, t}};
    CHECK(batchesOf(members, kWide, 2) == Batches{{2, {3, 1, 4, 2, 0}}});
    CHECK(batchesOf(members, kWide, 99) == Batches{{5, {3, 1, 4, 2, 0}}});
    CHECK(batchesOf({{4, 7, t}, {2, 7, t}, {3, 7, t}}, kWide, 1) == Batches{{1, {2, 3, 4}}});
    CHECK(batchesOf({}, kWide, 2).empty());
}

TEST_CASE("only members of a kind share a batch") {
    const TableSizes one = tablesOf(100), two = tablesOf(100, 2);
    CHECK(batchesOf({{0, 5, one}, {1, 5, two}, {2, 5, one}, {3, 5, two}}, kWide, 9) ==
          Batches{{2, {0, 2}}, {2, {1, 3}}});
    TableSizes book = one;
    book.energyBook = true;
    CHECK(batchesOf({{0, 5, one}, {1, 5, book}}, kWide, 9) == Batches{{1, {0}}, {1, {1}}});
    TableSizes own = one;
    own.userLaw = std::make_shared<UserLaw>();
    CHECK(batchesOf({{0, 5, own}, {1, 5, one}, {2, 4, own}, {3, 4, one}}, kWide, 9) ==
          Batches{{4, {0, 1, 2, 3}}});  // no law, and one without a text, are the same
    auto law = std::make_shared<UserLaw>();
    law->hash = "f00";
    own.userLaw = law;
    CHECK(batchesOf({{0, 5, own}, {1, 5, one}, {2, 4, own}, {3, 4, one}}, kWide, 9) ==
          Batches{{2, {1, 3}}, {2, {0, 2}}});
}

TEST_CASE("a member that needs more than twice the room of another has a batch of its own") {
    const TableSizes small = tablesOf(1000), larger = tablesOf(1700), large = tablesOf(10000);
    CHECK(2 * small.allBytes() > larger.allBytes());
    CHECK(batchesOf({{0, 1, small}, {1, 2, large}, {2, 3, larger}}, kWide, 9) == Batches{{1, {1}}, {2, {2, 0}}});
}

TEST_CASE("the places of a batch fit the device's memory, its longest buffer and its dispatches") {
    const TableSizes small = tablesOf(1000), large = tablesOf(1700);
    const std::vector<BatchMember> four{{0, 4, small}, {1, 3, small}, {2, 2, small}, {3, 1, small}};
    TableSizes three = small;
    three.members = 3;
    DeviceRoom room = kWide;
    room.memory = three.allBytes();
    CHECK(batchesOf(four, room, 99) == Batches{{3, {0, 1, 2, 3}}});
    room.memory -= 1;
    CHECK(batchesOf(four, room, 99) == Batches{{2, {0, 1, 2, 3}}});
    room = kWide;
    room.range = three.longestBytes();
    CHECK(batchesOf(four, room, 99) == Batches{{3, {0, 1, 2, 3}}});
    room = kWide;
    room.members = 2;
    CHECK(batchesOf(four, room, 99) == Batches{{2, {0, 1, 2, 3}}});

    // Every place of a batch takes as much as the largest: a small one beside it does not fit where two small ones do.
    room = kWide;
    room.memory = large.allBytes();
    TableSizes two = small;
    two.members = 2;
    room.memory = std::max(two.allBytes(), large.allBytes());
    CHECK(batchesOf({{0, 4, small}, {1, 3, small}}, room, 99) == Batches{{2, {0, 1}}});
    CHECK(batchesOf({{0, 4, large}, {1, 3, small}, {2, 2, small}}, room, 99) == Batches{{1, {0, 1, 2}}});
    room.memory = 1;
    CHECK(batchesOf({{0, 4, large}, {1, 3, small}}, room, 99) == Batches{{1, {0, 1}}});
}
