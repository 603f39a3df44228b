// Readings of a balance, as people write them down, and their faults.
#include "host/analysis/balance.h"

#include "host/core/error.h"
#include "tests/app/sandbox.h"
#include "tests/support/catch.h"

using namespace vkdose;
using vkdose::test::Sandbox;

TEST_CASE("a balance's readings are masses of doses, or sums of them, in any order of columns") {
    const Sandbox box;
    const BalanceReadings masses = readBalance(box.write("b.csv", "dose,mass_g\n1,3\n2,4\n3,0.5"));
    const BalanceReadings sums =
        readBalance(box.write("c.csv", "cumulative_g, by ,dose\r\n3,me,1\r\n7,me,2\r\n7.5,you,3\r\n"));
    for (const BalanceReadings& b : {masses, sums}) {
        REQUIRE(b.mass.size() == 3);
        REQUIRE(b.cumulative.size() == 3);
        // Sums of a few numbers: rounding.
        CHECK(b.mass[1] == Approx(0.004).epsilon(1e-12));
        CHECK(b.mass[2] == Approx(0.0005).epsilon(1e-12));
        CHECK(b.cumulative[2] == Approx(0.0075).epsilon(1e-12));
    }
    CHECK(readBalance(box.write("e.csv", "dose,mass_g\n")).mass.empty());
}

TEST_CASE("what is wrong with a balance's readings is told with line and column") {
    const Sandbox box;
    const auto fault = [&](const std::string& text) {
        try {
            readBalance(box.write("b.csv", text));
        } catch (const CaseError& e) {
            return e.faults().at(0).text();
        }
        return std::string("none");
    };
    CHECK_THAT(fault("n,mass_g\n1,2\n"), Catch::Contains("b.csv:1: the header is not dose and either mass_g"));
    CHECK_THAT(fault("dose,mass_g,cumulative_g\n1,2,2\n"), Catch::Contains("b.csv:1: the header is not"));
    CHECK_THAT(fault("dose,mass_g\n1,2\n\n3,2\n"), Catch::Contains("b.csv:4: dose = 3: dose 2 should come here"));
    CHECK_THAT(fault("dose,mass_g\n1,two\n"), Catch::Contains("b.csv:2: mass_g = two: is not a number"));
    CHECK_THAT(fault("dose,mass_g\n1,\n"), Catch::Contains("b.csv:2: mass_g: is not a number"));
    CHECK_THAT(fault("dose,mass_g\n1,inf\n"), Catch::Contains("is not a number"));
    CHECK_THAT(fault("dose,mass_g\n1\n"), Catch::Contains("b.csv:2: has 1 fields, the header 2"));
    CHECK_THAT(fault(""), Catch::Contains("is empty"));
}
