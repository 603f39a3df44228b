#include "host/backend/vulkan/pack_bodies.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "host/backend/vulkan/pack.h"
#include "host/backend/vulkan/pack_mesh.h"
#include "host/backend/vulkan/split.h"
#include "host/core/error.h"

namespace vkdose {

namespace {

using geometry::MeshSurface;
using gpu::uvec4;
using gpu::vec4;

static_assert(gpu::kMaxBodyFeatures == geometry::kMaxFeatures);
static_assert(gpu::kShapeRoom == std::uint32_t(geometry::ShapeKind::Room));
static_assert(gpu::kShapePlane == gpu::kPlane && gpu::kShapeTrough == gpu::kTrough && gpu::kShapeTube == gpu::kTube &&
              gpu::kShapeFront == gpu::kFront);
static_assert(sizeof(gpu::BodyMotion) == gpu::kMotionVectors * sizeof(vec4));

const Around kAroundEndless{Vec3(0), double(gpu::kEverywhere)};

class Packer {
  public:
    Packer(double largest, double slack) : largest_(largest), reach_(largest + slack) {}

    PackedBodies packed(const std::vector<RigidBody>& bodies) {
        table_.assign(std::max<std::size_t>(1, gpu::kBodyVectors * bodies.size()), uvec4(0));
        for (std::size_t b = 0; b < bodies.size(); ++b) {
            name_ = bodies[b].name;
            nextTag_ = places_ = 0;
            const auto first = table_.size(), count = bodies[b].shapes.size();
            table_.resize(first + gpu::kShapeVectors * count);
            std::vector<Around> around;
            for (std::size_t s = 0; s < count; ++s) {
                shape_ = first + gpu::kShapeVectors * s;
                around.push_back(std::visit([&](const auto& shape) { return pack(shape); }, bodies[b].shapes[s]));
                table_[shape_ + 1] = sphere(around.back());
            }
            most_ = std::max(most_, std::min(places_, uint32_t(gpu::kFewPlaces)));
            table_[gpu::kBodyVectors * b] = uvec4(tableIndex(first), tableIndex(count), 0, 0);
            table_[gpu::kBodyVectors * b + 1] = sphere(aroundAll(around));
        }
        return {std::move(table_), kinds_, most_};
    }

  private:
    /// A little larger, so that rounding leaves nothing outside.
    static uvec4 sphere(const Around& around) {
        return bits(glm::vec3(around.centre), float(around.radius * (1 + 1e-6) + 1e-6 * glm::length(around.centre)));
    }

    static Around aroundAll(const std::vector<Around>& parts) {
        Vec3 low(geometry::kEndless), high(-geometry::kEndless);
        for (const Around& a : parts) {
            if (a.radius >= double(gpu::kEverywhere)) return kAroundEndless;
            low = glm::min(low, a.centre - a.radius);
            high = glm::max(high, a.centre + a.radius);
        }
        if (parts.empty()) return {};
        Around all{0.5 * (low + high), 0};
        for (const Around& a : parts) all.radius = std::max(all.radius, glm::length(a.centre - all.centre) + a.radius);
        return all;
    }

    /// Begins the record of a shape that a sphere touches in at most `places` places at once.
    void head(uint32_t kind, uint32_t tags, uint32_t places, uint32_t heads = 0, uint32_t lists = 0) {
        table_[shape_] = uvec4(kind, nextTag_, heads, lists);
        nextTag_ += tags;
        places_ += places;
        kinds_ |= 1u << kind;
    }

    void set(std::size_t vector, const vec4& v) { table_[shape_ + vector] = bits(v); }

    void setPair(std::size_t at, const geometry::ShapeRecord::Pair& pair) {
        const Split3 p(pair.vector);
        const Split l(pair.last);
        set(at, vec4(p.high, l.high));
        set(at + 1, vec4(p.low, l.low));
    }

    void setScalars(std::size_t at, const std::array<double, 2>& two) {
        const Split a(two[0]), b(two[1]);
        set(at, vec4(a.high, a.low, b.high, b.low));
    }

    /// A shape that the device has no tables for.
    template <class Exact>
    Around pack(const Exact& shape) {
        const geometry::ShapeRecord r = shape.record();
        head(std::uint32_t(r.kind), r.places, r.places);
        setPair(2, r.first);
        setPair(4, r.second);
        setScalars(6, r.sizes);
        setScalars(7, r.more);
        return r.around.value_or(kAroundEndless);
    }

    gpu::CoilParams wireParams(const geometry::Coil& c) const {
        const double reach = largest_ + c.wireRadius;
        if (reach >= c.radius)
            throw RunError(
                fmt::format("body \"{}\": a particle of radius {} m can touch the wire across its axis (radius {} m): "
                            "the device covers smaller ones; use --backend reference",
                            name_, largest_, c.radius));
        if (c.length / c.pitch > 250)
            throw RunError(
                fmt::format("body \"{}\": the wire has {:.0f} turns; the device's exact range reduction covers 250",
                            name_, c.length / c.pitch));
        const double kappa = c.hand * 2 * kPi / c.pitch;
        // The sphere can touch the wire only within this angle as seen from its centre. It is a little larger because
        // of rounding.
        const double widest = std::min(std::asin(reach / c.radius) * 1.0001 + 1e-6, kPi / 2);
        const double bound = std::abs(kappa) * reach + widest;
        const double turnsEachSide = std::ceil((bound + kPi) / (2 * kPi)) - 1;
        const Split start(c.zStart), radius(c.radius);
        gpu::CoilParams p{};
        p.radius = vec4(radius.high, radius.low, float(c.wireRadius), float(c.length));
        // The leading 16 bits of the pitch times a small integer are exact in a float.
        const float leading = std::bit_cast<float>(bits(float(c.pitch)) & 0xffffff00u);
        p.pitch = vec4(float(c.pitch), leading, float(c.pitch - double(leading)), float(kappa));
        p.reach = vec4(float(widest), float(turnsEachSide), start.high, start.low);
        return p;
    }

