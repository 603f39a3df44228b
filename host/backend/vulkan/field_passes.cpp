#include "host/backend/vulkan/field_passes.h"

#include <algorithm>
#include <array>
#include <vector>

#include "host/backend/vulkan/pass_code.h"
#include "spirv/passes.h"

namespace vkdose {

namespace {

/// Number of particles that one dispatch adds up. It is the number of bits of inReach in shaders/pass/tile.glsl. Even
/// with kMaxLinks contacts for each particle, and the nodes of these contacts, the loops of an invocation stay below
/// 65,535 trips, after which lavapipe ends them. Beside bodies there may be more contacts, so that slices are shorter.
constexpr std::uint32_t kSlice = 128, kSliceBesideBodies = 64;
constexpr std::uint32_t kContacts = gpu::kMaxRow + gpu::kMaxSurfaces + gpu::kMaxBodyTouches;
constexpr std::uint32_t kOnBodies = kMaxBodies * gpu::kMaxBodyTouches;
static_assert(kSlice * (kContacts * (gpu::kFieldNodes + 1) + 2) < 65535);
static_assert(kSliceBesideBodies * ((kContacts + kOnBodies) * (gpu::kFieldNodes + 1) + std::uint32_t(kMaxBodies) + 2) <
              65535);
static_assert(gpu::kMaxRow + gpu::kMaxSurfaces + 1 + kMaxBodies <= gpu::kMaxLinks);

/// The block of points for one workgroup. Its edges are powers of two; it is as close to a cube as they allow, and no
/// longer than the grid.
std::array<std::uint32_t, 3> tileOf(const FieldGrid& grid, std::uint32_t workgroup) {
    std::array<std::uint32_t, 3> tile{1, 1, 1};
    for (std::uint32_t points = 1; points < workgroup; points *= 2) {
        int shortest = -1;
        for (int d = 0; d < 3; ++d) {
            const auto at = std::size_t(d);
            if (tile[at] >= grid.cells[at]) continue;
            if (shortest < 0 || tile[at] * grid.cell()[d] < tile[std::size_t(shortest)] * grid.cell()[shortest])
                shortest = d;
        }
        if (shortest < 0) break;
        tile[std::size_t(shortest)] *= 2;
    }
    return tile;
}

gpu::FieldParams pack(const FieldRequest& r, const TableSizes& sizes, double largestRadius) {
    const FieldGrid& g = r.grid;
    const Vec3 cell = g.cell(), size = g.high - g.low;
    const std::array<std::uint32_t, 3> tile = tileOf(g, sizes.workgroup);
    gpu::FieldParams p{};
    p.low = gpu::vec4(glm::vec3(g.low), float(r.reach()));
    p.size = gpu::vec4(glm::vec3(size), float(r.width));
    p.cell = gpu::vec4(glm::vec3(cell), float(g.cellVolume()));
    // A branch is at most two radii long. The factor is a little larger, because the particle has moved since the force
    // acted.
    p.along = gpu::vec4(g.resolved(0), g.resolved(1), g.resolved(2), float(2.1 * largestRadius));
    p.points =
        gpu::uvec4(g.cells[0], g.cells[1], g.cells[2], r.kernel == Kernel::Gaussian ? gpu::kGaussian : gpu::kLucy);
    p.tile = gpu::uvec4(tile[0], tile[1], tile[2], r.contactStress ? 1 : 0);
    for (int d = 0; d < 3; ++d) p.tiles[d] = (p.points[d] + p.tile[d] - 1) / p.tile[d];
    p.tiles.w = sizes.bodies > 0 ? kSliceBesideBodies : kSlice;
    p.chosen.x = r.material ? std::uint32_t(*r.material) + 1 : 0;
    return p;
}

FieldPoint unpack(const gpu::vec4* v, bool properties) {
    FieldPoint p;
    const gpu::vec4 &mass = v[gpu::kFieldMass], &number = v[gpu::kFieldNumber], &kinetic = v[gpu::kFieldKinetic];
    p.density = double(mass.x);
    p.momentum = Vec3(mass.y, mass.z, mass.w);
    p.number = double(number.x);
    p.touches = double(number.y);
    p.kineticStress = {double(number.z),  double(number.w),  double(kinetic.x),
                       double(kinetic.y), double(kinetic.z), double(kinetic.w)};
    for (std::size_t row = 0; row < 3; ++row) p.contactStress[row] = Vec3(glm::vec3(v[gpu::kFieldContact + row]));
    for (std::size_t k = 0; k < p.properties.size() && properties; ++k)
        p.properties[k] = double(v[gpu::kFieldProperties][int(k)]);
    return p;
}

}  // namespace

namespace {

/// The sizes that shaders/shared/field_tables.h counts with, and the bytes of its tables.
struct FieldCounts {
    std::uint64_t points, particles, forceEntries;

#define TABLE(number, name, element, count, title) \
    std::uint64_t name##Bytes() const {            \
        using namespace gpu;                       \
        return (count) * sizeof(element);          \
    }
#include "shaders/shared/field_tables.h"
};

/// The tables of a step, some of which are replaced by those of the field passes.
std::vector<const vk::Buffer*> with(const FieldTables& own, std::vector<const vk::Buffer*> tables) {
#define TABLE(number, name, element, count, title) tables[number] = &own.name;
#include "shaders/shared/field_tables.h"
    return tables;
}

unsigned macrosFor(const TableSizes& s) {
    return (s.energyBook ? spirv::ENERGY_BOOK : 0) | (s.bodies > 0 ? spirv::WITH_BODIES : 0);
}

}  // namespace

