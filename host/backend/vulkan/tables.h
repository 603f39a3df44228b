#pragma once
// How much room the device's tables need for worlds and their particles.

#include <volk.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "host/model/particles.h"
#include "host/model/world.h"
#include "shaders/shared/layout.h"

namespace vkdose {

/// Sizes of the tables. Every member gets as much room as the one that needs most.
struct TableSizes {
    std::uint32_t members = 1;
    std::uint32_t workgroup = 64;
    std::uint32_t mostGroups = 65535;  ///< in a row of a dispatch; 65535 is what every device can do
    std::uint32_t surfaces = 0;
    std::uint32_t surfaceKinds = 0;          ///< of the first kUnrolledSurfaces, 4 bits each
    std::uint32_t kindSet = 0;               ///< bit k: there is a surface of kind k; and kEndingWalls
    std::uint32_t front = 0;                 ///< the front wall among the surfaces, if there is one
    std::uint32_t bodies = 0;                ///< most bodies of a member, its coil counted
    std::shared_ptr<const UserLaw> userLaw;  ///< of all members; null: they follow the program's own
    std::uint32_t laws = 0;                  ///< bit k: contacts of some pair follow the law k (NormalLaw)
    std::uint32_t powders = 1;               ///< 1: all particles are of the first powder
    std::uint32_t manyWalls = 0;             ///< 1: a wall or body is of another material than the usual ones
    std::uint32_t wallLoads = 0;             ///< 1: the loads on the walls of a member are summed
    std::uint32_t outlets = 0;               ///< most regions of a member that delete
    std::uint32_t periods = 0;               ///< 1: a direction of a member repeats
    std::uint32_t shapeKinds = 0;            ///< bit k: a body has a shape of kind k (shaders/shared/geometry.h)
    std::uint32_t mostPlaces = 1;  ///< in which a sphere touches a body at once; gpu::kFewPlaces: that or more
    // Of each member:
    std::uint32_t share = 0;  ///< slots for particles, a multiple of the workgroup
    std::uint32_t cells = 0;  ///< a power of two
    std::uint32_t rowEntries = 0, linkEntries = 0;
    std::uint32_t pairSlots = 0, surfaceSlots = 0, bodySlots = 0;  ///< multiples of the workgroup
    bool energyBook = false;
    bool texelReads = true;  ///< wanted; used if every view fits the device's limit
    bool addressed = false;  ///< wanted; used in any case where a table is longer than the device binds

    /// Whether canisters of these sizes can share tables: surfaces of the same kinds in the same order, an energy book
    /// for all or for none, and one user's law or none.
    bool shares(const TableSizes& other) const;
    /// Grows so that each member has at least as much room as in `other`.
    void growTo(const TableSizes& other);
    /// Whether each member has as much room as in `other`, and passes made for these sizes know all that it has.
    bool holds(const TableSizes& other) const;

