#include "host/report/table.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "host/core/error.h"
#include "tests/app/sandbox.h"

using namespace vkdose;
using vkdose::report::LastLine;
using vkdose::report::Table;
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
    CHECK_THAT(fault("a,b\n\"1,2\n"), Catch::Contains("is not CSV"));
    CHECK_THAT(fault(""), Catch::Contains("is empty"));
    CHECK_THROWS_AS(Table::read(box / "none.csv"), CaseError);
}
