// The tables of a study: what is written is read again, and a torn row is not.
#include "host/study/csv_table.h"

#include <catch2/catch.hpp>

#include "tests/model/case_files.h"

using namespace vkdose;

TEST_CASE("what is written into a table is read from it, commas and quotes included") {
    const Row row{"1", "", "a, b", "he said \"no\"", "\"", "plain"};
    CHECK(csvFields(csvLine(row)) == row);
    CHECK(csvLine({"a\nb", "c"}) == "a b,c");
    CHECK(csvFields("") == Row{""});
    CHECK(csvFields(",") == Row{"", ""});
}

TEST_CASE("a row without its end, or with too few fields, is none") {
    const test::Folder folder;
    const auto file = folder.write("t.csv", "a,b\n1,2\n3\n4,\"x,y\"\n5,6");
    const CsvTable table = readTable(file);
    CHECK(table.header == Row{"a", "b"});
    REQUIRE(table.rows.size() == 2);
    CHECK(table.text(table.rows[1], "b") == "x,y");
    CHECK(table.number(table.rows[0], "b") == 2.0);
    CHECK_FALSE(table.number(table.rows[1], "b"));
    CHECK_FALSE(table.number(table.rows[0], "c"));
    CHECK(readTable(folder.path() / "none.csv").header.empty());
}
