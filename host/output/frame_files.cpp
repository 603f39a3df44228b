#include "host/output/frame_files.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "host/output/hdf5.h"

namespace vkdose {

namespace {

using vtkhdf::Array;

constexpr const char* kBodyClocks = "body_clocks";
constexpr const char* kBodyShifts = "body_shifts";
constexpr const char* kBodyAngles = "body_angles";
constexpr const char* kPeriodsGone = "periods_gone";

std::vector<double> flat(const std::vector<Vec3>& vectors) {
    std::vector<double> values;
    values.reserve(3 * vectors.size());
    for (const Vec3& v : vectors) values.insert(values.end(), {v.x, v.y, v.z});
    return values;
}

std::vector<Vec3> vectors(const std::vector<double>& values) {
    std::vector<Vec3> result(values.size() / 3);
    for (std::size_t i = 0; i < result.size(); ++i)
        result[i] = Vec3(values[3 * i], values[3 * i + 1], values[3 * i + 2]);
    return result;
}

double kineticEnergy(const World& world, const Particles& p, std::size_t i) {
    return 0.5 * massOf(world, p, i) * glm::dot(p.velocity[i], p.velocity[i]);
}

/// The geometry of a contact at the instant of the frame, which is a drift after its force acted.
struct Geometry {
    Vec3 end;        ///< the other's centre, or the point of the wall [m]
    Vec3 normal;     ///< towards the particle
    double overlap;  ///< negative if the two have just parted [m]
};

/// A contact with a body, or the coil, does not say at which place it is. It is given the place along whose normal its
/// force is strongest.
class ContactGeometry {
  public:
    ContactGeometry(const Frame& frame, const World& world) : frame_(frame), world_(world), bodies_(allBodies(world)) {}

    Geometry of(const Contact& c) const {
        const Particles& p = frame_.particles;
        const Vec3& x = p.position[c.particle];
        const double r = p.radius[c.particle];
        if (c.kind == ContactClass::ParticleParticle) {
            const Vec3 apart = world_.shortest(x - p.position[c.other]);
            const double distance = glm::length(apart);
            return {x - apart, apart / distance, r + p.radius[c.other] - distance};
        }
        const std::size_t walls = world_.walls.size();
        if (c.other < walls) return against(geometry::closestPoint(world_.walls[c.other].shape, x), r);
        return placeOn(c.other - walls, c);
    }

  private:
    static Geometry against(const geometry::Closest& surface, double radius) {
        return {surface.point, surface.normal, radius - surface.distance};
    }

    Geometry placeOn(std::size_t index, const Contact& c) const {
        const RigidBody& body = bodies_.at(index);
        const geometry::Pose pose = body.pose(frame_.time, frame_.coilAngle, frame_.movedOf(index));
        const Vec3 x = pose.toBody(frame_.particles.position[c.particle]), force = pose.directionToBody(c.force);
        const double r = frame_.particles.radius[c.particle];
        std::optional<geometry::Closest> best;
        double most = 0;
        for (const geometry::Shape& shape : body.shapes) {
            // A contact that has parted since is still within reach. A mesh reaches no farther than the largest sphere.
            const auto* mesh = std::get_if<std::shared_ptr<const geometry::MeshSurface>>(&shape);
            const double reach = mesh ? std::min(1.1 * r, (*mesh)->reach()) : 1.1 * r;
            for (const geometry::Feature& f : geometry::places(shape, x, reach)) {
                const double along = std::abs(glm::dot(force, f.normal));
                if (best && along <= most) continue;
                best = f;
                most = along;
            }
        }
        if (!best) {  // the largest sphere has just parted
            const double strength = glm::length(force);
            const Vec3 normal = strength > 0 ? force / strength : Vec3(0, 1, 0);
            best = geometry::Closest{x - r * normal, normal, r};
        }
        return against({pose.toWorld(best->point), pose.directionToWorld(best->normal), best->distance}, r);
    }

