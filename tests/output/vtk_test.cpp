// What users do with frames: VTK's own reader (that of ParaView), h5py by the README's lines, and a picture.
#include <atomic>
#include <catch2/catch.hpp>
#include <cstdlib>

#include "host/backend/reference/reference.h"
#include "host/output/run_folder.h"
#include "tests/app/sandbox.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

// Debian's packages are for Debian's Python, whichever comes first in the path.
const std::string kPython = "/usr/bin/python3";

bool packagesMissing() {
    const std::string imports = " -c 'import vtkmodules.vtkIOHDF, vtkmodules.vtkRenderingOpenGL2, h5py'";
    if (std::system((kPython + imports + " > /dev/null 2>&1 && command -v Xvfb > /dev/null 2>&1").c_str()) == 0)
        return false;
    WARN("skipped: VTK, h5py or Xvfb is not installed (tools/packages-vtk)");
    return true;
}

}  // namespace

TEST_CASE("VTK and h5py open the frames of a run, and a picture shows them") {
    if (packagesMissing()) return;
    const Sandbox box;
    const Case c = loadCase(VKDOSE_SOURCE_DIR "/cases/mini.toml",
                            {"settle.time_s=0.06", "dose.rotate_s=0.03", "dose.rest_s=0.005", "stop.max_doses=1",
                             "frames.interval_s=0.02", "frames.contacts=true"});
    const auto backend = makeReferenceBackend();
    const std::atomic<bool> stop{false};
    {
        RunFolder folder(box / "run", false, c, "reference", 5);
        const RunResult result = runCase(c, *backend, folder, stop);
        REQUIRE(result.error.empty());
        folder.finish(c, result);
    }
    const std::string said = box / "said.txt", picture = VKDOSE_BINARY_DIR "/tests/frame.png";
    const std::string arguments =
        (box / "run").string() + " " VKDOSE_SOURCE_DIR "/README.md " + picture + " > " + said + " 2>&1";
    const int status = std::system((kPython + " " VKDOSE_SOURCE_DIR "/tests/output/vtk_check.py " + arguments).c_str());
    CAPTURE(readText(said));
    CHECK(status == 0);
    CHECK_THAT(readText(said), Catch::Contains("all is well"));
}
