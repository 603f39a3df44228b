#include "host/backend/vulkan/pack.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>

#include "host/backend/vulkan/split.h"
#include "host/core/error.h"
#include "host/law/law.h"

namespace vkdose {

namespace {

using gpu::vec4;

// The device uses the same numbers as the host.
static_assert(gpu::kStatusActive == uint32_t(Status::Active) && gpu::kStatusDosed == uint32_t(Status::Dosed) &&
              gpu::kStatusLost == uint32_t(Status::Lost) && gpu::kStatusAbsent == uint32_t(Status::Waiting));
static_assert(gpu::kFirstPowder == kFirstPowder && gpu::kWallMaterial == kWallMaterial &&
              gpu::kCoilMaterial == kCoilMaterial && gpu::kMostMaterials == kMostMaterials);
static_assert(gpu::pairIndex(2, 5) == PairTable::index({2, 5}) && gpu::pairIndex(5, 2) == gpu::pairIndex(2, 5));
static_assert(gpu::kLawUser == uint32_t(NormalLaw::User));
static_assert(gpu::kOwnProperties == kMostLawProperties && kMostLawProperties == 4);
static_assert(gpu::kOwnParameters == kMostLawParameters && gpu::kOwnMemories == kMostLawMemories);
static_assert(gpu::kLeverFull == uint32_t(RollingLever::Full) && gpu::kLeverHalf == uint32_t(RollingLever::Half));

gpu::ContactParams packContact(const ContactParameters& c) {
    gpu::ContactParams p{};
    const bool bySize = c.coulombLimit == CoulombLimit::Absolute;
    p.springs =
        vec4(float(c.kt), float(c.kr), float(c.kTo), float(uint32_t(c.law) + (bySize ? gpu::kLimitAbsolute : 0)));
    const LawLanes lanes = normalLaw(c).lanes(c);
    for (int k = 0; k < 4; ++k) p.normal[k] = float(lanes.normal[std::size_t(k)]);
    p.friction = vec4(float(c.mu), float(c.muR), float(c.muTo), float(lanes.constant));
    p.damping = vec4(float(c.gammaT), float(c.gammaR), float(c.gammaTo), float(lanes.damping));
    for (std::size_t k = 0; k < c.own.size(); ++k) p.own[k / 4][int(k % 4)] = float(c.own[k]);
    return p;
}

vec4 radiusPair(double r) {
    Split s(r);
    return {s.high, s.low, 0.0f, 0.0f};
}

gpu::SurfaceParams packed(uint32_t kind, const Vec3& point, double side, const Vec3& axis, double length,
                          double radius) {
    Split3 p(point);
    gpu::SurfaceParams s{};
    s.pointHigh = vec4(p.high, float(kind));
    s.pointLow = vec4(p.low, float(side));
    s.axis = vec4(glm::vec3(axis), float(std::min(length, 1e30)));
    s.radius = radiusPair(radius);
    return s;
}

struct PackSurface {
    gpu::SurfaceParams operator()(const geometry::Plane& g) const {
        // A plane that ends is parallel to z, so that the point may be moved along z to the end.
        if (g.end < geometry::kEndless)
            return packed(gpu::kPlane, Vec3(g.point.x, g.point.y, g.end), 1, g.normal, 0, 0);
        return packed(gpu::kPlane, g.point, 0, g.normal, 0, 0);
    }
    gpu::SurfaceParams operator()(const geometry::Trough& g) const {
        const bool ends = g.end < geometry::kEndless;
        return packed(gpu::kTrough, Vec3(0, 0, ends ? g.end : 0), ends ? 1 : 0, Vec3(0), 0, g.halfWidth);
    }
    gpu::SurfaceParams operator()(const geometry::Tube& g) const {
        return packed(gpu::kTube, g.base, g.inside ? 1 : -1, g.axis, g.length, g.radius);
    }
    gpu::SurfaceParams operator()(const geometry::Front& g) const {
        return packed(gpu::kFront, Vec3(0, 0, g.z), 1, Vec3(0, 0, 1), g.throatLength, g.holeRadius);
    }
};

static_assert(gpu::kMaxRegionOutlets == kMaxOutlets);

void packOutlets(const World& world, gpu::Member& m) {
    std::size_t k = 0;
    for (const CountRegion& region : world.regions) {
        if (!region.deletes) continue;
        if (k == gpu::kMaxRegionOutlets) throw RunError(fmt::format("more than {} regions that delete", k));
        const bool box = region.kind == CountRegion::Kind::Box;
        m.outlets[2 * k] = vec4(glm::vec3(box ? region.low : region.normal), box ? 2.0f : 1.0f);
        m.outlets[2 * k + 1] = vec4(glm::vec3(region.high), float(glm::dot(region.point, region.normal)));
        ++k;
    }
}

}  // namespace

float reachOf(const gpu::Member& member) {
    return std::bit_cast<float>(member.roster.w);
}

void packLaw(const ContactLaw& law, gpu::Member& member) {
    std::transform(law.pairs.begin(), law.pairs.end(), member.contact, packContact);
    member.choices.x = float(law.rollingLever);
}

void packGravity(const World& world, gpu::Member& m) {
    m.gravity = vec4(glm::vec3(world.gravity), float(world.density()));
}

gpu::Member packMember(const World& world, const ContactLaw& law, const Particles& particles) {
    if (world.walls.size() > gpu::kMaxSurfaces)
        throw RunError(
            fmt::format("{} walls; the Vulkan backend holds {}", world.walls.size(), uint32_t(gpu::kMaxSurfaces)));
    checkMaterials(world, law, particles);
    gpu::Member m{};
    packLaw(law, m);
    m.choices.y = 1.0f;
    for (std::size_t i = 0; i < world.walls.size(); ++i) {
        const Wall& wall = world.walls[i];
        if (std::holds_alternative<geometry::Front>(wall.shape) && i + 1 < world.walls.size())
            throw std::logic_error("the front wall must be the last one");
        m.surface[i] = std::visit(PackSurface{}, wall.shape);
        m.surface[i].radius.z = float(wall.material);
    }
    const double largest = largestRadius(particles), reach = longestReach(world, law, largest);
    const auto finite = [](double x) { return float(std::clamp(x, -1e30, 1e30)); };
    packGravity(world, m);
    for (std::size_t k = 0; k < world.materials.size(); ++k)
        m.densities[k / 4][int(k % 4)] = float(world.materials[k].density);
    for (std::size_t k = 0; k < world.materials.size(); ++k)
        for (std::size_t n = 0; n < kMostLawProperties; ++n)
            m.properties[k][int(n)] = float(world.materials[k].properties[n]);
    m.domainLow = vec4(glm::vec3(world.domain.low), finite(world.throatZ));
    m.domainHigh = vec4(glm::vec3(world.domain.high), finite(world.outletZ));
    packOutlets(world, m);
    const Split3 period(world.period);
    m.period[0] = vec4(period.high, 0.0f);
    m.period[1] = vec4(period.low, 0.0f);
    m.numerics = vec4(float(world.timeStep), float(world.skin), float(2 * largest + reach + world.skin),
                      float(world.maxOverlapRatio));
    m.roster.w = std::bit_cast<gpu::uint>(float(reach));
    return m;
}

std::array<double, 3> fromKept(const glm::dvec2& kept, const Vec3& period) {
    const bool x = period.x > 0, y = period.y > 0, z = period.z > 0;
    return {x ? kept.x : 0, y ? (x ? kept.y : kept.x) : 0, z ? kept.y : 0};
}

void packState(const Particles& p, std::size_t share, std::size_t first, std::vector<gpu::vec4>& half) {
    const auto all = std::uint32_t(half.size() / gpu::kFields);
    const auto at = [&](std::uint32_t field, std::size_t i) -> vec4& {
        return half[gpu::stateOffset(field, std::uint32_t(first + i), all)];
    };
    for (std::size_t i = 0; i < share; ++i) {
        vec4& position = at(gpu::kPosition, i);
        vec4& spin = at(gpu::kSpin, i);
        if (i >= p.size()) {
            spin.w = float(gpu::kStatusAbsent);
            continue;
        }
        Split3 x(p.position[i]);
        const bool active = p.status[i] == Status::Active;
        position = vec4(x.high, float(active ? p.radius[i] : -p.radius[i]));
        at(gpu::kResidue, i) = vec4(x.low, float(p.material[i]));
        at(gpu::kVelocity, i) = vec4(Split3(p.velocity[i]).high, 0.0f);
        spin = vec4(Split3(p.spin[i]).high, float(uint32_t(p.status[i])));
    }
}

std::vector<gpu::vec4> packSpeedLows(const Particles& p) {
    std::vector<gpu::vec4> lows;
    for (std::size_t i = 0; i < p.size(); ++i) {
        lows.emplace_back(Split3(p.velocity[i]).low, 0.0f);
        lows.emplace_back(Split3(p.spin[i]).low, 0.0f);
    }
    return lows;
}

std::vector<gpu::vec4> packProperties(const Particles& particles) {
    std::vector<gpu::vec4> packed;
    for (const LawProperties& of : particles.properties) {
        vec4 high(0.0f), low(0.0f);
        for (std::size_t k = 0; k < of.size(); ++k) {
            const Split split(of[k]);
            high[int(k)] = split.high;
            low[int(k)] = split.low;
        }
        packed.insert(packed.end(), {high, low});
    }
    return packed;
}

void unpackProperties(const std::vector<gpu::vec4>& packed, Particles& particles) {
    for (std::size_t i = 0; i < particles.properties.size(); ++i)
        for (std::size_t k = 0; k < kMostLawProperties; ++k)
            particles.properties[i][k] = double(packed[2 * i][int(k)]) + double(packed[2 * i + 1][int(k)]);
}

Particles unpackState(const std::vector<gpu::vec4>& half, const std::vector<gpu::vec4>& speedLows, std::size_t slots,
                      const Particles& loaded, const Vec3& period) {
    Particles p = loaded;
    if (period != Vec3(0)) p.gone.resize(p.size());
    const auto at = [&](std::uint32_t field, std::size_t i) {
        return half[gpu::stateOffset(field, std::uint32_t(i), std::uint32_t(slots))];
    };
    for (std::size_t i = 0; i < p.size(); ++i) {
        const auto sum = [](const vec4& high, const vec4& low) { return Vec3(glm::vec3(high)) + Vec3(glm::vec3(low)); };
        p.position[i] = sum(at(gpu::kPosition, i), at(gpu::kResidue, i));
        p.velocity[i] = sum(at(gpu::kVelocity, i), speedLows[2 * i]);
        p.spin[i] = sum(at(gpu::kSpin, i), speedLows[2 * i + 1]);
        p.status[i] = Status(uint32_t(at(gpu::kSpin, i).w));
        if (p.gone.empty()) continue;
        const auto gone = fromKept({double(speedLows[2 * i].w), double(speedLows[2 * i + 1].w)}, period);
        p.gone[i] = glm::ivec3(glm::dvec3(gone[0], gone[1], gone[2]));
    }
    return p;
}

}  // namespace vkdose
