// The boundaries and the coil.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "host/model/case_sections.h"

namespace vkdose {
namespace {

// ---- boundaries ---------------------------------------------------------------------------------------------------

/// `material` is that of its walls.
void addCanister(const Canister& can, int material, WallsRead& read) {
    const double half = can.width / 2;
    const auto add = [&](const geometry::Surface& shape, const char* name) {
        read.walls.emplace_back(shape, name, material);
    };
    // The walls end at the front wall, because beyond it a sphere touches only the throat.
    if (can.flatFloor) {
        add(geometry::Plane{{-half, 0, 0}, {1, 0, 0}, can.length}, "left");
        add(geometry::Plane{{half, 0, 0}, {-1, 0, 0}, can.length}, "right");
        add(geometry::Plane{{0, -half, 0}, {0, 1, 0}, can.length}, "floor");
    } else {
        add(geometry::Trough{half, can.length}, "trough");
    }
    add(geometry::Plane{{0, 0, 0}, {0, 0, 1}}, "rear");
    add(geometry::Front{can.length, can.outletDiameter / 2, can.throatLength}, "front");
    read.throatZ = can.length;
    read.outletZ = can.length + can.throatLength;
}

void readCanister(CaseReader& reader, Section& root, const std::vector<Material>& materials, WallsRead& read) {
    Section& section = root.requiredTable("canister");
    Canister can;
    can.length = section.number("length_mm");
    can.width = section.number("width_mm");
    can.height = section.number("height_mm");
    can.flatFloor = section.choice("floor") == std::size_t{1};
    can.outletDiameter = section.number("outlet_diameter_mm");
    can.throatLength = section.number("throat_length_mm");
    can.lid = section.boolean("lid");
    read.canister = can;
    addCanister(can, readMaterialName(reader, section, materials, kWallMaterial), read);
}

void readSurfaces(CaseReader& reader, Section& root, const std::vector<Material>& materials, WallsRead& read) {
    std::set<std::string> names;
    const auto add = [&](const geometry::Surface& shape, Section& section, const char* kind, std::size_t number) {
        const std::string name = readName(reader, section, kind, names, fmt::format("{}-{}", kind, number));
        read.walls.emplace_back(shape, name, readMaterialName(reader, section, materials, kWallMaterial));
    };
    std::size_t planes = 0, cylinders = 0;
    for (Section* plane : root.tables("plane")) {
        const Vec3 point = plane->vector("point");
        add(geometry::Plane{point, readDirection(reader, *plane, "normal")}, *plane, "plane", planes++);
    }
    for (Section* tube : root.tables("cylinder")) {
        geometry::Tube shape;
        shape.base = tube->vector("base");
        shape.axis = readDirection(reader, *tube, "axis");
        shape.radius = tube->number("radius_mm");
        if (tube->has("length_mm")) shape.length = tube->number("length_mm");
        tube->know("length_mm");
        shape.inside = tube->boolean("inside");
        add(shape, *tube, "cylinder", cylinders++);
    }
    if (read.walls.empty() && !root.has("body") && !reader.faulty())
        reader.fault("boundaries", "the list is empty",
                     "add [[plane]], [[cylinder]] or [[body]], or write boundaries = \"none\"");
}

/// Reports tables that have no use with the chosen boundaries, because they are probably a mistake.
void refuseUnused(CaseReader& reader, Section& root, Boundaries kind) {
    const auto refuse = [&](const char* key, const char* needed) {
        if (!root.has(key)) return;
        root.know(key);
        reader.fault(key, "has no use with these boundaries",
                     fmt::format("write boundaries = \"{}\" or remove it", needed));
    };
    if (kind != Boundaries::Canister) refuse("canister", "canister");
    if (kind != Boundaries::List) refuse("plane", "list");
    if (kind != Boundaries::List) refuse("cylinder", "list");
}

}  // namespace

Vec3 readDirection(CaseReader& reader, Section& section, const char* key) {
    const Vec3 v = section.vector(key);
    const double length = glm::length(v);
    if (length == 0) reader.fault(section.path(key), "has no direction", "give a vector that is not zero");
    return v / length;
}

WallsRead readBoundaries(CaseReader& reader, Section& root, const std::vector<Material>& materials) {
    WallsRead read;
    const auto index = root.choice("boundaries");
    for (const char* key : {"canister", "plane", "cylinder"})
        if (!index || !root.has(key)) root.know(key);
    if (!index) return read;
    read.kind = static_cast<Boundaries>(*index);
    if (read.kind == Boundaries::Canister) readCanister(reader, root, materials, read);
    if (read.kind == Boundaries::List) readSurfaces(reader, root, materials, read);
    refuseUnused(reader, root, *read.kind);
    return read;
}

namespace {

/// Reads one of two keys, of which exactly one must be given. `which` receives the index of that key.
double readEither(CaseReader& reader, Section& section, const char* first, const char* second, int& which) {
    which = section.has(second) && !section.has(first) ? 1 : 0;
    section.know(first);
    section.know(second);
    if (section.has(first) && section.has(second))
        reader.fault(section.path(second), fmt::format("{} is given too", first), "give one of the two");
    if (!section.has(first) && !section.has(second)) {
        reader.fault(section.path(first), "is missing", fmt::format("give {} or {}", first, second));
        return kNaN;
    }
    return section.number(which == 0 ? first : second);
}

}  // namespace

CoilRead readCoil(CaseReader& reader, Section& root, const std::optional<Canister>& canister) {
    CoilRead read;
    if (!root.has("coil")) {
        root.know("coil");
        return read;
    }
    Section& section = root.table("coil");
    geometry::Coil coil{};
    int which = 0;
    coil.length = section.number("length_mm");
    const double winding = readEither(reader, section, "turns", "pitch_mm", which);
    coil.pitch = which == 0 ? coil.length / winding : winding;
    coil.wireRadius = section.number("wire_diameter_mm") / 2;
    const double size = readEither(reader, section, "radius_mm", "clearance_mm", which);
    coil.radius = size;
    if (which == 1 && !canister)
        reader.fault("coil.clearance_mm", "needs a canister to be measured from", "give radius_mm");
    else if (which == 1)  // between the wire and the narrower of trough and hole
        coil.radius = std::min(canister->width, canister->outletDiameter) / 2 - size - coil.wireRadius;
    coil.zStart = section.number("z_start_mm");
    coil.startAngle = section.number("start_angle_deg");
    coil.hand = section.choice("hand") == std::size_t{1} ? -1 : 1;
    read.speed = section.number("speed_rpm");
    read.surfaceMoves = section.boolean("surface_velocity");
    read.wireCurved = section.boolean("wire_curvature");
    read.coil = coil;
    return read;
}

}  // namespace vkdose
