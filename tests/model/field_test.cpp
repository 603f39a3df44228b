// The tables [[field]]: defaults, presets and faults.

#include "host/core/error.h"
#include "tests/model/case_files.h"
#include "tests/support/catch.h"
#include "tests/support/near.h"

using namespace vkdose;
using test::Folder;
using test::kFreeCase;
using test::kGoodCase;
using test::near;

namespace {

const std::string kTwo = "x,y,z,r\n0,0,0,1e-3\n0,3e-3,0,1e-3\n";

std::vector<FieldSensor> fieldsOf(const std::string& text) {
    const Folder folder;
    folder.write("two.csv", kTwo);
    const Case c = loadCase(folder.write("case.toml", text));
    const Case again = loadResolvedCase(c.resolved, folder.path() / "case.toml");
    REQUIRE(again.resolved == c.resolved);
    REQUIRE(again.fields.size() == c.fields.size());
    return c.fields;
}

void refused(const std::string& tables, const std::string& key, const std::string& fragment,
             const std::string& good = kGoodCase) {
    INFO(tables);
    const Folder folder;
    folder.write("two.csv", kTwo);
    try {
        loadCase(folder.write("case.toml", good + tables));
        FAIL_CHECK("is accepted");
    } catch (const CaseError& error) {
        REQUIRE(error.faults().size() == 1);
        CHECK(error.faults()[0].key == key);
        CHECK_THAT(error.faults()[0].text(), Catch::Contains(fragment));
    }
}

}  // namespace

TEST_CASE("presets of fields take their boxes from the canister") {
    const Folder folder;
    const Case c = loadCase(folder.write("case.toml", kGoodCase));
    const Canister& can = *c.canister;
    const auto fields = fieldsOf(kGoodCase + R"([[field]]
preset = "height-profile"
[[field]]
preset = "mid-plane"
[[field]]
preset = "outlet"
[[field]]
)");
    REQUIRE(fields.size() == 4);
    const double d = 2.2e-3, tight = 1e-12;  // the mean diameter
    CHECK(fields[0].name == "height-profile");
    CHECK(fields[0].request.grid.cells == std::array<std::uint32_t, 3>{1, 1, 8});  // 16 mm in cells of 2.2
    CHECK(near(fields[0].request.grid.high.z, can.length, can.length, tight));
    CHECK(fields[0].interval == 0.01);
    CHECK(near(fields[1].request.width, d, d, tight));
    CHECK(near(fields[1].request.grid.low.x, -d, d, tight));
    CHECK(near(fields[1].request.grid.high.z, can.length + can.throatLength, d, tight));
    CHECK(fields[1].request.grid.cells[0] == 1);
    CHECK(fields[1].request.grid.cells[1] > 1);
    CHECK(near(fields[1].interval, 0.1, 0.1, tight));
    CHECK(fields[2].request.grid.points() == 1);
    CHECK(near(fields[2].request.grid.low.z, can.length, d, tight));
    CHECK(fields[3].name == "field-4");
    CHECK(near(fields[3].request.grid.low, Vec3(-can.width / 2, -can.width / 2, 0), d, tight));
    CHECK(near(fields[3].request.grid.high.y, can.height - can.width / 2, d, tight));
    CHECK(fields[3].request.grid.resolvedDirections() == 3);
}

TEST_CASE("a field of one's own, also without a canister") {
    const auto fields = fieldsOf(kFreeCase + R"([[field]]
name = "mine"
kernel = "lucy"
width_mm = 6.0
low = [-0.01, 0.0, -0.01]
high = [0.01, 0.05, 0.01]
cells = [1, 20, 8]
interval_s = 0.02
average = true
stress = true
)");
    REQUIRE(fields.size() == 1);
    const FieldSensor& f = fields[0];
    CHECK(f.name == "mine");
    CHECK(f.request.kernel == Kernel::Lucy);
    CHECK(near(f.request.width, 6e-3, 6e-3, 1e-12));
    CHECK(f.request.grid.high == Vec3(0.01, 0.05, 0.01));
    CHECK(f.request.grid.cells == std::array<std::uint32_t, 3>{1, 20, 8});
    CHECK(f.interval == 0.02);
    CHECK(f.average);
    CHECK(f.stress);
    CHECK(f.request.contactStress);
}

TEST_CASE("faults of a field are told with what would be right") {
    refused("[[field]]\npreset = \"outlit\"\n", "field[0].preset", "height-profile");
    refused("[[field]]\nkernel = \"box\"\n", "field[0].kernel", "gaussian, lucy");
    refused("[[field]]\nname = \"a/b\"\n", "field[0].name", "letters, digits");
    refused("[[field]]\npreset = \"outlet\"\n[[field]]\npreset = \"outlet\"\n", "field[1].name", "a name of its own");
    refused("[[field]]\ncells = [1, 2.5, 3]\n", "field[0].cells", "whole numbers");
    refused("[[field]]\ncells = [1, 0, 3]\n", "field[0].cells", "whole numbers");
    refused("[[field]]\ncells = [200, 200, 200]\n", "field[0].cells", "1000000");
    refused("[[field]]\nwidth_mm = 0.1\ncells = [5, 5, 5]\n", "field[0].cells", "cells of at most");
    refused("[[field]]\nwidth_mm = 10\ncells = [90, 90, 90]\n", "field[0].cells", "larger cells");
    refused("[[field]]\nlow = [0, 0, 0]\nhigh = [0.1, -0.1, 0.1]\n", "field[0].low", "low < high");
    refused("[[field]]\ninitial_height_mm = 3\n", "field[0].initial_height_mm", "unknown");
    refused("[[field]]\nwidth_mm = -1\n", "field[0].width_mm", "> 0");
    refused("[[field]]\npreset = \"outlet\"\n", "field[0].preset", "needs a canister", kFreeCase);
    refused("[[field]]\nhigh = [1, 1, 1]\n", "field[0].low", "missing", kFreeCase);
    refused("[field]\nname = \"x\"\n", "field", "[[field]]");
}
