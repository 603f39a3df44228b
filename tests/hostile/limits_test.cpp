// Limits of the shell on stacks and on the address space: a run works, or says what it lacks.
#include <filesystem>
#include <fstream>
#include <string>

#include "tests/app/sandbox.h"
#include "tests/support/gpu.h"

using namespace vkdose;
using namespace vkdose::test;
using Catch::Contains;

namespace {

#if defined(__SANITIZE_ADDRESS__)
constexpr bool kSanitized = true;  // the sanitizer itself needs terabytes of address space
#else
constexpr bool kSanitized = false;
#endif

/// The mini case cut to a few hundred steps. Its passes are compiled anew, as on a machine that has kept none.
const std::string kRun = "run '" VKDOSE_SOURCE_DIR
                         "/cases/mini.toml' --set settle.time_s=0.01 --set dose.rotate_s=0.005 --set dose.rest_s=0.002 "
                         "--set stop.max_doses=1 --quiet --force --out out";
const std::string kAnew = "MESA_SHADER_CACHE_DISABLE=true ";

}  // namespace

TEST_CASE("a small limit on stacks reaches neither the program nor its driver") {
    const Sandbox box;
    REQUIRE(box.vkdose(kRun).code == 0);
    const std::string whole = readText(box / "out/timeseries.csv");
    for (const std::string limit : {"ulimit -s 64; ", "ulimit -S -s 64; ", "ulimit -s 300; "}) {
        const auto o = box.vkdose(kRun, limit + kAnew);
        CAPTURE(limit, o.err);
        CHECK(o.code == 0);
        CHECK(readText(box / "out/timeseries.csv") == whole);
        const auto picture = box.vkdose("render out --out picture.png --size 300x200", limit + kAnew);
        CAPTURE(picture.err);
        CHECK(picture.code == 0);
    }
}

TEST_CASE("where a limit on the address space is too small, that is what the program says") {
    if (kSanitized) {
        WARN("skipped: the address sanitizer takes more address space than any limit here");
        return;
    }
    const Sandbox box;
    int worked = 0, refused = 0;
    for (const int mebibytes : {60, 120, 180, 240, 280, 320, 360, 400, 450, 500, 600, 4000}) {
        const auto o =
            box.vkdose(kRun, "ulimit -v " + std::to_string(mebibytes * 1024) + "; LP_NUM_THREADS=0 " + kAnew);
        CAPTURE(mebibytes, o.code, o.out, o.err);
        if (o.code == 0) {
            ++worked;
            continue;
        }
        // Below some hundred MiB the system cannot even load the program's libraries.
        if (o.code == 127) {
            CHECK_THAT(o.err, Contains("error while loading shared libraries"));
            continue;
        }
        CHECK((o.code == 3 || o.code == 4));
        CHECK_THAT(o.err, Contains("(ulimit -v)") && Contains(std::to_string(mebibytes) + " MiB"));
        ++refused;
    }
    CHECK(worked >= 1);
    CHECK(refused >= 1);
}

TEST_CASE("a file that the memory does not hold is refused by name") {
    if (kSanitized) {
        WARN("skipped: the address sanitizer takes more address space than any limit here");
        return;
    }
    const Sandbox box;
    std::ofstream(box / "huge.toml") << "seed = 1\n";
    std::filesystem::resize_file(box / "huge.toml", std::uintmax_t{4} << 30U);  // a hole: it takes no room
    const auto o = box.vkdose("check huge.toml", "ulimit -v 1000000; ");
    CAPTURE(o.out, o.err);
    CHECK(o.code == 2);
    CHECK_THAT(o.err, Contains("huge.toml") && Contains("no memory for its 4096 MiB"));
}

TEST_CASE("the reference under a limit on the address space says so too") {
    if (kSanitized) {
        WARN("skipped: the address sanitizer takes more address space than any limit here");
        return;
    }
    const Sandbox box;
    const auto o = box.vkdose(kRun + " --backend reference --set particles.mass_g=3000 --set canister.height_mm=100000",
                              "ulimit -v 300000; ");
    CAPTURE(o.out, o.err);
    CHECK(o.code == 3);
    CHECK_THAT(o.err, Contains("out of memory") && Contains("(ulimit -v)"));
}
