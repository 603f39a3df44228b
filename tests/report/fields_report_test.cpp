#include "host/report/fields_report.h"

#include <cmath>

#include "tests/report/faults.h"
#include "tests/report/fields.h"
#include "tests/report/folders.h"
#include "tests/report/stream.h"
#include "tests/support/catch.h"
#include "tests/support/near.h"

using namespace vkdose;
using namespace vkdose::report;
using namespace vkdose::test;

namespace {

double root(double level) {
    return std::copysign(level / 127 * level / 127, level);
}

}  // namespace

TEST_CASE("maps come out of the page's stream as exact as it says, rows from above") {
    const Sandbox box;
    const Case c = caseWithFields(true);
    writeMaps(box, c, 3);
    const Json j = fieldsJson(box / "run", c);
    REQUIRE(j["maps"].size() == 1);
    const Json& map = j["maps"][0];
    CHECK(map["name"] == "plane");
    CHECK(map["axes"] == Json({"z", "y"}));
    CHECK(map["cells"] == Json({4, 3}));
    CHECK(map["low_m"] == Json({0.0, -7e-3}));
    CHECK(map["high_m"] == Json({16e-3, 5e-3}));
    CHECK(map["over"] == Json({{"axis", "x"}, {"low_m", -1e-3}, {"high_m", 1e-3}}));
    CHECK(map["time_s"] == Json({0.1, 0.2, 0.3}));
    CHECK(map["phase"] == Json({"settle", "rotate", "rotate"}));
    CHECK(map["dose"] == Json({0, 1, 2}));
    CHECK(map["stored"] == 3);
    // Scales: those of dosing, not of the fall before.
    const std::vector<double> most{300, 0.3, 0.3, 27, 3, 0};
    REQUIRE(map["quantities"].size() == most.size());
    for (std::size_t q = 0; q + 1 < most.size(); ++q)
        CHECK(near(map["quantities"][q]["most"].get<double>(), most[q], most[q], 1e-8));
    CHECK(map["quantities"][3]["name"] == "pressure of contacts");

    Bytes bytes(map["stream"].get<std::string>());
    std::vector<std::vector<int>> levels(most.size(), std::vector<int>(12, 0));
    for (int f = 0; f < 3; ++f) {
        for (auto& list : levels) bytes.levelsOnTop(list);
        CAPTURE(f);
        for (std::size_t row = 0; row < 3; ++row)
            for (std::size_t z = 0; z < 4; ++z) {
                const FieldPoint p = pointAt(2 - row, z, f == 0 ? 1.0 : 0.1);
                const std::size_t i = 4 * row + z;
                CAPTURE(row, z);
                CHECK(near(levels[0][i] / 255.0, p.density / most[0], 1, 0.51 / 255));
                if (!(p.density > 0)) {
                    CHECK(levels[1][i] == 128);
                    continue;
                }
                const Vec3 v = p.velocity() / 0.3;  // the fall's own lie beyond the scale
                for (int k = 0; k < 2; ++k) {
                    const double part = std::clamp(k == 0 ? v.z : v.y, -1.0, 1.0);
                    CHECK(near(root(levels[1 + std::size_t(k)][i] - 128), part, 1, 1.01 / 127));
                }
                const double share = levels[3][i] / 255.0;
                CHECK(near(share * share, 9.0 * double(z) / 27, 1, 1.01 / 255));
                CHECK(near(levels[4][i] / 255.0, double(z) / 3, 1, 0.51 / 255));
            }
    }
    CHECK(bytes.over());
    CHECK(streamCharacters(j) == map["stream"].get<std::string>().size());
}

