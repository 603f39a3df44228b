// Doses read back from their table, of this version and of one that did not tell what stopped the coil.
#include "host/output/dose_table.h"

#include <cmath>

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

TEST_CASE("an older table leaves open what stopped the coil") {
    const auto doses = read(csvHeader(kPlainDoseColumns) + "\n" + csvRow(kPlainDoseColumns, whole()) + "\n");
    REQUIRE(doses.size() == 1);
    CHECK(doses[0].mass == 3e-3);
    CHECK(doses[0].target == 0);
    CHECK(doses[0].stoppedBy == StopCause::None);
    CHECK(std::isnan(doses[0].overshoot()));
    // As it goes into the tables of today.
    CHECK(read(csvHeader(kDoseColumns) + "\n" + csvRow(kDoseColumns, doses[0]) + "\n").size() == 1);
}

TEST_CASE("an unknown cause is refused with its place") {
    std::string row = csvRow(kDoseColumns, whole());
    row.replace(row.find("torque"), 6, "whim");
    CHECK_THROWS_WITH(read(csvHeader(kDoseColumns) + "\n" + row + "\n"),
                      Catch::Contains("stopped_by") && Catch::Contains("doses.csv:2"));
}