    const Frame& frame_;
    const World& world_;
    std::vector<RigidBody> bodies_;
};

}  // namespace

std::vector<vtkhdf::Array> fieldsOf(const Frame& f) {
    const auto number = [](auto x) { return std::vector<std::uint32_t>{static_cast<std::uint32_t>(x)}; };
    std::vector<vtkhdf::Array> fields{
        {"TimeValue", "s", 1, std::vector<double>{f.time}},
        {"step", "", 1, std::vector<double>{static_cast<double>(f.step)}},  // exact: a run has fewer than 2^53
        {"phase", "", 1, number(f.phase)},
        {"dose", "", 1, number(f.dose)},
        {"coil_angle", "rad", 1, std::vector<double>{f.coilAngle}}};
    if (f.bodiesMoved.empty()) return fields;
    std::vector<double> clocks, shifts, angles;
    for (const Moved& body : f.bodiesMoved) {
        clocks.push_back(body.time);
        shifts.insert(shifts.end(), {body.shift.x, body.shift.y, body.shift.z});
        angles.push_back(body.angle);
    }
    fields.push_back({kBodyClocks, "s", 1, std::move(clocks)});
    const auto some = [](const std::vector<double>& all) {
        return std::any_of(all.begin(), all.end(), [](double x) { return x != 0; });
    };
    if (some(shifts)) fields.push_back({kBodyShifts, "m", 3, std::move(shifts)});
    if (some(angles)) fields.push_back({kBodyAngles, "rad", 1, std::move(angles)});
    return fields;
}

vtkhdf::Grid particlesGrid(const Frame& frame, const World& world, std::uint32_t member) {
    const Particles& p = frame.particles;
    const std::size_t n = p.size();
    std::vector<Vec3> force(n, Vec3(0));
    std::vector<float> overlap(n, 0), energy(n);
    ContactGeometry geometry(frame, world);
    for (const Contact& c : frame.contacts) {
        const auto deepest = [&, depth = static_cast<float>(geometry.of(c).overlap)](std::uint32_t i) {
            overlap[i] = std::max(overlap[i], depth);
        };
        force[c.particle] += c.force;
        deepest(c.particle);
        if (c.kind != ContactClass::ParticleParticle) continue;
        force[c.other] -= c.force;
        deepest(c.other);
    }
    std::vector<std::uint32_t> id(n);
    std::iota(id.begin(), id.end(), 0U);
    std::vector<std::uint8_t> status;
    for (std::size_t i = 0; i < n; ++i) {
        energy[i] = static_cast<float>(kineticEnergy(world, p, i));
        status.push_back(static_cast<std::uint8_t>(p.status[i]));
    }
    const std::vector<double> sums = flat(force);
    vtkhdf::Grid grid;
    grid.cell = vtkhdf::Cell::Vertex;
    grid.points.values = flat(p.position);
    grid.connectivity.resize(n);
    std::iota(grid.connectivity.begin(), grid.connectivity.end(), 0);
    grid.pointData = {{"id", "", 1, id},
                      {"radius", "m", 1, p.radius},
                      {"velocity", "m/s", 3, flat(p.velocity)},
                      {"spin", "rad/s", 3, flat(p.spin)},
                      {"force", "N", 3, std::vector<float>(sums.begin(), sums.end())},
                      {"overlap", "m", 1, std::move(overlap)},
                      {"kinetic_energy", "J", 1, std::move(energy)},
                      {"status", "", 1, std::move(status)},
                      {"member", "", 1, std::vector<std::uint32_t>(n, member)}};
    if (powdersOf(world).size() > 1) grid.pointData.push_back({"material", "", 1, p.material});
    if (!p.gone.empty()) {
        std::vector<float> gone;  // exact below 2^24
        for (const glm::ivec3& g : p.gone)
            for (int d = 0; d < 3; ++d) gone.push_back(static_cast<float>(g[d]));
        grid.pointData.push_back({kPeriodsGone, "", 3, std::move(gone)});
    }
    for (std::size_t k = 0; k < world.properties.size() && !p.properties.empty(); ++k) {
        std::vector<double> values;
        for (const LawProperties& own : p.properties) values.push_back(own[k]);
        grid.pointData.push_back({world.properties[k], "", 1, std::move(values)});
    }
    grid.fieldData = fieldsOf(frame);
    return grid;
}

vtkhdf::Grid contactsGrid(const Frame& frame, const World& world) {
    std::vector<float> ends, normal, tangential, overlap;
    std::vector<double> maxOverlap, torsion;
    std::vector<Vec3> force, sliding, rolling;
    std::vector<std::uint32_t> particle, other;
    std::vector<std::uint8_t> kind;
    ContactGeometry geometry(frame, world);
    for (const Contact& c : frame.contacts) {
        const Geometry g = geometry.of(c);
        for (const Vec3& end : {frame.particles.position[c.particle], g.end})
            for (int d = 0; d < 3; ++d) ends.push_back(static_cast<float>(end[d]));
        const double along = glm::dot(c.force, g.normal);
        normal.push_back(static_cast<float>(along));
        tangential.push_back(static_cast<float>(glm::length(c.force - along * g.normal)));
        overlap.push_back(static_cast<float>(g.overlap));
        maxOverlap.push_back(c.maxOverlap);
        torsion.push_back(c.torsion);
        force.push_back(c.force);
        sliding.push_back(c.sliding);
        rolling.push_back(c.rolling);
        particle.push_back(c.particle);
        other.push_back(c.other);
        kind.push_back(static_cast<std::uint8_t>(c.kind));
    }
    vtkhdf::Grid grid;
    grid.cell = vtkhdf::Cell::Line;
    grid.connectivity.resize(ends.size() / 3);
    std::iota(grid.connectivity.begin(), grid.connectivity.end(), 0);
    grid.points.values = std::move(ends);
    grid.cellData = {{"kind", "", 1, std::move(kind)},
                     {"particle", "", 1, std::move(particle)},
                     {"other", "", 1, std::move(other)},
                     {"force", "N", 3, flat(force)},
                     {"normal_force", "N", 1, std::move(normal)},
                     {"tangential_force", "N", 1, std::move(tangential)},
                     {"overlap", "m", 1, std::move(overlap)},
                     {"max_overlap", "m", 1, std::move(maxOverlap)},
                     {"sliding", "m", 3, flat(sliding)},
                     {"rolling", "m", 3, flat(rolling)},
                     {"torsion", "m", 1, std::move(torsion)}};
    grid.fieldData = fieldsOf(frame);
    return grid;
}

std::string particlesFile(const Frame& frame, const World& world, std::uint32_t member) {
    return vtkhdf::file(particlesGrid(frame, world, member));
}

std::string contactsFile(const Frame& frame, const World& world) {
    return vtkhdf::file(contactsGrid(frame, world));
}

namespace {

/// Reads arrays of a known length.
class Columns {
  public:
    Columns(const hdf5::Reader& reader, std::string group, std::size_t count)
        : reader_(reader), group_(std::move(group)), count_(count) {}

