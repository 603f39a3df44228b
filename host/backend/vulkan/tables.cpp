#include "host/backend/vulkan/tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "host/backend/vulkan/pack.h"
#include "host/core/error.h"
#include "host/model/rows.h"

namespace vkdose {

namespace {

constexpr std::uint64_t kIndices = 1ULL << 32;

static_assert(gpu::kMaxRow == kMaxNeighbours);  // what a case is checked against

std::uint64_t roundUp(std::uint64_t n, std::uint64_t unit) {
    return (n + unit - 1) / unit * unit;
}

std::uint32_t narrow(std::uint64_t n) {
    if (n >= kIndices)
        throw RunError(
            fmt::format("the tables need room for {} entries, of which 32 bits number no more than {}: use "
                        "fewer particles",
                        n, kIndices));
    return std::uint32_t(n);
}

/// Mean number of neighbours of a particle within reach and skin. In a dense random packing it is ten within 1.2
/// diameters, and it grows with the cube of the reach. At most twelve spheres of one size can touch one of them.
std::uint64_t meanRow(const World& world, const Crowd& crowd, double reach) {
    const double mean = std::ceil(10 * std::pow(1 + (world.skin + reach) / (2 * crowd.meanRadius), 3) + 2);
    return std::uint64_t(std::clamp(mean, 12.0, double(gpu::kMaxRow)));
}

/// Whether a wall or body is of another material than the usual ones of walls and coil.
bool hasManyWalls(const World& world) {
    return std::any_of(world.walls.begin(), world.walls.end(),
                       [](const Wall& w) { return w.material != kWallMaterial; }) ||
           std::any_of(world.bodies.begin(), world.bodies.end(),
                       [](const RigidBody& b) { return b.material != kWallMaterial && b.material != kCoilMaterial; });
}

std::string hashOf(const std::shared_ptr<const UserLaw>& law) {
    return law ? law->hash : "";
}

}  // namespace

Crowd::Crowd(const Particles& p)
    : count(p.size()), meanRadius(std::accumulate(p.radius.begin(), p.radius.end(), 0.0) / double(p.size())) {}

bool TableSizes::shares(const TableSizes& other) const {
    return surfaces == other.surfaces && surfaceKinds == other.surfaceKinds && kindSet == other.kindSet &&
           energyBook == other.energyBook && hashOf(userLaw) == hashOf(other.userLaw);
}

void TableSizes::growTo(const TableSizes& other) {
    for (const auto size :
         {&TableSizes::share, &TableSizes::cells, &TableSizes::rowEntries, &TableSizes::linkEntries,
          &TableSizes::pairSlots, &TableSizes::surfaceSlots, &TableSizes::bodySlots, &TableSizes::bodies})
        this->*size = std::max(this->*size, other.*size);
    shapeKinds |= other.shapeKinds;
    mostPlaces = std::max(mostPlaces, other.mostPlaces);
    laws |= other.laws;
    powders = std::max(powders, other.powders);
    manyWalls = std::max(manyWalls, other.manyWalls);
    wallLoads = std::max(wallLoads, other.wallLoads);
    outlets = std::max(outlets, other.outlets);
    periods = std::max(periods, other.periods);
}

bool TableSizes::holds(const TableSizes& other) const {
    TableSizes both = *this;
    both.growTo(other);
    const auto grown = [](const TableSizes& s) {
        return std::tuple(s.share, s.cells, s.rowEntries, s.linkEntries, s.pairSlots, s.surfaceSlots, s.bodySlots,
                          s.bodies, s.shapeKinds, s.mostPlaces, s.laws, s.powders, s.manyWalls, s.wallLoads, s.outlets,
                          s.periods);
    };
    return shares(other) && grown(both) == grown(*this);
}

TableCounts::TableCounts(const TableSizes& s)
    : canisters(s.members),
      particles(canisters * s.share),
      groups(s.groups()),
      cellHeads(s.cells),
      rowEntries(s.rowEntries),
      linkEntries(s.linkEntries),
      springSlots(canisters * (std::uint64_t(s.pairSlots) + s.surfaceSlots)),
      slots(springSlots + canisters * s.bodySlots),
      historyParts(s.historyParts()),
      energyBook(s.energyBook ? 1 : 0),
      bodySlots(canisters * s.bodySlots),
      bodies(s.bodies),
      bodied(s.bodies > 0 ? 1 : 0),
      loaded(s.loaded()),
      bodyHistory(s.bodyHistory()),
      propertied(s.properties() ? 1 : 0) {}

namespace {

/// Views of records show their vectors.
template <class Element>
constexpr VkFormat kViewOf = VK_FORMAT_R32G32B32A32_SFLOAT;
template <>
constexpr VkFormat kViewOf<gpu::uint> = VK_FORMAT_R32_UINT;
template <>
constexpr VkFormat kViewOf<glm::uvec2> = VK_FORMAT_R32G32_UINT;
template <>
constexpr VkFormat kViewOf<gpu::uvec4> = VK_FORMAT_R32G32B32A32_UINT;

template <class Element>
TableShape shape(const char* title, std::uint64_t count, bool viewed, std::size_t headBytes = 0) {
    const std::uint64_t elements = std::max<std::uint64_t>(1, count), bytes = elements * sizeof(Element);
    const std::uint64_t texel = std::min(sizeof(Element), sizeof(gpu::vec4));
    return {title, elements, bytes + headBytes, viewed ? kViewOf<Element> : VK_FORMAT_UNDEFINED, bytes / texel};
}

constexpr bool numberedInOrder() {
    std::uint32_t next = 0;
    for (const std::uint32_t number : {
#define TABLE(number, name, element, count, title) number##U,
#include "shaders/shared/tables.h"
         })
        if (number != next++) return false;
    return true;
}
static_assert(numberedInOrder(), "the bindings in shaders/shared/tables.h are 0, 1, 2, ...");

}  // namespace

std::array<TableShape, gpu::kTables> TableCounts::shapes() const {
    using namespace gpu;
    return {
#define TABLE(number, name, element, count, title) shape<element>(#title, count, false),
#define VIEWED(number, name, element, count, title) shape<element>(#title, count, true),
#define PARAMETERS(number, name, element, count, title) shape<element>(#title, count, true),
#define HEADED(number, name, element, count, title, head, headName) shape<element>(#title, count, false, sizeof(head)),
#include "shaders/shared/tables.h"
    };
}

std::uint64_t TableSizes::largestIndex() const {
    std::uint64_t most = 0;  // a link is no larger either: a slot and a bit, as the torques are numbered
    for (const TableShape& table : TableCounts(*this).shapes()) most = std::max(most, table.elements);
    return most - 1;
}

std::uint64_t TableSizes::allBytes() const {
    std::uint64_t sum = 0;
    for (const TableShape& table : TableCounts(*this).shapes()) sum += table.bytes;
    return sum;
}

std::uint64_t TableSizes::longestBytes() const {
    std::uint64_t most = 0;
    for (const TableShape& table : TableCounts(*this).shapes()) most = std::max(most, table.bytes);
    return most;
}

TableSizes tableSizes(const World& world, const Crowd& crowd, const gpu::Member& member, const DeviceShape& device,
                      std::uint32_t members, const std::shared_ptr<const UserLaw>& userLaw) {
    const std::uint64_t n = crowd.count, workgroup = device.workgroup;
    if (n * members > gpu::kMostParticles)
        throw RunError(fmt::format("{} particles; the Vulkan backend numbers {}", n * members,
                                   std::uint32_t(gpu::kMostParticles)));
    constexpr std::uint64_t kFew = 1024;  // so few that the mean says nothing
    TableSizes s;
    s.userLaw = userLaw;
    s.members = members;
    s.workgroup = device.workgroup;
    s.mostGroups = device.mostGroups;
    s.share = narrow(roundUp(n, workgroup * s.layers(narrow((n + workgroup - 1) / workgroup))));  // every layer full
    s.cells = 64;
    while (s.cells < 2 * n) s.cells *= 2;
    s.surfaces = std::uint32_t(world.walls.size());
    s.wallLoads = world.wallLoads ? 1U : 0U;
    for (std::uint32_t i = 0; i < s.surfaces; ++i) {
        const auto kind = std::uint32_t(member.surface[i].pointHigh.w);
        s.kindSet |= 1U << kind;
        if (kind == gpu::kFront) s.front = i;
        const bool wall = kind == gpu::kPlane || kind == gpu::kTrough;
        if (wall && member.surface[i].pointLow.w != 0) s.kindSet |= gpu::kEndingWalls;
        if (i < gpu::kUnrolledSurfaces) s.surfaceKinds |= kind << (4 * i);
    }
    for (const MaterialPair& pair : occurringPairs(world))
        s.laws |= 1U << std::uint32_t(member.contact[PairTable::index(pair)].springs.w) % gpu::kLawKinds;
    const std::vector<int> powders = powdersOf(world);
    s.powders = powders == std::vector{kFirstPowder} ? 1U : std::max(2U, std::uint32_t(powders.size()));
    s.manyWalls = hasManyWalls(world) ? 1U : 0U;
    s.outlets = std::uint32_t(
        std::count_if(world.regions.begin(), world.regions.end(), [](const CountRegion& r) { return r.deletes; }));
    s.periods = world.repeats() ? 1U : 0U;
    if (userLaw && reachOf(member) > 0) s.laws |= 1U << gpu::kUserReaches;
    s.energyBook = world.energyBook;

    const std::uint64_t most =
        device.range / (std::uint64_t(s.historyParts()) * sizeof(gpu::vec4) * members);  // slots in one buffer
    const std::uint64_t pairs = std::min(7 * n / 2 + kFew, n * (n - 1) / 2 + 1);
    const std::uint64_t surfaces = std::min(2 * n + kFew, n * s.surfaces);
    s.pairSlots = narrow(roundUp(pairs, workgroup));
    // If slots for two surfaces to a particle do not fit the device, slots for half a surface are enough, because most
    // particles of so large a bed touch no surface.
    const bool fits = s.pairSlots + surfaces + workgroup <= most;
    s.surfaceSlots = narrow(roundUp(fits ? surfaces : std::min(surfaces, n / 2), workgroup));
    s.bodies = std::uint32_t(allBodies(world).size());
    // A sphere is seldom near more than two bodies, and few are near any. Where that much does not fit the device, the
    // bodies get the room that pairs and surfaces leave; of so large a bed an eighth is enough.
    const std::uint64_t vectors = std::min(device.range / sizeof(gpu::vec4), kIndices - 1) / members;
    const std::uint64_t taken = std::uint64_t(s.historyParts()) * (s.pairSlots + s.surfaceSlots);
    const std::uint64_t left = vectors > taken ? (vectors - taken) / s.bodyHistory() / workgroup * workgroup : 0;
    const std::uint64_t wanted = std::min(2 * n + kFew, n * s.bodies);
    s.bodySlots = narrow(roundUp(std::min(wanted, std::max(left, n / 8)), workgroup));
    s.rowEntries =
        narrow(std::max<std::uint64_t>(1, std::min(n * meanRow(world, crowd, double(reachOf(member))) + kFew, n * n)));
    s.linkEntries = narrow(2ULL * s.pairSlots + s.surfaceSlots + s.bodySlots);
    narrow(s.largestIndex());
    return s;
}

TableSizes roomForAll(const std::vector<TableSizes>& members) {
    TableSizes all = members.at(0);
    all.members = std::uint32_t(members.size());
    for (const TableSizes& s : members) {
        if (!s.shares(all))
            throw RunError(
                "canisters can share a device's tables only if they have the same kinds of surfaces in the "
                "same order, all or none keep an energy book, and all follow one user's law or none");
        all.growTo(s);
    }
    narrow(all.largestIndex());
    return all;
}

}  // namespace vkdose
