// What machine figures belong to.
#include "host/bench/machine.h"

#include "tests/support/catch.h"

using namespace vkdose::bench;

TEST_CASE("machine: processor and its widest vectors, of x86 and ARM, and as much as is told") {
    const std::string xeon =
        "processor\t: 0\nmodel name\t: Intel(R) Xeon(R) Processor\nflags\t\t: fpu sse4_2 avx avx2 avx512f\n\n"
        "processor\t: 1\nmodel name\t: another\n";
    CHECK(processorIn(xeon) == "Intel(R) Xeon(R) Processor, AVX-512");
    CHECK(processorIn("model name\t: AMD EPYC\nflags\t\t: sse4_2 avx avx2 avx512fp16\n") == "AMD EPYC, AVX2");
    CHECK(processorIn("processor\t: 0\nFeatures\t: fp asimd sve\n") == "SVE");
    CHECK(processorIn("model name\t: a processor\n") == "a processor");
    CHECK(processorIn("").empty());
}
