#include <fmt/format.h>

#include <algorithm>

#include "geometry/coil_mesh.h"
#include "geometry/mesh_writer.h"
#include "host/app/commands.h"
#include "host/app/exit_code.h"
#include "host/app/inputs.h"
#include "host/app/tell.h"
#include "host/core/error.h"
#include "host/core/file.h"
#include "host/core/printable.h"
#include "host/model/body_mesh.h"
#include "host/model/case.h"

namespace vkdose {

namespace {

/// A part of the case that can be written, in its place.
struct Part {
    std::string name;
    std::vector<geometry::Triangle> mesh;
};

std::vector<Part> partsOf(const Case& c, const ExportBodyOptions& options) {
    const double angle = options.angle * kPi / 180;
    std::vector<Part> parts;
    if (c.world.coil) {
        geometry::Coil coil = *c.world.coil;
        coil.startAngle += angle;
        parts.push_back({kCoilName, geometry::coilMesh(coil, options.around, options.perTurn)});
    }
    for (const RigidBody& body : c.world.bodies)
        parts.push_back({body.name, placed(bodyMesh(body, c.world.domain, options.perTurn, options.around),
                                           body.pose(options.time, angle, options.time))});
    return parts;
}

}  // namespace

int exportBodyCommand(const ExportBodyOptions& options) {
    const Case c = loadCase(options.input.file, options.input.overrides);
    keepInputs(c.files, {options.out});
    requireSuffix(options.out, ".stl", "an STL mesh");
    const std::vector<Part> parts = partsOf(c, options);
    std::string known;
    for (const Part& part : parts) known += (known.empty() ? "" : ", ") + part.name;
    if (parts.empty()) throw UsageError("export-body: the case has neither a coil nor a body");
    const auto wanted = [&options](const std::string& name) {
        return options.names.empty() ||
               std::find(options.names.begin(), options.names.end(), name) != options.names.end();
    };
    for (const std::string& name : options.names)
        if (std::none_of(parts.begin(), parts.end(), [&](const Part& part) { return part.name == name; }))
            throw UsageError(
                fmt::format("export-body: the case has no \"{}\"; give one of: {}", printable(name), known));
    std::vector<geometry::Triangle> mesh;
    std::string written;
    for (const Part& part : parts) {
        if (!wanted(part.name)) continue;
        mesh.insert(mesh.end(), part.mesh.begin(), part.mesh.end());
        written += (written.empty() ? "" : ", ") + part.name;
    }
    try {
        const std::string title = fmt::format("vkdose: {}, lengths in {}", c.name, options.unit);
        replaceFile(options.out, geometry::stlBytes(mesh, title, *geometry::metresIn(options.unit)));
    } catch (const geometry::MeshError& e) {
        throw UsageError(fmt::format("export-body: {}; give a larger --unit", e.what()));
    }
    tell("{}: {} triangles in {}, lengths in {}\n", written, mesh.size(), printable(options.out.string()),
         options.unit);
    return kOk;
}

}  // namespace vkdose