FieldTables::FieldTables(const vk::Device& device, const Tables& tables, std::size_t n)
    : points(n)
#define TABLE(number, name, element, count, title)                                                           \
    , name(device, #title,                                                                                   \
           FieldCounts{n, tables.sizes.particles(), tables.forces.size() / sizeof(gpu::vec4)}.name##Bytes(), \
           VK_FORMAT_UNDEFINED, tables.access.addressed ? vk::Reach::Addressed : vk::Reach::Bound)
#include "shaders/shared/field_tables.h"
{
}

FieldPasses::FieldPasses(const vk::Device& device, const Passes& p, std::size_t points)
    : device_(device),
      passes_(p),
      own_(device, p, points),
      bindings_(device, with(own_, p.all()), sizeof(gpu::StepPush)),
      branchBindings_(device, p.bodies != nullptr ? with(*p.bodies, with(own_, p.all())) : with(own_, p.all()),
                      sizeof(gpu::StepPush)),
      branches_(device, branchBindings_,
                passCode("field_branches", spirv::field_branches,
                         {macrosFor(p.sizes), p.sizes.userLaw.get(), p.access.addressed}),
                Passes::constants(p.sizes)),
      weigh_(device, bindings_, passCode("field_weights", spirv::field_weights, {0, nullptr, p.access.addressed}),
             Passes::constants(p.sizes)),
      sums_(device, bindings_,
            passCode("field_sums", spirv::field_sums,
                     {0, p.sizes.properties() ? p.sizes.userLaw.get() : nullptr, p.access.addressed}),
            Passes::constants(p.sizes)),
      kinetic_(device, bindings_, passCode("field_kinetic", spirv::field_kinetic, {0, nullptr, p.access.addressed}),
               Passes::constants(p.sizes)) {}

void FieldPasses::dispatch(vk::Commands& commands, const vk::Pipeline& pass, std::uint32_t groups) const {
    pass.bind(commands.handle());
    commands.dispatch(passes_.sizes.inRow(groups), 1, passes_.sizes.layers(groups));
    commands.barrier();
}

FieldPoints FieldPasses::compute(const FieldRequest& request, const Moment& moment) {
    const TableSizes& s = passes_.sizes;
    gpu::FieldParams params = pack(request, s, moment.largestRadius);
    params.tables = gpu::uvec4(addressWords(own_.weights), addressWords(own_.branches));
    own_.fields.write(0, &params, sizeof params);
    const std::uint32_t contacts = s.pairSlots + s.surfaceSlots + gpu::kMaxBodyTouches * s.bodySlots;
    const std::uint32_t tiles = params.tiles.x * params.tiles.y * params.tiles.z;

    vk::Commands commands(device_);
    commands.begin();
    gpu::StepPush push = passes_.push(0, false);
    push.firstRow = moment.row;
    if (request.contactStress) {
        branchBindings_.bind(commands.handle());
        branchBindings_.push(commands.handle(), &push);
        dispatch(commands, branches_, contacts / s.workgroup);
    }
    bindings_.bind(commands.handle());
    bindings_.push(commands.handle(), &push);
    const std::uint32_t places = s.share + (request.contactStress ? gpu::kFieldNodes * contacts : 0);
    dispatch(commands, weigh_, places / s.workgroup);
    commands.hostBarrier();
    commands.submit();
    for (const vk::Pipeline* pass : {&sums_, &kinetic_})
        for (push.slice = 0; push.slice < s.share;) {
            std::uint32_t count = 0;
            commands.begin();
            bindings_.bind(commands.handle());
            slices_.begin();
            for (; count < slices_.count() && push.slice < s.share; ++count, push.slice += params.tiles.w) {
                bindings_.push(commands.handle(), &push);
                dispatch(commands, *pass, tiles);
            }
            commands.hostBarrier();
            commands.submit();
            slices_.end(count);
        }

    const auto vectors = own_.grid.readAll<gpu::vec4>(gpu::kFieldVectors * request.grid.points());
    FieldPoints points;
    points.reserve(request.grid.points());
    for (std::size_t k = 0; k < request.grid.points(); ++k)
        points.push_back(unpack(&vectors[gpu::kFieldVectors * k], s.properties()));
    return points;
}

}  // namespace vkdose
