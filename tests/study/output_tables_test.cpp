// The list of all tables, from which the manual's reference is made.
#include "host/study/output_tables.h"

#include <set>

#include "host/study/member_result.h"
#include "tests/support/catch.h"

using namespace vkdose;

TEST_CASE("every table is there once, and every column has a name of its own, a unit and a sentence") {
    std::set<std::string> files;
    for (const OutputTable& table : outputTables()) {
        INFO(table.file);
        CHECK(files.insert(table.file).second);
        CHECK(table.about.ends_with("."));
        std::set<std::string> names;
        for (const ColumnText& c : table.columns) {
            INFO(c.name);
            CHECK(names.insert(c.name).second);
            CHECK(c.meaning.ends_with("."));
            // The unit is in the name, but for those that a key of the case names.
            std::string inName = c.unit == "1" ? "" : c.unit;
            for (char& letter : inName)
                if (letter == '/' || letter == ' ') letter = '_';
            if (inName.starts_with("N_m")) inName = "Nm";
            CHECK_THAT(c.name, Catch::Contains(inName));
        }
    }
    for (const char* file : {"timeseries.csv", "doses.csv", "particles.csv", "frames/frames.csv", "fields/NAME.csv",
                             "members.csv, of a sweep", "doses.csv, of a sweep"})
        CHECK(files.contains(file));
}
