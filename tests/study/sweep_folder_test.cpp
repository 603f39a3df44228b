// Which folders a sweep writes into.
#include <fstream>

#include "host/model/case.h"
#include "tests/study/sweeping.h"
#include "tests/support/catch.h"

using namespace vkdose;
using namespace vkdose::test;
namespace fs = std::filesystem;

TEST_CASE("a sweep does not write into a folder that holds something else, or that another sweep holds") {
    const Sweeping sweep;
    fs::create_directories(sweep.out);
    std::ofstream(sweep.out / "thesis.tex") << "x";
    MadeUpRuns runs(1);
    CHECK_THROWS_WITH(sweep.run(runs), Catch::Contains("something else than a sweep"));
    fs::remove(sweep.out / "thesis.tex");
    // Files and a folder of the names that a sweep uses make no sweep.
    fs::create_directories(sweep.out / "members");
    for (const char* name : {"study.toml", "base.toml"}) std::ofstream(sweep.out / name) << "my own";
    CHECK_THROWS_WITH(sweep.run(runs), Catch::Contains("something else than a sweep"));
    CHECK(readText(sweep.out / "study.toml") == "my own");
    // Even with members and the very base of the study: another study, and what a sweep leaves at its end, are the
    // user's own as long as no table tells that a sweep was there.
    std::ofstream(sweep.out / "base.toml") << loadCase(sweep.place.study().base).resolved;
    CHECK_THROWS_WITH(sweep.run(runs), Catch::Contains("something else than a sweep"));
    CHECK(readText(sweep.out / "study.toml") == "my own");
    std::ofstream(sweep.out / "study.toml") << sweep.place.study().text;
    std::ofstream(sweep.out / "design-2.toml") << "my own";
    CHECK_THROWS_WITH(sweep.run(runs), Catch::Contains("something else than a sweep"));
    CHECK(readText(sweep.out / "design-2.toml") == "my own");
    for (const char* name : {"members", "study.toml", "base.toml", "design-2.toml"}) fs::remove(sweep.out / name);
    const Study study = sweep.place.study();
    const std::vector<Member> members = membersOf(study);
    const SweepFolder held(sweep.out, study, members);
    CHECK_THROWS_WITH(sweep.run(runs), Catch::Contains("another vkdose is sweeping"));
    CHECK(runs.started.empty());
}