TEST_CASE("a plane across the axis shows x, one from above z over x") {
    const Sandbox box;
    Case c = caseWithFields(false);
    FieldGrid& grid = c.fields[0].request.grid;
    grid.cells = {4, 3, 1};
    writeMaps(box, c, 1);
    CHECK(fieldsJson(box / "run", c)["maps"][0]["axes"] == Json({"x", "y"}));
    grid.cells = {3, 1, 4};
    CHECK(fieldsJson(box / "run", c)["maps"][0]["axes"] == Json({"z", "x"}));
    CHECK(fieldsJson(box / "run", c)["maps"][0]["cells"] == Json({4, 3}));
}

TEST_CASE("of more maps than there is room for every n-th and the last are in the page") {
    const Sandbox box;
    const Case c = caseWithFields(false);
    constexpr int kMaps = 11;
    constexpr std::size_t kBytes = 36;  // of one
    writeMaps(box, c, kMaps);
    for (std::size_t room = 2; room < kMaps; ++room) {
        const Json map = fieldsJson(box / "run", c, room * kBytes)["maps"][0];
        CAPTURE(room);
        CHECK(map["time_s"].size() <= room);
        CHECK(map["time_s"].size() >= 2);
        CHECK(map["dose"].back() == kMaps - 1);
        CHECK(map["stored"] == kMaps);
    }
    CHECK(fieldsJson(box / "run", c, kMaps * kBytes)["maps"][0]["time_s"].size() == kMaps);
    const Json none = fieldsJson(box / "run", c, 2 * kBytes - 1);
    CHECK(none["maps"][0]["stream"].is_null());
    CHECK(streamCharacters(none) == 0);
}

TEST_CASE("height profiles: the last row of each dose, and all rows") {
    const Sandbox box;
    const Case c = caseWithFields(false, true);
    {
        FieldFiles files(box / "run", c);
        for (int n = 0; n < 5; ++n) {
            FieldSample f;
            f.field = 1;
            f.number = n;
            f.time = 0.1 * n;
            f.dose = (n + 1) / 2;
            f.heights = {0.01 * n, NAN, 0.0123456789, 0.04};
            files.write(f);
        }
    }
    const Json j = fieldsJson(box / "run", c);
    CHECK(j["maps"].empty());
    REQUIRE(j["profiles"].size() == 1);
    const Json& profile = j["profiles"][0];
    for (int i = 0; i < 4; ++i) CHECK(near(profile["z_m"][i].get<double>(), 2e-3 + 4e-3 * i, 16e-3, 1e-12));
    CHECK(profile["rows"].size() == 5);
    REQUIRE(profile["states"].size() == 3);
    const int last[] = {0, 2, 4};
    for (int k = 0; k < 3; ++k) {
        CHECK(profile["states"][k]["dose"] == k);
        CHECK(profile["states"][k]["height_m"] == Json({0.01 * last[k], nullptr, 0.012346, 0.04}));
    }
}

TEST_CASE("a run without fields has none to show, a damaged map is named") {
    const Sandbox box;
    const Case c = caseWithFields(false);
    CHECK(fieldsJson(box / "run", loadCase(VKDOSE_SOURCE_DIR "/cases/mini.toml")).is_null());
    std::filesystem::create_directories(box / "run");
    CHECK(fieldsJson(box / "run", c).is_null());
    { FieldFiles files(box / "run", c); }
    CHECK(fieldsJson(box / "run", c).is_null());  // nothing has been kept so far

    writeMaps(box, c, 2);
    const std::string text = readText(box / "run/fields/plane_000001.csv");
    box.write("run/fields/plane_000001.csv", text.substr(0, text.rfind('\n', text.size() - 2) + 1));
    CHECK_THAT(faultOf([&] { fieldsJson(box / "run", c); }),
               Catch::Contains("plane_000001.csv") && Catch::Contains("has 11 points") && Catch::Contains("has 12"));
    std::filesystem::remove(box / "run/fields/plane_000001.csv");
    CHECK_THAT(faultOf([&] { fieldsJson(box / "run", c); }), Catch::Contains("plane.csv:3") &&
                                                                 Catch::Contains("plane_000001.csv") &&
                                                                 Catch::Contains("is not there"));
}