    /// Whose loads are summed: the bodies, and behind the most of them the surfaces if one member wants those.
    std::uint32_t loaded() const { return bodies + wallLoads * surfaces; }
    std::uint32_t groups() const { return share / workgroup; }
    /// As `spread` in shaders/shared/buffers.glsl.
    std::uint32_t layers(std::uint32_t groups) const { return std::max(1U, (groups + mostGroups - 1) / mostGroups); }
    std::uint32_t inRow(std::uint32_t groups) const { return (groups + layers(groups) - 1) / layers(groups); }
    // Of all members, and where a member's begin (shaders/shared/buffers.glsl):
    std::uint32_t particles() const { return members * share; }
    std::uint32_t springSlots() const { return members * (pairSlots + surfaceSlots); }
    std::uint32_t slots() const { return springSlots() + members * bodySlots; }
    std::uint32_t firstPairSlot(std::uint32_t member) const { return member * pairSlots; }
    std::uint32_t firstSurfaceSlot(std::uint32_t member) const { return members * pairSlots + member * surfaceSlots; }
    std::uint32_t firstBodySlot(std::uint32_t member) const { return springSlots() + member * bodySlots; }
    /// Number of vectors in a contact's history (kParts in shared/buffers.glsl).
    std::uint32_t historyParts() const {
        return ownPart() + (userLaw ? 2U : (laws & gpu::kOverlapKeepers) != 0 ? 1U : 0U);
    }
    /// Whether a user's law gives particles properties.
    bool properties() const { return userLaw && !userLaw->properties.empty(); }
    /// Where in it a user's law has its memory, or another law the overlap of the last step (kOwnPart).
    std::uint32_t ownPart() const { return energyBook ? 5 : 2; }
    /// The same of a place on a body, and of a body slot (kPlaceParts, kBodyHistory).
    std::uint32_t placeParts() const { return historyParts() + 1; }
    std::uint32_t bodyHistory() const { return gpu::kMaxBodyTouches * placeParts(); }
    /// The largest index into any table, which must stay below 2^32. It counts the elements of the table, for example
    /// vectors.
    std::uint64_t largestIndex() const;
    /// Of all tables together, and of the longest [bytes].
    std::uint64_t allBytes() const;
    std::uint64_t longestBytes() const;
};

/// One table on the device, as shaders/shared/tables.h lists it.
struct TableShape {
    const char* title;       ///< for messages
    std::uint64_t elements;  ///< at least one
    std::uint64_t bytes;     ///< of all elements, and of the head if it has one
    VkFormat view;           ///< of a texel view; undefined where no pass reads the table through one
    std::uint64_t texels;    ///< of the view
};

/// The sizes that shaders/shared/tables.h uses, for all members together, and where in a table an element is. They have
/// 64 bits, because the tables are counted before it is known whether 32 bits are enough to number their elements.
struct TableCounts {
    std::uint64_t canisters, particles, groups, cellHeads, rowEntries, linkEntries, springSlots, slots, historyParts,
        energyBook, bodySlots, bodies, bodied, loaded, bodyHistory, propertied;

    explicit TableCounts(const TableSizes& sizes);
    std::array<TableShape, gpu::kTables> shapes() const;  ///< in the order of the bindings

#define TABLE(number, name, element, count, title)
#define ROW(table, function, first, length)         \
    std::uint64_t function(std::uint64_t i) const { \
        using namespace gpu;                        \
        return (first) + i;                         \
    }
#define ROWS(table, function, first, rows, length)                     \
    std::uint64_t function(std::uint64_t row, std::uint64_t i) const { \
        using namespace gpu;                                           \
        return (first) + row * (length) + i;                           \
    }
#include "shaders/shared/tables.h"
};

/// How many spheres, and how large on average [m].
struct Crowd {
    std::uint64_t count = 0;
    double meanRadius = 0;
    Crowd(std::uint64_t n, double mean) : count(n), meanRadius(mean) {}
    explicit Crowd(const Particles& particles);
};

struct DeviceShape {
    std::uint32_t workgroup = 64;
    std::uint32_t mostGroups = 65535;
    std::uint64_t range = 1ULL << 27;  ///< longest table [bytes]
};

/// Sizes for one member if `members` of its kind share the tables. All particles of a member share its rows and slots,
/// so that these are sized for the mean of a dense packing. The device reports a full table (kErrorTables). Throws
/// RunError if indices of 32 bits are not enough.
TableSizes tableSizes(const World& world, const Crowd& crowd, const gpu::Member& member, const DeviceShape& device,
                      std::uint32_t members = 1, const std::shared_ptr<const UserLaw>& userLaw = nullptr);

/// Room for all these members. Throws RunError if they cannot share tables because their surfaces differ in kind or
/// order, because only some keep an energy book, or because their users' laws differ.
TableSizes roomForAll(const std::vector<TableSizes>& members);

}  // namespace vkdose
