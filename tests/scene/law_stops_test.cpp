// A law that answers wrongly where the trial did not ask stops the run, and the stop names it.

#include <fmt/format.h>

#include "host/law/user_law.h"
#include "tests/support/gpu.h"

using namespace vkdose;
using namespace vkdose::test;
using Catch::Contains;

namespace {

constexpr double kStiffness = 2000;

/// A floor, and a sphere that comes down on it.
RuledWorld floorUnder(const std::string& law) {
    const LawReading reading = readLaw("odd.glsl", law);
    for (const LawFault& fault : reading.faults) FAIL_CHECK(fault.line << ": " << fault.problem);
    RuledWorld w = emptyWorld();
    w.walls = {geometry::Plane{{0, 0, 0}, {0, 1, 0}}};
    w.timeStep = 1e-5;
    w.law.user = std::make_shared<const UserLaw>(reading.law);
    for (ContactParameters& p : w.law.pairs) {
        p = {};
        p.law = NormalLaw::User;
        p.k1 = p.k2Max = p.kMost = kStiffness;
        p.mu = 0.3;
    }
    return w;
}

std::string law(const std::string& force, const std::string& other = "") {
    return fmt::format("float force(Contact c) {{ return {}; }}\n", force) +
           (other.find("stiffness") == std::string::npos
                ? fmt::format("float stiffness(Contact c) {{ return {:.1f}; }}\n", kStiffness)
                : "") +
           other;
}

/// Lets the sphere fall.
void fall(const RuledWorld& w) {
    Particles p;
    p.add({0, 1.01e-3, 0}, 1e-3, {0, -0.3, 0});
    auto device = gpu();
    device->load(w, p);
    device->advance(400, 0);
    requireClean(*device);
}

const std::string kSpring = "2000.0 * c.overlap";
// As the sphere comes down.
const std::string kFast = "c.speed > 0.2 ? ";

}  // namespace

TEST_CASE("a law that answers as it should lets the sphere bounce") {
    for (const bool book : {false, true}) {
        RuledWorld w = floorUnder(law(kSpring,
                                      "float damping(Contact c) { return 0.01; }\n"
                                      "float pull(Contact c) { return 0.0; }\n"
                                      "float energy(Contact c) { return 1000.0 * c.overlap * c.overlap; }\n"));
        w.energyBook = book;
        CHECK_NOTHROW(fall(w));
    }
}

TEST_CASE("a wrong answer of a law stops the run and is told with the law's name") {
    for (const std::string& other : std::vector<std::string>{
             "float stiffness(Contact c) { return " + kFast + "-5000.0 : 2000.0; }\n",
             "float stiffness(Contact c) { return " + kFast + "0.0 : 2000.0; }\n",
             "float stiffness(Contact c) { return " + kFast + "1.0e7 : 2000.0; }\n",
             "float damping(Contact c) { return " + kFast + "-5.0 : 0.1; }\n",
             "float pull(Contact c) { return " + kFast + "-5.0 : 0.0; }\n",
             "float pull(Contact c) { return " + kFast + "sqrt(-c.overlap) : 0.0; }\n",
             "float pull(Contact c) { return " + kFast + "1.0 / (c.overlap - c.overlap) : 0.0; }\n"}) {
        CAPTURE(other);
        CHECK_THROWS_WITH(fall(floorUnder(law(kSpring, other))), Contains("the law odd.glsl answered"));
    }
}

TEST_CASE("an energy that is no number stops a run that keeps an energy book") {
    RuledWorld w =
        floorUnder(law(kSpring, "float energy(Contact c) { return " + kFast + "sqrt(-c.overlap) : 0.0; }\n"));
    w.energyBook = true;
    CHECK_THROWS_WITH(fall(w), Contains("the law odd.glsl answered"));
}

TEST_CASE("a stop that a law may be to blame for names it") {
    const auto soft = floorUnder(law("0.0"));
    CHECK_THROWS_WITH(fall(soft), Contains("max_overlap_ratio") && Contains("law odd.glsl") && !Contains("stiffer k"));
    RuledWorld flung = floorUnder(law("1.0e6 * c.overlap"));
    flung.domain = {Vec3(-0.01), Vec3(0.01)};
    CHECK_THROWS_WITH(fall(flung), Contains("left the domain") && Contains("law odd.glsl"));
}

TEST_CASE("a law may divide whole numbers by what it likes", "[every-driver]") {
    // -2147483648 and -1, or 0, made from the contact, so that no compiler sees them.
    const std::string numbers =
        "    int one = c.overlap > 0.0 ? 1 : 2, zero = one - 1, least = -2147483647 - one;\n"
        "    ivec2 leasts = ivec2(least, 7), divisors = ivec2(-one, zero);\n"
        "    uint none = uint(zero);\n";
    struct Row {
        std::string sum;  // of GLSL
        std::string is;
    };
    const std::vector<Row> rows{{"least / -one", "least"},
                                {"least % -one", "0"},
                                {"7 * one / zero", "7"},
                                {"7 * one % zero", "0"},
                                {"int(9u / none)", "9"},
                                {"int(9u % none)", "0"},
                                {"(leasts / divisors).x", "least"},
                                {"(leasts / divisors).y", "7"},
                                {"(leasts % divisors).y", "0"},
                                {"-7 * one / 2", "-3"},
                                {"(least + one) / -one", "2147483647"}};
    for (const Row& row : rows) {
        CAPTURE(row.sum);
        const RuledWorld w = floorUnder("float force(Contact c) {\n" + numbers + "    return " + row.sum +
                                        " == " + row.is + " ? 2000.0 * c.overlap : sqrt(-1.0 - c.overlap);\n}\n" +
                                        "float stiffness(Contact c) { return 2000.0; }\n");
        CHECK_NOTHROW(fall(w));
    }
    const RuledWorld assigned = floorUnder(
        "float force(Contact c) {\n" + numbers +
        "    least /= -one;\n    one %= zero;\n    return float(one) + 2000.0 * c.overlap + 0.0 * float(least);\n}\n"
        "float stiffness(Contact c) { return 2000.0; }\n");
    CHECK_NOTHROW(fall(assigned));
}
