// A mesh from CAD in place of the coil of a new case.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "geometry/mesh.h"
#include "geometry/mesh_surface.h"
#include "host/app/backends.h"
#include "host/app/measures.h"
#include "host/app/new_design.h"
#include "host/core/printable.h"
#include "host/model/body_form.h"

namespace vkdose {

namespace {

/// Share of a surface that conveys against the rest, from which on it is more than the ends of a blade, and change of
/// the pitch over its mean from which on it is more than the error of facets.
constexpr double kOpposite = 0.1, kUneven = 0.1;

struct Part {
    std::vector<geometry::Triangle> triangles;
    geometry::MeshFacts facts;
};

Part read(const NewAnswers& a) {
    try {
        const geometry::TriangleSoup soup = geometry::readMeshFile(a.mesh, geometry::metresIn(a.meshUnit).value());
        Part part;
        const geometry::CheckedMesh checked = geometry::makeMesh(soup);
        part.facts = checked.facts;
        for (const auto& t : checked.mesh.triangles)
            part.triangles.push_back(
                {checked.mesh.vertices[t[0]], checked.mesh.vertices[t[1]], checked.mesh.vertices[t[2]]});
        return part;
    } catch (const geometry::MeshError& e) {
        throw UsageError(fmt::format("--mesh: {}", e.what()));
    }
}

/// Turns the longest direction of the mesh into z.
void layAlong(NewMesh& m, const Vec3& size) {
    if (size.z >= size.x && size.z >= size.y) return;
    m.rotationAxis = size.x > size.y ? Vec3(0, 1, 0) : Vec3(1, 0, 0);
    m.rotation = size.x > size.y ? -90 : 90;
}

Vec3 turned(const NewMesh& m, const Vec3& p) {
    return glm::angleAxis(m.rotation * kPi / 180, m.rotationAxis) * p;
}

std::string sizeText(const Vec3& size) {
    return fmt::format("{} x {} x {}", lengthText(size.x), lengthText(size.y), lengthText(size.z));
}

}  // namespace

void designMesh(NewDesign& d, const NewAnswers& a, const std::filesystem::path& file) {
    const Part part = read(a);
    NewMesh m;
    m.file = fromCase(a.mesh, file);
    m.unit = a.meshUnit;
    const Vec3 size = part.facts.high - part.facts.low;
    layAlong(m, size);
    const Vec3 centre = turned(m, (part.facts.low + part.facts.high) / 2.0);
    m.length = std::max({size.x, size.y, size.z});
    std::vector<geometry::Triangle> mesh = part.triangles;
    for (geometry::Triangle& t : mesh)
        for (Vec3& p : t) p = turned(m, p) - centre;
    const Vec3 axis(0, 0, 1);
    m.radius = reachOf(mesh, axis, Vec3(0)).radius;
    const Conveying form = conveyingOf(mesh, axis, Vec3(0));
    // Less is the rounding of facets.
    m.advance = std::abs(form.advance) > 0.02 * m.radius ? std::abs(form.advance) : 0;
    m.turnsPerTurn = form.advance < 0 ? -1 : 1;
    m.first = m.last = m.advance;
    const bool opposite = form.against > kOpposite;
    if (!opposite && std::abs(form.high - form.low) > kUneven * m.advance) {
        m.first = m.turnsPerTurn * form.low;
        m.last = m.turnsPerTurn * form.high;
    }
    m.solid = part.facts.closed && part.facts.oriented ? std::abs(part.facts.volume) / m.length : 0;

    const double room = std::min(d.width.value, d.outlet.value) / 2;
    // A mesh in single precision that is as wide as the outlet may be so by its last digit.
    if (m.radius > 1.001 * room)
        throw UsageError(
            fmt::format("--mesh: {} in {} is {}, which reaches {} from its axis; an outlet of {} has room for {}. Give "
                        "the unit that "
                        "it was drawn in, or a wider --outlet or --canister",
                        printable(a.mesh), a.meshUnit, sizeText(size), lengthText(m.radius), lengthText(2 * room),
                        lengthText(room)));
    if (m.length < 0.2 * d.length.value)
        throw UsageError(
            fmt::format("--mesh: {} in {} is {}, a fifth of the canister's {} or less; give the unit that "
                        "it was drawn in",
                        printable(a.mesh), a.meshUnit, sizeText(size), lengthText(d.length.value)));
    const double beyond = m.length - d.length.value;
    const double pitch = m.advance > 0 ? m.advance : 2 * m.radius;
    d.throat = a.throat     ? Reasoned{*a.throat, "given"}
               : beyond > 0 ? Reasoned{beyond, "assumed: as far as the mesh reaches beyond the outlet's wall"}
                            : Reasoned{rounded(pitch, 2), "assumed: as far as the mesh conveys in a turn"};
    if (!a.throat) d.assumed.push_back(fmt::format("a throat of {} (--throat)", lengthText(d.throat.value)));
    const double space = d.length.value + d.throat.value;
    if (m.length > space * (1 + 1e-9))
        throw UsageError(fmt::format("--mesh: {} in {} is {} long, canister and throat together {}; give a longer one",
                                     printable(a.mesh), a.meshUnit, lengthText(m.length), lengthText(space)));
    m.at = Vec3(0, 0, space - m.length / 2) - centre;
    for (int i = 0; i < 3; ++i)  // the digits of a mesh in single precision end there
        if (std::abs(m.at[i]) < 1e-5 * m.length) m.at[i] = 0;
    // As a coil of the same reach, with which the spheres are chosen. A blade takes a fifth of its pitch.
    d.pitch = {pitch, "of the mesh"};
    d.wire = {pitch / 5, "of the mesh"};
    d.clearance = {std::max(0.0, room - m.radius), "of the mesh"};
    d.coilLength = {m.length, "of the mesh"};
    d.coilStart = {space - m.length, "so that the mesh ends with the throat"};
    d.notes.push_back(fmt::format("The mesh: {}.", part.facts.text()));
    if (!part.facts.mended.empty())
        d.notes.push_back(fmt::format("Mended in the mesh, places in its unit: {}.", part.facts.mended));
    if (opposite)
        d.notes.push_back(
            fmt::format("Parts of the mesh convey {} a turn one way and others {} the other way, as ribbons of "
                        "opposite hands do; of that the mean is counted. What it doses is not foreseen.",
                        lengthText(form.forwards), lengthText(form.backwards)));
    else if (m.first != m.last)
        d.notes.push_back(
            fmt::format("Its pitch changes: a turn conveys powder by {} at its end in the canister and by {} at "
                        "the outlet; of that the mean is counted.",
                        lengthText(m.first), lengthText(m.last)));
    d.notes.push_back(
        m.advance > 0
            ? fmt::format(
                  "By its form a turn conveys powder by {}, as a screw of that pitch; it turns {} so that "
                  "this is towards the outlet.",
                  lengthText(m.advance),
                  m.turnsPerTurn < 0 ? "clockwise, seen from the outlet," : "anticlockwise, seen from the outlet,")
            : "By its form it conveys no powder along its axis: it is no screw, or its longest direction is not its "
              "axis. What it doses is not foreseen.");
    if (d.coilStart.value > 0.25 * d.length.value)
        d.notes.push_back(
            fmt::format("The mesh is {} long and begins {} from the rear wall; the powder behind it stays.",
                        lengthText(m.length), lengthText(d.coilStart.value)));
    d.mesh = m;
}

}  // namespace vkdose
