// The doses of a member that an older vkdose ran stand in the table of today's columns.
#include "host/sim/dose.h"
#include "host/study/member_result.h"
#include "tests/support/catch.h"
#include "tests/support/folder.h"

using namespace vkdose;
using test::Folder;

TEST_CASE("an older table of doses gets the columns of the stop, without figures") {
    const Folder folder;
    Dose d;
    d.index = 1;
    d.mass = 3e-3;
    const auto file =
        folder.write("doses.csv", csvHeader(kPlainDoseColumns) + "\n" + csvRow(kPlainDoseColumns, d) + "\n");
    const Table table = dosesIn(file.parent_path());
    CHECK(table.names() == columnNames(kDoseColumns));
    REQUIRE(table.rows() == 1);
    CHECK(table.number(0, "mass_kg") == 3e-3);
    CHECK(table.text(0, "stop_mass_kg") == "nan");
    CHECK(table.text(0, "stopped_by") == "none");
    folder.write("doses.csv", "dose,mass_kg\n1,2\n");
    CHECK(dosesIn(file.parent_path()).names().empty());
}

TEST_CASE("the doses of a case with regions are taken without the regions' columns, which follow the others") {
    const Folder folder;
    std::string names, values;
    for (const std::string& name : columnNames(kDoseColumns)) {
        names += (names.empty() ? "" : ",") + name;
        values += values.empty() ? "1" : ",2";
    }
    const auto file = folder.write("doses.csv", names + ",pan.mass_kg,pan.count\n" + values + ",7,8\n");
    const Table table = dosesIn(file.parent_path());
    CHECK(table.names() == columnNames(kDoseColumns));
    REQUIRE(table.rows() == 1);
    CHECK(table.row(0).size() == table.names().size());
    CHECK(table.row(0).back() == "2");
}

TEST_CASE("an older table of members gets the columns of doses to a mass, without figures") {
    Row names{"member", "seed"};
    for (const std::string& name : kOutputColumns)
        if (name == "target_dose_kg")
            break;
        else
            names.push_back(name);
    Table older(names);
    older.add(Row(names.size(), "1"));
    const Table now = withTargetColumns(older);
    Row wanted{"member", "seed"};
    wanted.insert(wanted.end(), kOutputColumns.begin(), kOutputColumns.end());
    CHECK(now.names() == wanted);
    CHECK(now.text(0, "wall_time_s") == "1");
    for (const char* added :
         {"target_dose_kg", "target_error_kg", "overshoot_kg", "rotation_s", "doses_stopped_by_mass"})
        CHECK(now.text(0, added).empty());
}
