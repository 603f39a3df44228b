// Frames as users read them: VTK's own reader (that of ParaView), h5py by the manual's lines, and a picture.
#include <atomic>
#include <cstdlib>

#include "host/backend/reference/reference.h"
#include "host/output/run_folder.h"
#include "host/output/vtkhdf.h"
#include "tests/app/sandbox.h"
#include "tests/support/catch.h"

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

TEST_CASE("VTK opens an image with every value at its place") {
    if (packagesMissing()) return;
    const Sandbox box;
    vtkhdf::Image image;
    image.points = {3, 4, 5};
    image.origin = Vec3(0.1, 0.2, 0.3);
    image.spacing = Vec3(1, 0.5, 0.25);
    std::vector<double> where, number;
    for (int z = 0; z < 5; ++z)
        for (int y = 0; y < 4; ++y)
            for (int x = 0; x < 3; ++x) {
                where.insert(where.end(), {double(x), double(y), double(z)});
                number.push_back(x + 10 * y + 100 * z);
            }
    image.pointData = {{"where", "m", 3, where}, {"number", "", 1, std::vector<float>(number.begin(), number.end())}};
    image.fieldData = {{"TimeValue", "s", 1, std::vector<double>{0.75}}};
    const std::string file = box.write("image.hdf", vtkhdf::file(image)), said = box / "said.txt";
    const std::string script = kPython + " " VKDOSE_SOURCE_DIR "/tests/output/image_check.py ";
    const int status = std::system((script + file + " > " + said + " 2>&1").c_str());
    CAPTURE(readText(said));
    CHECK(status == 0);

    image.pointData[1].components = 3;
    CHECK_THROWS_AS(vtkhdf::file(image), std::invalid_argument);
}

TEST_CASE("VTK and h5py open the frames of a run, and a picture shows them") {
    if (packagesMissing()) return;
    const Sandbox box;
    const Case c = loadCase(VKDOSE_SOURCE_DIR "/cases/mini.toml",
                            {"settle.time_s=0.06", "dose.rotate_s=0.03", "dose.rest_s=0.005", "stop.max_doses=1",
                             "frames.interval_s=0.02", "frames.contacts=true"});
    const auto backend = makeReferenceBackend();
    const std::atomic<bool> stop{false};
    {
        RunFolder folder(box / "run", false, c, "reference", RunRole{.member = 5, .origin = ""});
        const RunResult result = runCase(c, *backend, folder, stop);
        REQUIRE(result.error.empty());
        folder.finish(c, result);
    }
    const std::string said = box / "said.txt", picture = VKDOSE_BINARY_DIR "/tests/frame.png";
    const std::string arguments =
        (box / "run").string() + " " VKDOSE_SOURCE_DIR "/host/output/README.md " + picture + " > " + said + " 2>&1";
    const int status = std::system((kPython + " " VKDOSE_SOURCE_DIR "/tests/output/vtk_check.py " + arguments).c_str());
    CAPTURE(readText(said));
    CHECK(status == 0);
    CHECK_THAT(readText(said), Catch::Contains("all is well"));
}
