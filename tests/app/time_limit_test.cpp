// `--for`: how long a command may take, and how a sweep whose time is up goes on.
#include "host/app/time_limit.h"

#include "host/app/backends.h"
#include "tests/app/sandbox.h"
#include "tests/app/sweep_tables.h"
#include "tests/support/catch.h"

using namespace vkdose;
using namespace vkdose::test;
namespace fs = std::filesystem;

namespace {

const std::string kStudy = R"(base = ")" VKDOSE_SOURCE_DIR R"(/cases/mini.toml"
[set]
settle.time_s = 0.02
dose.rotate_s = 0.05
dose.rest_s = 0.01
stop.max_doses = 1
[[axis]]
key = "contact.friction"
values = [0.2, 0.3, 0.4]
)";

}  // namespace

TEST_CASE("a limit begins when it is made, and is up a little before its time is over") {
    struct Row {
        const char* text;
        double stop;  // [s] after its beginning
    };
    for (const Row& row : {Row{"480s", 456}, Row{"8min", 456}, Row{"2h", 7170}, Row{"48 h", 172770}, Row{"10s", 8},
                           Row{"20 s", 18}, Row{"2s", 1}, Row{"0.001s", 0.0005}}) {
        CAPTURE(row.text);
        double now = 1000;
        const TimeLimit limit(row.text, [&] { return now; });
        CHECK(limit.text() == row.text);
        CHECK_FALSE(limit.isUp());
        now = 1000 + row.stop * (1 - 1e-6);
        CHECK_FALSE(limit.isUp());
        now = 1000 + row.stop * (1 + 1e-6);
        CHECK(limit.isUp());
    }
    for (const char* text : {"480", "s", "8 minutes", "-3s", "0s", "1,5h", "1e9h", "5ms", ""}) {
        CAPTURE(text);
        CHECK_THROWS_AS(TimeLimit(text), UsageError);
    }
}

TEST_CASE("the clock of a limit does not go back") {
    const TimeLimit::Now clock = TimeLimit::wallClock();
    const double before = clock();
    CHECK(clock() >= before);
}

TEST_CASE("a sweep whose time is up ends with its own code, tells what is left, and goes on elsewhere") {
    const Sandbox box;
    box.write("study.toml", kStudy);
    REQUIRE(box.vkdose("sweep study.toml --backend reference --out whole").code == 0);

    // The shortest time is over before the first member begins.
    const auto none = box.vkdose("sweep study.toml --backend reference --jobs 1 --out first --for 0.001s");
    CAPTURE(none.out, none.err);
    CHECK(none.code == 6);
    CHECK_THAT(none.err, Catch::Contains("the time is up; 3 of 3 members left") && Catch::Contains("particle-steps") &&
                             Catch::Contains("vkdose sweep study.toml --out first --backend reference --jobs 1 --for "
                                             "0.001s"));
    CHECK_THAT(none.out, Catch::Contains("0 done, 0 failed"));

    fs::rename(box / "first", box / "moved");
    const auto on = box.vkdose("sweep study.toml --backend reference --out moved --for 2h");
    CAPTURE(on.out, on.err);
    CHECK(on.code == 0);
    CHECK(timeless(box / "moved") == timeless(box / "whole"));
    CHECK(readText(box / "moved/doses.csv") == readText(box / "whole/doses.csv"));
}

TEST_CASE("calibrate and validate keep to a time too, and a wrong one is refused") {
    const Sandbox box;
    box.write("grid.toml", kStudy +
                               "[calibrate]\ntarget_g_per_dose = 0.07\ntolerance_g = 0.01\n"
                               "along = \"contact.friction\"\n");
    const auto grid = box.vkdose("calibrate grid.toml --backend reference --for 0.001s");
    CHECK(grid.code == 6);
    CHECK_THAT(grid.err, Catch::Contains("go on with `vkdose calibrate grid.toml --out out/grid"));

    box.write("search.toml", "base = \"" VKDOSE_SOURCE_DIR
                             "/cases/mini.toml\"\n[calibrate]\nmethod = \"surrogate\"\n"
                             "target_g_per_dose = 0.07\ntolerance_g = 0.01\n[[calibrate.parameter]]\n"
                             "key = \"contact.friction\"\nlow = 0.2\nhigh = 0.6\n");
    const auto search = box.vkdose("calibrate search.toml --backend reference --for 0.001s");
    CHECK(search.code == 6);
    CHECK_THAT(search.err, Catch::Contains("3 of 3 members left"));

    const auto compared = box.vkdose("test validate beverloo heap --backend reference --for 0.001s");
    CAPTURE(compared.err);
    CHECK(compared.code == 6);
    CHECK_THAT(compared.err, Catch::Contains("go on with `vkdose test validate beverloo heap --out out/validate"));

    const auto wrong = box.vkdose("sweep grid.toml --for 480");
    CHECK(wrong.code == 2);
    CHECK_THAT(wrong.err, Catch::Contains("--for 480: lacks the unit (s, min, h); write 480s, 8min or 2h"));
}
