// Doses read back from their table.
#include "host/output/dose_table.h"

#include "host/core/error.h"
#include "tests/support/catch.h"
#include "tests/support/folder.h"

using namespace vkdose;
using test::Folder;

namespace {

Dose whole() {
    Dose d;
    d.index = 2;
    d.mass = 3e-3;
    d.complete = true;
    d.target = 2.5e-3;
    d.stopMass = 2.75e-3;
    d.rotation = 0.5;
    d.stoppedBy = StopCause::Torque;
    d.endTime = 1.25;
    return d;
}

std::vector<Dose> read(const std::string& text) {
    const Folder folder;
    return dosesOf(Table::read(folder.write("doses.csv", text)));
}

}  // namespace

TEST_CASE("a dose is read back with what stopped it") {
    const auto doses = read(csvHeader(kDoseColumns) + "\n" + csvRow(kDoseColumns, whole()) + "\n");
    REQUIRE(doses.size() == 1);
    CHECK(doses[0].mass == 3e-3);
    CHECK(doses[0].complete);
    CHECK(doses[0].target == 2.5e-3);
    CHECK(doses[0].overshoot() == Approx(0.25e-3));
    CHECK(doses[0].rotation == 0.5);
    CHECK(doses[0].stoppedBy == StopCause::Torque);
    CHECK(doses[0].endTime == 1.25);
}

TEST_CASE("a table of doses without one of its columns is refused by name") {
    std::string header = csvHeader(kDoseColumns), row = csvRow(kDoseColumns, whole());
    header.resize(header.rfind(','));
    row.resize(row.rfind(','));
    CHECK_THROWS_WITH(read(header + "\n" + row + "\n"),
                      Catch::Contains("doses.csv") && Catch::Contains("lacks the column end_time_s"));
}

TEST_CASE("an unknown cause is refused with its place") {
    std::string row = csvRow(kDoseColumns, whole());
    row.replace(row.find("torque"), 6, "whim");
    CHECK_THROWS_WITH(read(csvHeader(kDoseColumns) + "\n" + row + "\n"),
                      Catch::Contains("stopped_by") && Catch::Contains("doses.csv:2"));
}