    Around pack(const geometry::Coil& wire) {
        const gpu::CoilParams p = wireParams(wire);
        head(gpu::kShapeWire, uint32_t(wire.length / wire.pitch) + 3, 2 * uint32_t(p.reach.y) + 1);
        set(2, p.radius);
        set(3, p.pitch);
        set(4, p.reach);
        const double turns = wire.startAngle / (2 * kPi);
        set(7, vec4(float(turns - std::round(turns)), 0, 0, 0));
        return {Vec3(0, 0, wire.zStart + wire.length / 2), std::hypot(wire.radius, wire.length / 2) + wire.wireRadius};
    }

    Around pack(const geometry::Flight& f) {
        const double turns = f.angle / (2 * kPi), change = (f.pitchEnd - f.pitchStart) / turns;
        const double least = std::min(f.pitchStart, f.pitchEnd), most = std::max(f.pitchStart, f.pitchEnd);
        if ((2 * reach_ + f.thickness) / least + 3 > double(gpu::kMostFlightTurns))
            throw RunError(
                fmt::format("body \"{}\": a sphere can reach {:.0f} turns of the screw; the device holds {}. Use a "
                            "larger pitch, smaller spheres, or --backend reference",
                            name_, (2 * reach_ + f.thickness) / least + 3, uint32_t(gpu::kMostFlightTurns)));
        head(gpu::kShapeFlight, uint32_t(turns) + 2, gpu::kFewPlaces);
        setScalars(2, {f.innerRadius, f.outerRadius});
        const bool simple = least * least >= reach_ * std::abs(change);
        set(3, vec4(float(f.thickness / 2), float(change / 2), float(f.hand), simple ? 1.0f : 0.0f));
        const double whole = std::floor(turns), start = f.startAngle / (2 * kPi);
        table_[shape_ + 4] =
            uvec4(tableIndex(table_.size()), uint32_t(whole) + 3, uint32_t(whole), bits(float(turns - whole)));
        set(5, vec4(float(start - std::round(start)), float(f.pitchStart), float(change),
                    float(f.height(f.angle) - f.zStart)));
        set(6, vec4(float(f.zStart), float((most + std::abs(change)) / (2 * kPi)), 0, 0));
        for (int n = -1; n <= int(whole) + 1; ++n) {
            const Split z(f.height(2 * kPi * n));
            table_.push_back(bits(vec4(z.high, z.low, float(2 * kPi * f.slope(2 * kPi * n)), 0)));
        }
        const double height = f.height(f.angle) - f.zStart;
        return {Vec3(0, 0, f.zStart + height / 2), std::hypot(f.outerRadius, (height + f.thickness) / 2)};
    }

    Around pack(const std::shared_ptr<const MeshSurface>& surface) {
        if (surface->reach() < reach_) return pack(MeshSurface(surface->mesh(), reach_));
        return pack(*surface);
    }

    Around pack(const MeshSurface& surface) {
        const PackedMesh mesh = appendMesh(surface, name_, table_);
        head(gpu::kShapeMesh, mesh.tags, gpu::kFewPlaces, mesh.heads, mesh.lists);
        std::copy(mesh.rest.begin(), mesh.rest.end(), table_.begin() + std::ptrdiff_t(shape_ + 2));
        return mesh.around;
    }

    double largest_, reach_;
    std::string name_;  ///< of the body at work
    std::vector<uvec4> table_;
    std::size_t shape_ = 0;              ///< where the record of the shape at work begins
    uint32_t nextTag_ = 0, places_ = 0;  ///< of the body at work
    uint32_t kinds_ = 0, most_ = 1;
};

}  // namespace

PackedBodies packBodies(const std::vector<RigidBody>& bodies, double largest, double slack) {
    return Packer(largest, slack).packed(bodies);
}

gpu::BodyMotion packMotion(const RigidBody& body, const geometry::Pose& pose, const geometry::Moving& moving) {
    gpu::BodyMotion m{};
    const glm::dmat3 rotation = glm::mat3_cast(pose.rotation);
    const Split3 origin(pose.origin);
    for (int i = 0; i < 3; ++i) {
        // A row of the way to the body is a column of the rotation.
        const Split3 row(rotation[i]);
        m.toBodyHigh[i] = vec4(row.high, origin.high[i]);
        m.toBodyLow[i] = vec4(row.low, origin.low[i]);
    }
    m.velocity = vec4(glm::vec3(moving.velocity), float(body.material));
    m.spin = vec4(glm::vec3(moving.spin), body.surfaceMoves ? 1.0f : 0.0f);
    m.centre = vec4(glm::vec3(moving.centre), float(body.curvature));
    m.pivot = vec4(glm::vec3(body.pivot(pose)), 0);
    return m;
}

}  // namespace vkdose
