// A sweep over the ranks of an MPI job gives the tables of one without. Built with VKDOSE_MPI only.

#include <algorithm>
#include <csignal>
#include <thread>

#include "host/core/csv_table.h"
#include "host/output/checkpoint.h"
#include "tests/app/sandbox.h"
#include "tests/app/sweep_tables.h"
#include "tests/support/catch.h"

using namespace vkdose;
using namespace vkdose::test;
namespace fs = std::filesystem;

namespace {

const std::string kStudy = R"(base = ")" VKDOSE_SOURCE_DIR R"(/cases/mini.toml"
[set]
"stop.max_doses" = 1
settle.time_s = 0.03
dose.rotate_s = 0.08
dose.rest_s = 0.01
[[axis]]
key = "contact.kc_over_k"
values = [0.2, 0.3, 0.4, 0.5, 0.6]
)";

/// As an MPI launcher that may run as root and on fewer cores than ranks.
const std::string kTwoRanks = "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 mpirun --oversubscribe -n 2 ";

}  // namespace

TEST_CASE("two ranks sweep to the same tables as one process, and a refusal ends both") {
    const Sandbox box;
    box.write("study.toml", kStudy);
    REQUIRE(box.vkdose("sweep study.toml --backend reference --out one").code == 0);
    const auto two = box.vkdose("sweep study.toml --backend reference --out two --mpi", kTwoRanks);
    CAPTURE(two.out, two.err);
    CHECK(two.code == 0);
    CHECK_THAT(two.out, Catch::Contains("5 members, 2 at a time"));
    CHECK(timeless(box / "two") == timeless(box / "one"));
    CHECK(readText(box / "two/doses.csv") == readText(box / "one/doses.csv"));

    box.write("study.toml", kStudy + "seeds = 0\n");
    CHECK(box.vkdose("sweep study.toml --backend reference --out three --mpi", kTwoRanks).code == 2);
    CHECK_FALSE(fs::exists(box / "three"));
}
