#include "host/core/csv_table.h"

#include <cmath>

#include "host/core/error.h"
#include "tests/app/sandbox.h"
#include "tests/support/catch.h"

using namespace vkdose;
using vkdose::test::Sandbox;

TEST_CASE("a table by its column names, quoted fields whole, missing numbers NaN") {
    const Sandbox box;
    const Table t = Table::read(box.write("t.csv", "dose,mass,note\n1,0.25,\"a, \"\"b\"\"\"\n2,nan,\n3,,x\n"));
    CHECK(t.rows() == 3);
    CHECK(t.number(0, "mass") == 0.25);
    CHECK(t.text(0, "note") == "a, \"b\"");
    CHECK(std::isnan(t.number(1, "mass")));
    CHECK(std::isnan(t.number(2, "mass")));
    CHECK(t.column("dose") == std::vector<double>{1, 2, 3});
    CHECK(t.has("note"));
    CHECK_FALSE(t.has("notes"));
}

TEST_CASE("no cell is a formula to a spreadsheet, and what is read back is what was written") {
    struct Cell {
        std::string text, written;
    };
    for (const auto& [text, written] : std::vector<Cell>{{"=1+1", "'=1+1"},
                                                         {"+x", "'+x"},
                                                         {"-x", "'-x"},
                                                         {"--1", "'--1"},
                                                         {"@SUM(A1)", "'@SUM(A1)"},
                                                         {"\t=1", "'\t=1"},
                                                         {"=HYPERLINK(\"a\",1)", "\"'=HYPERLINK(\"\"a\"\",1)\""},
                                                         {"'=1", "''=1"},
                                                         {"''@", "'''@"},
                                                         {"-1.5e-3", "-1.5e-3"},
                                                         {"-inf", "-inf"},
                                                         {"'-1", "'-1"},
                                                         {"'", "'"},
                                                         {"it's", "it's"},
                                                         {"a=b", "a=b"},
                                                         {"", ""}}) {
        CAPTURE(text);
        CHECK(csvLine({"a", text, "b"}) == "a," + written + ",b");
        CHECK(csvFields("a," + written + ",b") == Row{"a", text, "b"});
    }
}

TEST_CASE("a line that is still being written is left out") {
    const Sandbox box;
    CHECK(Table::read(box.write("t.csv", "a,b\n1,2\n3,4")).rows() == 1);
    CHECK(Table::read(box.write("u.csv", "a,b\n1,2\n3")).rows() == 1);
    CHECK(Table::read(box / "t.csv", LastLine::Whole).rows() == 2);
    CHECK(Table::read(box.write("v.csv",
                                "\xef\xbb\xbf"
                                "a,b\r\n1,2\r\n"),
                      LastLine::Whole)
              .column("b")
              .at(0) == 2);
}

TEST_CASE("what is wrong with a table is told with its line") {
    const Sandbox box;
    const auto fault = [&](const std::string& text) {
        try {
            Table::read(box.write("t.csv", text)).column("b");
        } catch (const CaseError& e) {
            return e.faults().at(0).text();
        }
        return std::string("none");
    };
    CHECK_THAT(fault("a,b\n1,2\n3\n"), Catch::Contains("t.csv:3") && Catch::Contains("1 fields, the header 2"));
    CHECK_THAT(fault("a,b\n1,two\n"), Catch::Contains("t.csv:2") && Catch::Contains("two"));
    CHECK_THAT(fault("a,c\n1,2\n"), Catch::Contains("lacks the column b"));
    CHECK_THAT(fault("a,b\n\n1,2\n\n3,two\n"), Catch::Contains("t.csv:5: b = two"));
    CHECK_THAT(fault("a,b\n\"1,2\n"), Catch::Contains("t.csv:2: is not CSV"));
    CHECK_THAT(fault(""), Catch::Contains("is empty"));
    CHECK_THROWS_AS(Table::read(box / "none.csv"), CaseError);
    CHECK_THROWS_AS(Table::read(box.path()), CaseError);
}

TEST_CASE("of a table whose writer was killed, what is whole is kept") {
    const Sandbox box;
    const Table table = Table::salvage(box.write("t.csv", "a,b\n1,2\n3\n4,\"x,y\"\n\"5,6\n7,8\n9,10"));
    CHECK(table.names() == Row{"a", "b"});
    REQUIRE(table.rows() == 3);
    CHECK(table.text(1, "b") == "x,y");
    CHECK(table.number(2, "b") == 8);
    CHECK(Table::salvage(box / "none.csv").names().empty());
}

TEST_CASE("rows are added, removed and sorted, a fault still names the line they came from") {
    const Sandbox box;
    Table table = Table::read(box.write("t.csv", "a,b\n3,x\n1,y\n2,z\n"));
    table.add({"1", "w"});
    table.removeIf([](const Row& row) { return row[0] == "3"; });
    table.sort([](const Row& a, const Row& b) { return a[0] < b[0]; });
    CHECK(table.text(0, "b") == "y");
    CHECK(table.text(1, "b") == "w");
    CHECK_THROWS_WITH(table.number(2, "b"), Catch::Contains("t.csv:4: b = z: is not a number"));
}
