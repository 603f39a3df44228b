// The bodies: [[body]] with its shape or mesh, its place and [body.motion].
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "geometry/mesh.h"
#include "host/core/csv_table.h"
#include "host/core/printable.h"
#include "host/model/case_sections.h"
#include "host/model/closest_word.h"
#include "host/model/named_file.h"

namespace vkdose {
namespace {

using geometry::Shape;

const Vec3 kAlong(0, 0, 1);
constexpr const char* kNameLetters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_";

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

/// The columns of a table of motion; all but the time may be left out.
std::vector<geometry::Table::Row> readMotionTable(CaseReader& reader, Section& s) {
    const std::string name = s.string("file");
    if (!s.isString("file")) return {};
    const std::filesystem::path file = reader.folderOf(s.path("file")) / name;
    if (!requireFile(reader, s.path("file"), file, "give the path of a CSV, relative to the case file")) return {};
    s.record("file", std::filesystem::absolute(file).lexically_normal().string());
    std::vector<geometry::Table::Row> rows;
    try {
        const Table table = Table::read(file, LastLine::Whole);
        for (const std::string& column : table.names())
            if (column != "time_s" && column != "angle_deg" && column != "x" && column != "y" && column != "z")
                reader.fault(s.path("file"), fmt::format("has a column \"{}\"", printable(column)),
                             "name the columns time_s, angle_deg, x, y, z; lengths in m");
        if (table.names().size() < 2)
            reader.fault(s.path("file"), "has no column but the time, so that the body would stand",
                         "add angle_deg, or x, y and z in m");
        const auto at = [&](std::size_t row, const char* column) {
            return table.has(column) ? table.number(row, column) : 0.0;
        };
        for (std::size_t i = 0; i < table.rows(); ++i)
            rows.push_back(
                {table.number(i, "time_s"), at(i, "angle_deg") / kDegree.perSI, {at(i, "x"), at(i, "y"), at(i, "z")}});
    } catch (const CaseError& e) {
        for (const Diagnostic& d : e.faults()) reader.add(d);
    }
    return rows;
}

enum class MotionKind { Turn, Swing, Shake, Slide, Table, Free };

geometry::Free readFree(CaseReader& reader, Section& s) {
    geometry::Free free{s.number("mass_g"), s.vector("velocity", Vec3(0)), {}};
    if (!s.has("along")) {
        s.know("along");
        return free;
    }
    free.line = readDirection(reader, s, "along");
    if (glm::length(glm::cross(*free.line, free.velocity)) > 1e-9 * glm::length(free.velocity))
        reader.fault(s.path("velocity"), "leads off the line of along",
                     "give a velocity along that line, or leave out along");
    return free;
}

geometry::Motion readMotionOf(CaseReader& reader, Section& s, MotionKind kind, Clock clock) {
    switch (kind) {
        case MotionKind::Turn: {
            const Vec3 axis = readDirection(reader, s, "axis"), through = s.vector("through");
            return geometry::Turn{axis, through,
                                  clock == Clock::Drive ? s.number("turns_per_turn") : s.number("speed_rpm")};
        }
        case MotionKind::Swing: {
            const Vec3 axis = readDirection(reader, s, "axis"), through = s.vector("through");
            const double amplitude = s.number("amplitude_deg"), frequency = s.number("frequency_hz");
            return geometry::Swing{axis, through, amplitude, frequency, s.number("phase_deg")};
        }
        case MotionKind::Shake: {
            const Vec3 axis = readDirection(reader, s, "axis");
            const double amplitude = s.number("amplitude_mm"), frequency = s.number("frequency_hz");
            return geometry::Shake{axis, amplitude, frequency, s.number("phase_deg")};
        }
        case MotionKind::Slide:
            return geometry::Slide{s.vector("velocity")};
        case MotionKind::Table: {
            const Vec3 axis = readDirection(reader, s, "axis"), through = s.vector("through");
            return geometry::Table{axis, through, readMotionTable(reader, s)};
        }
        case MotionKind::Free:
            break;  // readFreeBody
    }
    return geometry::Rest{};
}

/// The phases that `during` names.
std::vector<Phase> readPhases(CaseReader& reader, Section& s) {
    const std::string text = s.string("during");
    if (!s.isString("during")) return {};
    const std::vector<std::string> known(Words<Phase>::kNames.begin(), Words<Phase>::kNames.end());
    const std::string remedy = "give some of settle, rotate, reverse, rest, separated by blanks";
    std::vector<Phase> phases;
    for (const std::string& word : wordsOf(text)) {
        const auto found = std::find(known.begin(), known.end(), word);
        const auto phase = static_cast<Phase>(found - known.begin());
        if (found == known.end()) {
            const std::string meant = closestWord(word, known);
            reader.fault(s.path("during"), fmt::format("there is no phase \"{}\"", printable(word)),
                         meant.empty() ? remedy : fmt::format("did you mean \"{}\"?", meant));
        } else if (std::find(phases.begin(), phases.end(), phase) != phases.end()) {
            reader.fault(s.path("during"), fmt::format("names {} twice", word), "name each phase once");
        } else {
            phases.push_back(phase);
        }
    }
    if (wordsOf(text).empty()) reader.fault(s.path("during"), "names no phase", remedy);
    for (const char* key : {"from_s", "to_s"})
        if (s.has(key))
            reader.fault(s.path(key), "does not go with during, by which the body moves in phases",
                         "give one of the two");
    s.know("from_s");
    s.know("to_s");
    return phases;
}

/// Whether a body that follows the table is at its end where it is at its beginning.
bool closes(const geometry::Table& table) {
    const geometry::Table::Row &first = table.rows.front(), &last = table.rows.back();
    const double turns = (last.angle - first.angle) / (2 * kPi);
    return std::abs(turns - std::round(turns)) < 1e-9 && glm::length(last.shift - first.shift) < 1e-12;
}

/// When a body moves that moves by time.
void readTimes(CaseReader& reader, Section& s, RigidBody& made) {
    if (s.has("during")) {
        made.clock = Clock::Phases;
        made.phases = readPhases(reader, s);
        const auto* table = std::get_if<geometry::Table>(&made.course.motion);
        if (table == nullptr) return;
        made.anew = s.boolean("anew");
        if (made.anew && !table->rows.empty() && !closes(*table))
            reader.fault(s.path("anew"), "would let the body jump, for the table ends in another place than it begins",
                         "let its last row be the place of its first, or write anew = false");
        return;
    }
    s.know("during");
    if (s.has("anew")) reader.fault(s.path("anew"), "goes with during", "name the phases in which the table goes on");
    s.know("anew");
    const double from = s.number("from_s");
    const double to = s.has("to_s") ? s.number("to_s") : geometry::kEndless;
    s.know("to_s");
    if (to <= from) reader.fault(s.path("to_s"), "is not later than from_s", "give a later time");
    if (from > 0 || to < geometry::kEndless) made.course.schedule.intervals = {{from, to}};
}

/// A body that moves freely, from a time on.
void readFreeBody(CaseReader& reader, Section& s, RigidBody& made) {
    made.course.motion = readFree(reader, s);
    for (const char* key : {"to_s", "during", "anew"}) {
        if (s.has(key))
            reader.fault(s.path(key), "does not go with kind = \"free\": once it is free, the body follows its forces",
                         "leave it out; from_s says when it is free");
        s.know(key);
    }
    if (made.clock == Clock::Drive) reader.fault(s.path("follows"), "only a turn can follow the drive", "leave it out");
    made.clock = Clock::Forces;
    const double from = s.number("from_s");
    if (from > 0) made.course.schedule.intervals = {{from, geometry::kEndless}};
    const auto endless = [](const Shape& shape) {
        return std::holds_alternative<geometry::Plane>(shape) || std::holds_alternative<geometry::Trough>(shape);
    };
    if (std::any_of(made.shapes.begin(), made.shapes.end(), endless))
        reader.fault(s.path("kind"), "is not for a plane or a trough, which have no end",
                     "give the body another shape, such as a box or a disc");
}

void readMotion(CaseReader& reader, Section& body, RigidBody& made) {
    if (!body.has("motion")) {
        body.know("motion");
        return;
    }
    Section& s = body.table("motion");
    const auto kind = s.choice("kind");
    const auto follows = s.choice("follows");
    if (!kind || !follows) return s.abandon();
    made.clock = static_cast<Clock>(*follows);
    if (static_cast<MotionKind>(*kind) == MotionKind::Free) return readFreeBody(reader, s, made);
    if (made.clock == Clock::Drive && static_cast<MotionKind>(*kind) != MotionKind::Turn) {
        reader.fault(s.path("follows"), "only a turn can follow the drive",
                     "write kind = \"turn\", or follows = \"time\"");
        return s.abandon();
    }
    made.course.motion = readMotionOf(reader, s, static_cast<MotionKind>(*kind), made.clock);
    if (static_cast<MotionKind>(*kind) == MotionKind::Turn) {
        if (s.has("pockets")) made.pockets = static_cast<int>(s.integer("pockets"));
        s.know("pockets");
    }
    if (made.clock == Clock::Drive && s.has("during")) {
        reader.fault(s.path("during"), "does not go with follows = \"drive\": such a body moves when the drive turns",
                     "leave it out, or write follows = \"time\" and a speed");
        s.know("during");
    }
    if (made.clock == Clock::Time) readTimes(reader, s, made);
    if (reader.faulty()) return;
    if (const std::string why = geometry::motionFault(made.course.motion); !why.empty())
        reader.fault(s.path("kind"), why, "mend the motion");
}

}  // namespace

std::string readName(CaseReader& reader, Section& section, const std::string& kind, std::set<std::string>& names) {
    std::string name = section.string("name");
    if (!section.isString("name")) return name;
    const bool fit = !name.empty() && name.size() <= 60 && name.find_first_not_of(kNameLetters) == std::string::npos;
    if (!fit)
        reader.fault(section.path("name"), fmt::format("is no name of a {}", kind), "give letters, digits, - and _");
    else if (!names.insert(name).second)
        reader.fault(section.path("name"), "stands there twice", fmt::format("give each {} a name of its own", kind));
    return name;
}

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