    template <class T>
    std::vector<T> get(const std::string& name, std::size_t components = 1) const {
        std::vector<T> values = reader_.array<T>(group_ + "/" + name);
        if (values.size() != components * count_) throw hdf5::Error(group_ + "/" + name + " has another length");
        return values;
    }
    std::vector<Vec3> vector(const std::string& name) const { return vectors(get<double>(name, 3)); }

  private:
    const hdf5::Reader& reader_;
    std::string group_;
    std::size_t count_;
};

std::size_t one(const hdf5::Reader& reader, const std::string& name) {
    const Columns group(reader, "/VTKHDF", 1);
    return static_cast<std::size_t>(group.get<std::uint64_t>(name)[0]);
}

}  // namespace

void readParticlesFile(std::string bytes, Frame& frame, const std::vector<std::string>& properties) {
    const hdf5::Reader reader(std::move(bytes));
    const Columns field(reader, "/VTKHDF/FieldData", 1);
    frame.step = static_cast<std::uint64_t>(field.get<double>("step")[0]);
    frame.time = field.get<double>("TimeValue")[0];
    frame.phase = static_cast<Phase>(field.get<std::uint32_t>("phase")[0]);
    frame.dose = static_cast<int>(field.get<std::uint32_t>("dose")[0]);
    frame.coilAngle = field.get<double>("coil_angle")[0];
    frame.bodiesMoved.clear();
    const std::string fields = "/VTKHDF/FieldData/";
    if (reader.has(fields + kBodyClocks))
        for (const double time : reader.array<double>(fields + kBodyClocks)) frame.bodiesMoved.emplace_back(time);
    if (reader.has(fields + kBodyShifts)) {
        const std::vector<double> shifts = reader.array<double>(fields + kBodyShifts);
        for (std::size_t b = 0; b < std::min(frame.bodiesMoved.size(), shifts.size() / 3); ++b)
            frame.bodiesMoved[b].shift = {shifts[3 * b], shifts[3 * b + 1], shifts[3 * b + 2]};
    }
    if (reader.has(fields + kBodyAngles)) {
        const std::vector<double> angles = reader.array<double>(fields + kBodyAngles);
        for (std::size_t b = 0; b < std::min(frame.bodiesMoved.size(), angles.size()); ++b)
            frame.bodiesMoved[b].angle = angles[b];
    }
    const std::size_t n = one(reader, "NumberOfPoints");
    const Columns data(reader, "/VTKHDF/PointData", n);
    Particles& p = frame.particles;
    p.position = Columns(reader, "/VTKHDF", n).vector("Points");
    p.velocity = data.vector("velocity");
    p.spin = data.vector("spin");
    p.radius = data.get<double>("radius");
    p.material.assign(n, kFirstPowder);
    if (reader.has("/VTKHDF/PointData/material"))
        for (std::size_t i = 0; const std::uint32_t m : data.get<std::uint32_t>("material"))
            p.material[i++] = static_cast<std::uint8_t>(m);
    p.gone.clear();
    if (reader.has(std::string("/VTKHDF/PointData/") + kPeriodsGone))
        for (const Vec3& gone : data.vector(kPeriodsGone)) p.gone.emplace_back(gone);
    p.properties.clear();
    for (std::size_t k = 0; k < properties.size(); ++k) {
        if (!reader.has("/VTKHDF/PointData/" + properties[k])) continue;
        p.properties.resize(n);
        const std::vector<double> values = data.get<double>(properties[k]);
        for (std::size_t i = 0; i < n; ++i) p.properties[i].at(k) = values[i];
    }
    p.status.clear();
    for (const std::uint32_t s : data.get<std::uint32_t>("status")) p.status.push_back(static_cast<Status>(s));
}

void readContactsFile(std::string bytes, Frame& frame) {
    const hdf5::Reader reader(std::move(bytes));
    const std::size_t n = one(reader, "NumberOfCells");
    const Columns data(reader, "/VTKHDF/CellData", n);
    const auto kind = data.get<std::uint32_t>("kind"), particle = data.get<std::uint32_t>("particle"),
               other = data.get<std::uint32_t>("other");
    const auto maxOverlap = data.get<double>("max_overlap"), torsion = data.get<double>("torsion");
    const auto sliding = data.vector("sliding"), rolling = data.vector("rolling"), force = data.vector("force");
    frame.contacts.clear();
    for (std::size_t c = 0; c < n; ++c)
        frame.contacts.push_back({static_cast<ContactClass>(kind[c]), particle[c], other[c], maxOverlap[c], sliding[c],
                                  rolling[c], torsion[c], force[c]});
}

}  // namespace vkdose
