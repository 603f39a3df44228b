// The bodies: [[body]] with its shape or mesh, its place and [body.motion].
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "geometry/mesh.h"
#include "host/core/closest_word.h"
#include "host/core/csv_table.h"
#include "host/core/printable.h"
#include "host/model/case_sections.h"
#include "host/model/named_file.h"

namespace vkdose {
namespace {

using geometry::Shape;

const Vec3 kAlong(0, 0, 1);

/// What is needed to read one body.
struct BodyReader {
    CaseReader& reader;
    Section& section;
    double meshReach;  ///< [m]; NaN while the case is at fault
    Case& c;

    void fault(std::string_view key, std::string problem, std::string remedy) const {
        reader.fault(section.path(key), std::move(problem), std::move(remedy));
    }
};

/// A wall between two circles around the body's z axis.
geometry::Cone around(double z, double radius, double endRadius, double length) {
    return {Vec3(0, 0, z), kAlong, radius, endRadius, length};
}

std::vector<Shape> withEnds(geometry::Cone wall, bool ends) {
    if (!ends) return {wall};
    return {wall, around(0, 0, wall.baseRadius, 0), around(wall.length, 0, wall.endRadius, 0)};
}

std::vector<Shape> readScrew(const BodyReader& b) {
    Section& s = b.section;
    geometry::Flight flight;
    const double length = s.number("length_mm");
    flight.innerRadius = s.number("shaft_radius_mm");
    flight.outerRadius = s.number("radius_mm");
    flight.thickness = s.number("thickness_mm");
    flight.pitchStart = s.number("pitch_mm");
    flight.pitchEnd = s.number("pitch_end_mm", flight.pitchStart * kMillimetre.perSI);
    flight.hand = s.choice("hand") == std::size_t{1} ? -1 : 1;
    // The height of the blade's middle is the mean pitch times the turns.
    flight.angle = 2 * kPi * length / ((flight.pitchStart + flight.pitchEnd) / 2);
    if (flight.outerRadius <= flight.innerRadius)
        b.fault("radius_mm", "is no larger than the shaft's", "give a larger one, or a smaller shaft_radius_mm");
    if (flight.thickness >= std::min(flight.pitchStart, flight.pitchEnd))
        b.fault("thickness_mm", "leaves nothing free between the turns", "give less than the pitch");
    std::vector<Shape> shapes = withEnds(around(0, flight.innerRadius, flight.innerRadius, length), true);
    shapes.insert(shapes.begin(), flight);
    return shapes;
}

std::vector<Shape> readWire(const BodyReader& b) {
    Section& s = b.section;
    geometry::Coil wire;
    wire.length = s.number("length_mm");
    wire.radius = s.number("radius_mm");
    wire.pitch = s.number("pitch_mm");
    wire.wireRadius = s.number("wire_diameter_mm") / 2;
    wire.hand = s.choice("hand") == std::size_t{1} ? -1 : 1;
    if (wire.radius <= wire.wireRadius)
        b.fault("radius_mm", "is no larger than the wire's own radius", "give a larger one, or a thinner wire");
    if (wire.pitch <= 2 * wire.wireRadius)
        b.fault("pitch_mm", "lets the turns overlap", "give more than wire_diameter_mm");
    return {wire};
}

constexpr double kLargestMesh = 5;  ///< [m]

/// What a mesh of so many units would measure in each unit in which it is not too large.
std::string otherUnits(double units) {
    std::string text;
    for (const char* unit : {"cm", "inch", "mm", "um"}) {
        const double length = units * geometry::metresIn(unit).value_or(0);
        if (length <= kLargestMesh)
            text += fmt::format("{}{:.4g} mm in {}", text.empty() ? "" : ", ", length * 1e3, unit);
    }
    return text.empty()
               ? "give a smaller mesh"
               : fmt::format("give the unit that it was drawn in (it would be {} long), or a smaller mesh", text);
}

std::vector<Shape> readMeshShape(const BodyReader& b) {
    Section& s = b.section;
    const std::string name = s.string("mesh"), unit = s.string("unit");
    if (!s.isString("mesh") || !s.isString("unit")) return {};
    const std::optional<double> metres = geometry::metresIn(unit);
    if (!metres) {
        b.fault("unit", "is not known", fmt::format("give one of {}", geometry::lengthUnits()));
        return {};
    }
    const std::filesystem::path file = b.reader.folderOf(s.path("mesh")) / name;
    if (!requireFile(b.reader, s.path("mesh"), file,
                     "give the path of an STL, OBJ or PLY file, relative to the case file"))
        return {};
    try {
        geometry::CheckedMesh checked = geometry::makeMesh(geometry::readMeshFile(file, *metres));
        const Vec3 size = checked.facts.high - checked.facts.low;
        // Meshes know no unit. Nothing that doses powder is that large.
        const double longest = std::max({size.x, size.y, size.z});
        if (longest > kLargestMesh)
            b.fault("unit",
                    fmt::format("makes the mesh {:.4g} m long, and at most {} m are computed", longest, kLargestMesh),
                    otherUnits(longest / *metres));
        if (!checked.facts.mended.empty()) b.c.mendedMeshes.emplace_back(b.c.world.bodies.size(), checked.facts.mended);
        s.record("mesh", std::filesystem::absolute(file).lexically_normal().string());
        b.c.files.push_back(file);
        if (!(b.meshReach > 0)) return {};
        return {std::make_shared<const geometry::MeshSurface>(std::move(checked.mesh), b.meshReach)};
    } catch (const geometry::MeshError& e) {
        b.fault("mesh", e.what(), "mend the mesh");
        return {};
    }
}

enum class Kind { Mesh, Plane, Box, Ball, Cylinder, Cone, Disc, Trough, Wire, Screw };

std::vector<Shape> readShape(const BodyReader& b, Kind kind) {
    Section& s = b.section;
    switch (kind) {
        case Kind::Mesh:
            return readMeshShape(b);
        case Kind::Plane:
            return {geometry::Plane{Vec3(0), readDirection(b.reader, s, "normal")}};
        case Kind::Box: {
            const Vec3 half = s.vector("size_mm") / 2.0 / kMillimetre.perSI;
            if (!(half.x > 0 && half.y > 0 && half.z > 0) && !std::isnan(half.x))
                b.fault("size_mm", "has a side that is not positive", "give three lengths > 0");
            return {geometry::Block{-half, half, s.boolean("inside")}};
        }
        case Kind::Ball:
            return {geometry::Ball{Vec3(0), s.number("radius_mm")}};
        case Kind::Cylinder: {
            const double radius = s.number("radius_mm"), length = s.number("length_mm");
            return withEnds(around(0, radius, radius, length), s.boolean("ends"));
        }
        case Kind::Cone: {
            const double radius = s.number("radius_mm"), end = s.number("end_radius_mm");
            return {around(0, radius, end, s.number("length_mm"))};
        }
        case Kind::Disc: {
            const double outer = s.number("radius_mm"), hole = s.number("hole_radius_mm");
            if (hole >= outer) b.fault("hole_radius_mm", "is no smaller than the disc", "give less than radius_mm");
            return {around(0, hole, outer, 0)};
        }
        case Kind::Trough:
            return {geometry::Trough{s.number("width_mm") / 2}};
        case Kind::Wire:
            return readWire(b);
        case Kind::Screw:
            return readScrew(b);
    }
    return {};
}

geometry::Pose readPlace(const BodyReader& b) {
    Section& s = b.section;
    const Vec3 at = s.vector("at"), axis = readDirection(b.reader, s, "rotation_axis");
    return {glm::angleAxis(s.number("rotation_deg"), axis), at};
}

/// The motion of another body, which it shares.
void readCompany(const BodyReader& b, RigidBody& body) {
    const std::string name = b.section.string("moves_with");
    if (!b.section.isString("moves_with")) return;
    if (b.section.has("motion"))
        return b.fault("moves_with", "stands beside [body.motion], which says another motion", "give one of the two");
    const auto place = placeOfBody(b.reader, b.section.path("moves_with"), name, b.c);
    if (!place) return;
    const RigidBody& leader = b.c.world.bodies[*place];
    if (leader.movesFreely())
        return b.fault("moves_with", "names a body that forces move, and these move it alone",
                       "make one body of the two, as one mesh");
    body.course.motion = leader.course.motion;
    body.course.schedule = leader.course.schedule;
    body.clock = leader.clock;
    body.phases = leader.phases;
    body.anew = leader.anew;
}

}  // namespace

void readBodies(CaseReader& reader, Section& root, double meshReach, Case& c) {
    std::set<std::string> names;
    for (Section* section : root.tables("body")) {
        const BodyReader b{reader, *section, meshReach, c};
        RigidBody body;
        body.name = readName(reader, *section, "body", names);
        if (body.name == kCoilName && root.has("coil"))
            reader.fault(section->path("name"), "is the name of [coil]", "give the body a name of its own");
        const auto shape = section->choice("shape");
        if (shape)
            body.shapes = readShape(b, static_cast<Kind>(*shape));
        else
            section->abandon();
        if (shape == std::size_t(Kind::Ball) && section->boolean("curvature"))
            body.curvature = std::get<geometry::Ball>(body.shapes.front()).radius;
        if (section->has("material") && section->has("contact"))
            b.fault("contact", "stands beside material, which says the same otherwise", "give one of the two");
        if (section->has("material")) section->know("contact");
        const bool asCoil = !section->has("material") && section->choice("contact") == std::size_t{1};
        body.material = readMaterialName(reader, *section, c, asCoil ? kCoilMaterial : kWallMaterial);
        body.course.start = readPlace(b);
        readMotion(reader, *section, body);
        if (section->has("moves_with")) readCompany(b, body);
        section->know("moves_with");
        c.world.bodies.push_back(std::move(body));
    }
    if (c.world.bodies.size() > kMaxBodies)
        reader.fault("body", fmt::format("there are {}", c.world.bodies.size()),
                     fmt::format("give at most {}; one mesh may hold several parts that move together", kMaxBodies));
}

void alignWithDrive(Case& c) {
    if (!c.world.coil || geometry::conveyingRate(*c.world.coil, 1.0) > 0) return;
    for (RigidBody& body : c.world.bodies)
        if (auto* turn = std::get_if<geometry::Turn>(&body.course.motion); turn && body.clock == Clock::Drive)
            turn->rate = -turn->rate;
}

}  // namespace vkdose
