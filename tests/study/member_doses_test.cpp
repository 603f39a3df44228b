// The doses of a member, as they stand in the table of its sweep.
#include <cmath>

#include "host/output/dose_table.h"
#include "host/sim/dose.h"
#include "host/study/member_result.h"
#include "tests/support/catch.h"
#include "tests/support/folder.h"

using namespace vkdose;
using test::Folder;

TEST_CASE("a table that lacks columns of the doses is no member's") {
    const Folder folder;
    const auto file = folder.write("doses.csv", "dose,mass_kg\n1,2\n");
    CHECK(dosesIn(file.parent_path()).names().empty());
}

TEST_CASE("the doses of a member with bodies and regions stand in the table without them") {
    const Folder folder;
    Dose d;
    d.index = 1;
    d.mass = 3e-3;
    const std::string header = csvHeader(kDoseColumns), row = csvRow(kDoseColumns, d);
    const auto file = folder.write("doses.csv", header + ",screw.torque_Nm,pan.mass_kg\n" + row + ",0.5,0.25\n");
    const Table table = dosesIn(file.parent_path());
    CHECK(table.names() == columnNames(kDoseColumns));
    REQUIRE(table.rows() == 1);
    CHECK(table.number(0, "mass_kg") == 3e-3);
    CHECK(table.row(0).size() == columnNames(kDoseColumns).size());
}

TEST_CASE("a dose without a closed form has an empty field, and is read back without one") {
    const Folder folder;
    Dose d;
    d.index = 1;
    const std::string row = csvRow(kDoseColumns, d);
    const auto file = folder.write("doses.csv", csvHeader(kDoseColumns) + "\n" + row + "\n");
    const Table table = dosesIn(file.parent_path());
    REQUIRE(table.rows() == 1);
    CHECK(table.text(0, "closed_form_mass_kg").empty());
    CHECK(table.text(0, "stop_mass_kg") == "nan");  // as all other columns have it
    const std::vector<Dose> doses = dosesOf(table);
    CHECK(std::isnan(doses.at(0).closedForm));
    CHECK(csvRow(kDoseColumns, doses[0]) == row);
}
