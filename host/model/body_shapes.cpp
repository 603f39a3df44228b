// The shapes of [[body]]: their keys, and how they are read.
#include "host/model/body_shapes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "geometry/mesh.h"
#include "host/model/named_file.h"

namespace vkdose {

namespace {

using namespace key;
using geometry::Shape;

// ---- keys ---------------------------------------------------------------------------------------------------------

constexpr Key kBodyMesh[] = {
    text("mesh", kRequired, "an STL, OBJ or PLY file; the path is relative to the case file"),
    text("unit", kRequired, "of the lengths in the file: `\"m\"`, `\"cm\"`, `\"mm\"`, `\"um\"`, `\"inch\"`"),
};
constexpr Key kBodyShape[] = {
    vector("normal", kPlain, {0, 1, 0}, "`plane`: points to the side of the particles"),
    vector("size_mm", kMillimetre, kRequired, "`box`: its three edges"),
    boolean("inside", false, "`box`: whether it is a room with the particles inside"),
    number("radius_mm", kMillimetre, kPositive, kRequired,
           "`ball`, `cylinder`, `disc`, `screw`: outer radius; `cone`: radius at z = 0; `wire`: of its centre line"),
    boolean("curvature", false,
            "`ball`: whether the reduced size a* of a contact counts its radius. `false`: it is as flat as a wall"),
    number("end_radius_mm", kMillimetre, kNonNegative, kRequired, "`cone`: radius at its other end"),
    number("hole_radius_mm", kMillimetre, kNonNegative, 0.0, "`disc`: of the hole in its middle"),
    number("length_mm", kMillimetre, kPositive, kRequired, "`cylinder`, `cone`, `wire`, `screw`: along z"),
    boolean("ends", false, "`cylinder`: whether a disc closes each end"),
    number("width_mm", kMillimetre, kPositive, kRequired, "`trough`: between its sides; it has no ends"),
    number("pitch_mm", kMillimetre, kPositive, kRequired, "`wire`, `screw`: length of one turn"),
    number("pitch_end_mm", kMillimetre, kPositive, told("`pitch_mm`"), "`screw`: at its end; it changes evenly"),
    number("wire_diameter_mm", kMillimetre, kPositive, kRequired, "`wire`: its thickness"),
    number("shaft_radius_mm", kMillimetre, kPositive, kRequired, "`screw`: of the shaft that carries the blade"),
    number("thickness_mm", kMillimetre, kPositive, kRequired, "`screw`: of the blade, along z"),
    word("hand", "right left", "right", "`wire`, `screw`: hand of the helix"),
};

// ---- shapes -------------------------------------------------------------------------------------------------------

const Vec3 kAlong(0, 0, 1);

/// A wall between two circles around the body's z axis.
geometry::Cone around(double z, double radius, double endRadius, double length) {
    return {Vec3(0, 0, z), kAlong, radius, endRadius, length};
}

std::vector<Shape> withEnds(geometry::Cone wall, bool ends) {
    if (!ends) return {wall};
    return {wall, around(0, 0, wall.baseRadius, 0), around(wall.length, 0, wall.endRadius, 0)};
}

BodyShape readScrew(const BodyReader& b) {
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
    return {shapes};
}

BodyShape readWire(const BodyReader& b) {
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
    return {{wire}};
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

BodyShape readMesh(const BodyReader& b) {
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
        if (!checked.facts.mended.empty()) b.read.mended.emplace_back(b.read.bodies.size(), checked.facts.mended);
        s.record("mesh", std::filesystem::absolute(file).lexically_normal().string());
        b.read.files.push_back(file);
        if (!b.meshReach) return {};
        return {{std::make_shared<const geometry::MeshSurface>(std::move(checked.mesh), *b.meshReach)}};
    } catch (const geometry::MeshError& e) {
        b.fault("mesh", e.what(), "mend the mesh");
        return {};
    }
}

BodyShape readPlane(const BodyReader& b) {
    return {{geometry::Plane{Vec3(0), readDirection(b.reader, b.section, "normal")}}};
}

BodyShape readBox(const BodyReader& b) {
    const Vec3 half = b.section.vector("size_mm") / 2.0 / kMillimetre.perSI;
    if (!(half.x > 0 && half.y > 0 && half.z > 0) && !std::isnan(half.x))
        b.fault("size_mm", "has a side that is not positive", "give three lengths > 0");
    return {{geometry::Block{-half, half, b.section.boolean("inside")}}};
}

BodyShape readBall(const BodyReader& b) {
    const geometry::Ball ball{Vec3(0), b.section.number("radius_mm")};
    return {{ball}, b.section.boolean("curvature") ? ball.radius : 0};
}

BodyShape readCylinder(const BodyReader& b) {
    const double radius = b.section.number("radius_mm"), length = b.section.number("length_mm");
    return {withEnds(around(0, radius, radius, length), b.section.boolean("ends"))};
}

BodyShape readCone(const BodyReader& b) {
    const double radius = b.section.number("radius_mm"), end = b.section.number("end_radius_mm");
    return {{around(0, radius, end, b.section.number("length_mm"))}};
}

BodyShape readDisc(const BodyReader& b) {
    const double outer = b.section.number("radius_mm"), hole = b.section.number("hole_radius_mm");
    if (hole >= outer) b.fault("hole_radius_mm", "is no smaller than the disc", "give less than radius_mm");
    return {{around(0, hole, outer, 0)}};
}

BodyShape readTrough(const BodyReader& b) {
    return {{geometry::Trough{b.section.number("width_mm") / 2}}};
}

struct ShapeWord {
    const char* word;
    BodyShape (*read)(const BodyReader& b);
};

constexpr ShapeWord kWords[] = {
    {"mesh", readMesh}, {"plane", readPlane}, {"box", readBox},       {"ball", readBall}, {"cylinder", readCylinder},
    {"cone", readCone}, {"disc", readDisc},   {"trough", readTrough}, {"wire", readWire}, {"screw", readScrew}};

std::string allWords() {
    std::string words;
    for (const ShapeWord& shape : kWords) words += (words.empty() ? "" : " ") + std::string(shape.word);
    return words;
}

}  // namespace

std::span<const Key> bodyKeys() {
    static const std::string words = allWords();
    static const Key keys[] = {
        text("name", kRequired, "of the body, in messages and tables: letters, digits, `-` and `_`"),
        word("shape", words, "mesh",
             "in the body's own frame: a plane through the origin; a box or a ball about it; all others around the z "
             "axis, from z = 0 on")
            .replacing("*"),
        word("contact", "wall coil", "wall",
             "whose contact parameters it has: those of `[contact.wall]` or `[contact.coil]`")
            .replacing("material"),
        text("material", told("none"), "in place of `contact`: name of a `[[material]]` that it is made of")
            .replacing("contact"),
        text("moves_with", told("none"),
             "in place of `[body.motion]`: name of a `[[body]]` before it, whose motion it shares, as if the two were "
             "one. Not of one that is `free` or on a `hinge`")
            .replacing("motion"),
        vector(
            "at", kMetre, {0, 0, 0},
            "where the origin of its frame is at the start; of a body that swings or shakes, in the middle of its way"),
        vector("rotation_axis", kPlain, {0, 0, 1},
               "direction of the axis about which its frame is turned at the start"),
        number("rotation_deg", kDegree, Bound::Any, 0.0, "the angle of that turn"),
    };
    return keys;
}

std::span<const Key> bodyMeshKeys() {
    return kBodyMesh;
}

std::span<const Key> bodyShapeKeys() {
    return kBodyShape;
}

BodyShape readShape(const BodyReader& b, std::size_t word) {
    return kWords[word].read(b);
}

}  // namespace vkdose
