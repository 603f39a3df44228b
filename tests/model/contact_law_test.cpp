// contact.law in a case: the keys of each law, and what becomes of them.
#include <cmath>

#include "host/core/error.h"
#include "host/model/normal_law.h"
#include "tests/model/case_files.h"
#include "tests/support/catch.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

/// kGoodCase with other contacts.
std::string withContacts(const std::string& contacts) {
    const std::size_t from = kGoodCase.find("[contact]"), to = kGoodCase.find("[canister]");
    return kGoodCase.substr(0, from) + contacts + kGoodCase.substr(to);
}

const std::string kElastic = R"([contact]
law = "hertz-mindlin"
youngs_modulus = 5e6
poisson_ratio = 0.25
restitution = 0.6
friction = 0.5
rolling_friction = 0.2
[contact.wall]
youngs_modulus = 2e8
friction = 0.2
[contact.coil]
restitution = 0.4
)";

Case loadText(const std::string& text) {
    const Folder folder;
    return loadCase(folder.write("case.toml", text));
}

void refused(const std::string& text, const std::string& said) {
    CAPTURE(text, said);
    CHECK_THROWS_WITH(loadText(text), Catch::Contains(said));
}

}  // namespace

TEST_CASE("a case with the law of Hertz and Mindlin") {
    const Case c = loadText(withContacts(kElastic));
    const Elasticity powder{5e6, 0.25}, wall{2e8, 0.25};
    const ContactParameters pair = hertzMindlin(powder, powder, 0.6), atWall = hertzMindlin(powder, wall, 0.6);
    const auto& classes = c.dosingLaw.classes;
    for (const ContactParameters& p : classes) CHECK(p.law == NormalLaw::HertzMindlin);
    CHECK(classes[0].modulus == pair.modulus);
    CHECK(classes[0].kt == pair.kt);
    CHECK(classes[0].dampingShare == pair.dampingShare);
    CHECK(classes[0].mu == 0.5);
    CHECK(classes[0].kr == Approx(2.0 / 7).epsilon(1e-2));
    CHECK(classes[1].modulus == atWall.modulus);
    CHECK(classes[1].mu == 0.2);
    CHECK(classes[1].muR == 0.2);
    CHECK(classes[2].modulus == atWall.modulus);  // the coil takes the wall's material
    CHECK(classes[2].dampingShare == hertzMindlin(powder, wall, 0.4).dampingShare);
    CHECK(classes[2].mu == 0.2);
    CHECK(c.settlingLaw.classes[0].dampingShare == pair.dampingShare);
    const Case again = loadResolvedCase(c.resolved, "again.toml");
    CHECK(again.resolved == c.resolved);
    CHECK(again.dosingLaw.classes[2].modulus == classes[2].modulus);
}

TEST_CASE("settling with the law of Hertz and Mindlin may be damped more") {
    const Case c = loadText(replaced(withContacts(kElastic), "[settle]\n", "[settle]\ndamping_factor = 2\n"));
    CHECK(c.settlingLaw.classes[1].dampingShare == 2 * c.dosingLaw.classes[1].dampingShare);
}

TEST_CASE("the time step of an elastic case grows as the largest overlap that it allows falls") {
    const double usual = loadText(withContacts(kElastic)).world.timeStep;
    const std::string shallow =
        replaced(kElastic, "restitution = 0.6\n", "restitution = 0.6\nmax_overlap_ratio = 0.0125\n");
    CHECK(loadText(withContacts(shallow)).world.timeStep == Approx(2 * usual).epsilon(0.02));
}

TEST_CASE("a case that chooses another law than its base leaves the contacts of the base behind") {
    const Folder folder;
    folder.write("luding.toml", kGoodCase);
    folder.write("elastic.toml", withContacts(kElastic));
    const Case c = loadCase(folder.write("over.toml", "base = \"luding.toml\"\n" + kElastic));
    CHECK(c.dosingLaw.classes[1].modulus == loadText(withContacts(kElastic)).dosingLaw.classes[1].modulus);
    const std::string contacts = kGoodCase.substr(kGoodCase.find("[contact]"));
    const std::string plain =
        replaced(contacts.substr(0, contacts.find("[canister]")), "[contact]\n", "[contact]\nlaw = \"luding\"\n");
    const Case back = loadCase(folder.write("back.toml", "base = \"elastic.toml\"\n" + plain));
    CHECK(back.dosingLaw.classes[0].k2Max == 2000);
    CHECK_THROWS_WITH(loadCase(folder / "luding.toml", {"contact.law=hertz-mindlin"}),
                      Catch::Contains("contact.youngs_modulus: is missing") && Catch::Contains("contact.friction"));
}

TEST_CASE("keys of another law, and figures of no material, are refused by name") {
    const auto with = [](const std::string& line) {
        return withContacts(replaced(kElastic, "restitution = 0.6\n", "restitution = 0.6\n" + line + "\n"));
    };
    refused(with("k = 2000"),
            "contact.k = 2000: is a key of the law luding; remove it, or give contact.law = \"luding\"");
    refused(with("soften = 2"), "contact.soften");
    refused(with("damping = 0.1"), "contact.damping");
    refused(replaced(with(""), "[settle]\n", "[settle]\nkc_over_k = 0.3\n"),
            "settle.kc_over_k = 0.3: is a key of the law luding");
    refused(replaced(with(""), "[settle]\n", "[settle]\nelastic = true\n"),
            "settle.elastic = true: is a key of the law luding");
    refused(replaced(kGoodCase, "[settle]\n", "[settle]\nelastic = 1\n"), "settle.elastic");
    refused(replaced(kGoodCase, "k = 2000.0\n", "k = 2000.0\nyoungs_modulus = 1e6\n"),
            "contact.youngs_modulus = 1e6: is a key of the law hertz-mindlin");
    refused(withContacts(replaced(kElastic, "youngs_modulus = 5e6\n", "")), "contact.youngs_modulus");
    refused(withContacts(replaced(kElastic, "restitution = 0.6\n", "")), "contact.restitution");
    refused(withContacts(replaced(kElastic, "0.25", "0.6")),
            "contact.poisson_ratio = 0.6: is that of no solid; give 0 to 0.5");
    refused(withContacts(replaced(kElastic, "= 0.6", "= 1.2")), "contact.restitution = 1.2");
    refused(withContacts(replaced(kElastic, "hertz-mindlin", "hertz")), "contact.law");
    refused(replaced(kGoodCase, "k1_over_k = 0.2\n", ""), "contact.k1_over_k");
}
