#include <fmt/format.h>

#include <fstream>

#include "geometry/coil_mesh.h"
#include "host/app/commands.h"
#include "host/app/exit_code.h"
#include "host/core/error.h"
#include "host/model/case.h"
#include "host/output/run_folder.h"

namespace vkdose {

int exportCoilCommand(const ExportCoilOptions& options) {
    const Case c = loadCase(options.input.file, options.input.overrides);
    if (!c.world.coil) throw UsageError("export-coil: the case has no coil");
    const std::vector<geometry::Triangle> mesh = geometry::coilMesh(*c.world.coil, options.around, options.perTurn);
    std::ofstream stream(options.out, std::ios::binary);
    stream << geometry::stlText(mesh);
    stream.close();
    if (!stream) throw OutputError("cannot write " + options.out.string());
    fmt::print("{} triangles in {}\n", mesh.size(), options.out.string());
    return kOk;
}

}  // namespace vkdose
