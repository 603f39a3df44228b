#include <fmt/format.h>

#include "geometry/coil_mesh.h"
#include "host/app/commands.h"
#include "host/app/exit_code.h"
#include "host/app/inputs.h"
#include "host/core/file.h"
#include "host/core/printable.h"
#include "host/model/case.h"
#include "host/output/run_folder.h"

namespace vkdose {

int exportCoilCommand(const ExportCoilOptions& options) {
    const Case c = loadCase(options.input.file, options.input.overrides);
    keepInputs(c.files, {options.out});
    requireSuffix(options.out, ".stl", "an STL mesh");
    if (!c.world.coil) throw UsageError("export-coil: the case has no coil");
    const std::vector<geometry::Triangle> mesh = geometry::coilMesh(*c.world.coil, options.around, options.perTurn);
    replaceFile(options.out, geometry::stlText(mesh));
    fmt::print("{} triangles in {}, lengths in metres\n", mesh.size(), printable(options.out.string()));
    return kOk;
}

}  // namespace vkdose
