// [[region]] in a case: what it means, and what is refused.

#include "tests/model/case_files.h"
#include "tests/support/catch.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

const std::string kPan = R"([[region]]
name = "pan"
kind = "beyond"
point = [0, -0.03, 0]
normal = [0, -2, 0]
)";

const std::string kGate = R"([[region]]
name = "gate"
kind = "box"
deletes = false
low = [-0.01, -0.01, 0.0]
high = [0.01, 0.01, 0.004]
)";

}  // namespace

TEST_CASE("regions: one that deletes stands in the place of the outlet, one that counts does not") {
    const Case plain = loadText(kGoodCase), counted = loadText(kGoodCase + kGate),
               both = loadText(kGoodCase + kGate + kPan);
    CHECK(counted.world.outletZ == plain.world.outletZ);
    CHECK_FALSE(counted.world.doses({0, 0, 0.002}));
    CHECK(counted.world.doses({0, 0, 0.0211}));
    REQUIRE(both.world.regions.size() == 2);
    CHECK(std::isinf(both.world.outletZ));
    CHECK(both.world.doses({0, -0.031, 0}));
    CHECK_FALSE(both.world.doses({0, -0.029, 0}));
    CHECK_FALSE(both.world.doses({0, 0, 0.0211}));
    CHECK(both.world.regions[1].normal == Vec3(0, -1, 0));
    CHECK(both.world.regions[0].holds({0, 0, 0.002}));
    CHECK_FALSE(both.world.regions[0].holds({0, 0, 0.0041}));
    CHECK(both.world.regions[0].depth({0, 0, 0.003}) == Approx(0.001));
    const Case again = loadResolvedCase(both.resolved, "again.toml");
    CHECK(again.resolved == both.resolved);
}

TEST_CASE("a region moves with the body that it names") {
    const std::string bodies =
        "[[body]]\nname = \"lid\"\nshape = \"plane\"\nnormal = [0, 0, -1]\nat = [0, 0, 0.5]\n"
        "[[body]]\nname = \"cup\"\nshape = \"plane\"\nnormal = [0, 0, -1]\nat = [0, 0, 0.4]\n";
    const Case c = loadText(kGoodCase + bodies + kGate + "moves_with = \"cup\"\n");
    CHECK(c.world.regions.at(0).body == std::size_t{1});
    const Case again = loadResolvedCase(c.resolved, "again.toml");
    CHECK(again.world.regions.at(0).body == std::size_t{1});
    CHECK_FALSE(loadText(kGoodCase + bodies + kGate).world.regions.at(0).body);
}

TEST_CASE("regions that cannot be are refused by name") {
    const auto refused = [](const std::string& text, const std::string& said) {
        CAPTURE(text);
        try {
            loadText(kGoodCase + text);
            FAIL_CHECK("accepted");
        } catch (const CaseError& e) {
            CHECK_THAT(e.what(), Catch::Contains(said));
        }
    };
    const auto with = [](std::string text, const std::string& from, const std::string& to) {
        return text.replace(text.find(from), from.size(), to);
    };
    refused(kPan + kPan, "stands there twice");
    refused(kGate + "moves_with = \"cup\"\n", "region[0].moves_with = \"cup\": there is no body \"cup\"");
    refused(kGate + "moves_with = 3\n", "moves_with");
    const std::string cup = "[[body]]\nname = \"cup\"\nshape = \"plane\"\nnormal = [0, 0, -1]\nat = [0, 0, 0.4]\n";
    refused(cup + kPan + "moves_with = \"cup\"\n", "stands in a region that deletes, which rests");
    refused(cup + kGate + "moves_with = \"cub\"\n", "did you mean \"cup\"?");
    refused(with(kPan, "\"pan\"", "\"a pan\""), "is no name of a region");
    refused(with(kPan, "-2", "0"), "normal");
    refused(with(kPan, "beyond", "behind"), "kind");
    refused(with(kPan, "point = [0, -0.03, 0]\n", ""), "point");
    refused(with(kGate, "0.004", "-0.004"), "is not beyond low");
    refused(with(kGate, "kind = \"box\"", "kind = \"beyond\""), "point");
    // The loose grid of mini's powder begins at the floor.
    refused(with(kGate, "deletes = false\n", ""), "is in a region that deletes");
    std::string five;
    for (int i = 0; i < 5; ++i) five += with(kPan, "pan", "pan" + std::to_string(i));
    refused(five, "5 of them delete");
}
