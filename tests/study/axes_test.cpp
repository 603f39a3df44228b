// Axes whose points fill a box, or come from a table.
#include <algorithm>
#include <cmath>

#include "tests/study/study_files.h"
#include "tests/support/catch.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

std::string withAxis(const std::string& axis) {
    return "base = \"good.toml\"\n[[axis]]\n" + axis;
}

const std::string kBox = "keys = [\"contact.friction\", \"coil.speed_rpm\"]\nlow = [0.1, 60]\nhigh = [0.9, 120]\n";

}  // namespace

TEST_CASE("points in a box fill it evenly, lie within it, and more of them leave the first as they are") {
    const StudyFolder folder;
    const auto few = folder.members(withAxis(kBox + "points = 8\n"));
    const auto many = folder.members(withAxis(kBox + "points = 32\n"));
    REQUIRE(few.size() == 8);
    REQUIRE(many.size() == 32);
    int quarters[2][4] = {};
    for (std::size_t i = 0; i < many.size(); ++i) {
        if (i < few.size()) CHECK(many[i].values == few[i].values);
        const double u[2] = {(std::stod(many[i].values[0]) - 0.1) / 0.8, (std::stod(many[i].values[1]) - 60) / 60};
        for (int k = 0; k < 2; ++k) {
            REQUIRE(u[k] > 0);
            REQUIRE(u[k] < 1);
            ++quarters[k][int(4 * u[k])];
        }
    }
    // Of 32 even points each quarter of each side has 8, to two.
    for (const auto& side : quarters)
        for (const int count : side) CHECK(std::abs(count - 8) <= 2);
    const Case c = loadResolvedCase(many[5].caseText, folder / "good.toml");
    CHECK(c.dosingLaw.between(0, 0).mu == std::stod(many[5].values[0]));

    CHECK(folder.members(withAxis("key = \"contact.friction\"\nlow = 0.1\nhigh = 0.9\npoints = 1\n"))[0].values ==
          std::vector<std::string>{"0.5"});
}

TEST_CASE("a table has the keys as columns and the points as rows") {
    const StudyFolder folder;
    folder.write(
        "draws.csv",
        "# of a powder\ncontact.friction,canister.floor,stop.max_doses\n0.31,flat,2\n0.42,trough,3\n0.5,flat,4\n");
    const auto all = folder.members(withAxis("table = \"draws.csv\"\n"));
    REQUIRE(all.size() == 3);
    CHECK(folder.study(withAxis("table = \"draws.csv\"\n")).keys() ==
          std::vector<std::string>{"contact.friction", "canister.floor", "stop.max_doses"});
    CHECK(all[1].values == std::vector<std::string>{"0.42", "trough", "3"});
    const Case c = loadResolvedCase(all[0].caseText, folder / "good.toml");
    CHECK(c.dosingLaw.between(0, 0).mu == 0.31);
    CHECK(c.canister->flatFloor);
    CHECK(c.schedule.stop.maxDoses == 2);
    CHECK(folder.members(withAxis("table = \"draws.csv\"\npoints = 2\n")).size() == 2);
    // Another axis crosses it.
    CHECK(folder.members(withAxis("table = \"draws.csv\"\n[[axis]]\nkey = \"coil.turns\"\nvalues = [3, 4]\n")).size() ==
          6);
}

TEST_CASE("a box or a table that is none is refused by name") {
    const StudyFolder folder;
    folder.write("draws.csv", "contact.friction,coil.turns\n0.31,3\n0.42,4\n");
    folder.write("none.csv", "contact.friction\n");
    folder.write("twice.csv", "contact.friction,contact.friction\n0.3,0.3\n");
    struct Fault {
        std::string axis, key, says;
    };
    const std::string friction = "key = \"contact.friction\"\n";
    for (const Fault& row : std::vector<Fault>{
             {kBox, "axis[0].points", "is missing"},
             {kBox + "points = 0\n", "axis[0].points", "too small"},
             {friction + "low = 0.1\npoints = 3\n", "axis[0].high", "is not a number"},
             {friction + "low = [0.1]\nhigh = 0.9\npoints = 3\n", "axis[0].low", "is not a number"},
             {friction + "low = 0.9\nhigh = 0.1\npoints = 3\n", "axis[0].high", "0.1 is not above 0.9"},
             {replaced(kBox, "[0.1, 60]", "[0.1]") + "points = 3\n", "axis[0].low", "a number for each of the keys"},
             {replaced(kBox, "[0.9, 120]", "0.9") + "points = 3\n", "axis[0].high", "a number for each of the keys"},
             {friction + "values = [0.1]\npoints = 3\n", "axis[0].points", "is of a box or of a table"},
             {friction + "low = 0.1\nhigh = 0.9\npoints = 3\nvalues = [0.2]\n", "axis[0].values", "in another way too"},
             {"table = \"draws.csv\"\nkey = \"contact.friction\"\n", "axis[0].key", "columns of the table"},
             {"table = \"draws.csv\"\nvalues = [1]\n", "axis[0].values", "in another way too"},
             {"table = \"nowhere.csv\"\n", "axis[0].table", "there is no file"},
             {"table = \"draws.csv\"\npoints = 3\n", "axis[0].points", "draws.csv has 2 rows"},
             {"table = \"none.csv\"\n", "axis[0].table", "none.csv has 0 rows"},
             {"table = \"twice.csv\"\n", "axis[0].table", "given twice"},
             {"table = 3\n", "axis[0].table", "not a string"},
         }) {
        CAPTURE(row.axis);
        const auto faults = faultsOf(folder, withAxis(row.axis));
        CHECK(std::any_of(faults.begin(), faults.end(), [&](const Diagnostic& d) {
            return d.key == row.key && d.line > 0 && d.problem.find(row.says) != std::string::npos;
        }));
    }
    // A value that the case refuses is told with its point.
    folder.write("draws.csv", "contact.friction\n0.31\nrough\n");
    const auto faults = faultsOf(folder, withAxis("table = \"draws.csv\"\n"));
    REQUIRE(faults.size() == 1);
    CHECK_THAT(faults[0].text(), Catch::Contains("contact.friction") && Catch::Contains("rough"));
}
