// contact.law in a case: the keys of each law, and what becomes of them.
#include <cmath>

#include "host/core/error.h"
#include "host/law/hertz.h"
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

const std::string kCohesive = R"([contact]
law = "eepa"
youngs_modulus = 5e6
poisson_ratio = 0.25
restitution = 0.6
plasticity_ratio = 0.5
surface_energy = 0.2
pull_off_force = 1e-6
friction = 0.5
rolling_friction = 0.2
[contact.wall]
youngs_modulus = 2e8
surface_energy = 0.05
friction = 0.2
[contact.coil]
plasticity_ratio = 0.3
adhesion_exponent = 3
pull_off_force = 0
)";

void refused(const std::string& text, const std::string& said) {
    CAPTURE(text, said);
    CHECK_THROWS_WITH(loadText(text), Catch::Contains(said));
}

}  // namespace

TEST_CASE("a case with the law of Hertz and Mindlin") {
    const Case c = loadText(withContacts(kElastic));
    const Elasticity powder{5e6, 0.25}, wall{2e8, 0.25};
    const ContactParameters pair = hertzMindlin(powder, powder, 0.6), atWall = hertzMindlin(powder, wall, 0.6);
    const auto classes = classesOf(c.dosingLaw);
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
    CHECK(c.settlingLaw.between(0, 0).dampingShare == pair.dampingShare);
    const Case again = loadResolvedCase(c.resolved, "again.toml");
    CHECK(again.resolved == c.resolved);
    CHECK(again.dosingLaw.between(0, 2).modulus == classes[2].modulus);
}

TEST_CASE("settling with the law of Hertz and Mindlin may be damped more") {
    const Case c = loadText(replaced(withContacts(kElastic), "[settle]\n", "[settle]\ndamping_factor = 2\n"));
    CHECK(c.settlingLaw.between(0, 1).dampingShare == 2 * c.dosingLaw.between(0, 1).dampingShare);
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
    CHECK(c.dosingLaw.between(0, 1).modulus == loadText(withContacts(kElastic)).dosingLaw.between(0, 1).modulus);
    const std::string contacts = kGoodCase.substr(kGoodCase.find("[contact]"));
    const std::string plain =
        replaced(contacts.substr(0, contacts.find("[canister]")), "[contact]\n", "[contact]\nlaw = \"luding\"\n");
    const Case back = loadCase(folder.write("back.toml", "base = \"elastic.toml\"\n" + plain));
    CHECK(back.dosingLaw.between(0, 0).k2Max == 2000);
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

TEST_CASE("a case with the elasto-plastic adhesive law") {
    const Case c = loadText(withContacts(kCohesive));
    const auto classes = classesOf(c.dosingLaw);
    const ContactParameters elastic = hertzMindlin({5e6, 0.25}, {2e8, 0.25}, 0.6);
    for (const ContactParameters& p : classes) CHECK(p.law == NormalLaw::Eepa);
    CHECK(classes[0].modulus == hertzMindlin({5e6, 0.25}, {5e6, 0.25}, 0.6).modulus);
    CHECK(classes[1].modulus == elastic.modulus);
    CHECK(classes[1].kt == elastic.kt);
    CHECK(classes[2].dampingShare == elastic.dampingShare);
    CHECK(classes[0].plasticityRatio == 0.5);
    CHECK(classes[0].surfaceEnergy == 0.2);
    CHECK(classes[0].constantPull == 1e-6);
    CHECK(classes[0].adhesionExponent == 1.5);
    CHECK(classes[1].plasticityRatio == 0.5);
    CHECK(classes[1].surfaceEnergy == 0.05);
    CHECK(classes[1].constantPull == 1e-6);
    CHECK(classes[2].plasticityRatio == 0.3);  // the coil takes the rest from the wall
    CHECK(classes[2].surfaceEnergy == 0.05);
    CHECK(classes[2].constantPull == 0);
    CHECK(classes[2].adhesionExponent == 3);
    CHECK(classes[2].mu == 0.2);
    CHECK(c.settlingLaw.between(0, 1).surfaceEnergy == 0.05);
    const Case again = loadResolvedCase(c.resolved, "again.toml");
    CHECK(again.resolved == c.resolved);
    CHECK(again.dosingLaw.between(0, 2).plasticityRatio == 0.3);
    CHECK(again.dosingLaw.between(0, 1).constantPull == 1e-6);
    const Case damped = loadText(replaced(withContacts(kCohesive), "[settle]\n", "[settle]\ndamping_factor = 2\n"));
    CHECK(damped.settlingLaw.between(0, 1).dampingShare == 2 * damped.dosingLaw.between(0, 1).dampingShare);
}

TEST_CASE("the time step of an elasto-plastic case is shorter by the root of how much stiffer unloading is") {
    // Without friction, whose springs are faster.
    const std::string rough =
        replaced(withContacts(kCohesive), "friction = 0.5\nrolling_friction = 0.2", "friction = 0");
    const std::string smooth =
        replaced(replaced(rough, "friction = 0.2", "friction = 0"), "plasticity_ratio = 0.3\n", "");
    const std::string elastic = replaced(
        replaced(smooth, "plasticity_ratio = 0.5\nsurface_energy = 0.2", "plasticity_ratio = 0\nsurface_energy = 0"),
        "surface_energy = 0.05\n", "");
    const std::string plastic = replaced(elastic, "plasticity_ratio = 0\n", "plasticity_ratio = 0.96\n");
    CHECK(loadText(elastic).world.timeStep == Approx(5 * loadText(plastic).world.timeStep).epsilon(0.02));
}

TEST_CASE("keys and figures that the elasto-plastic adhesive law cannot have are refused by name") {
    const auto with = [](const std::string& line) {
        return withContacts(replaced(kCohesive, "restitution = 0.6\n", "restitution = 0.6\n" + line + "\n"));
    };
    const auto other = [](const std::string& old, const std::string& now) {
        return withContacts(replaced(kCohesive, old, now));
    };
    refused(with("kc_over_k = 0.5"),
            "contact.kc_over_k = 0.5: is a key of the law luding; remove it, or give contact.law = \"luding\"");
    refused(with("soften = 2"), "contact.soften");
    refused(replaced(with(""), "[settle]\n", "[settle]\nkc_over_k = 0.3\n"),
            "settle.kc_over_k = 0.3: is a key of the law luding");
    refused(withContacts(replaced(kElastic, "restitution = 0.6\n", "restitution = 0.6\nplasticity_ratio = 0.5\n")),
            "contact.plasticity_ratio = 0.5: is a key of the law eepa; remove it, or give contact.law = \"eepa\"");
    refused(replaced(kGoodCase, "k = 2000.0\n", "k = 2000.0\nsurface_energy = 0.1\n"),
            "contact.surface_energy = 0.1: is a key of the law jkr");
    refused(other("plasticity_ratio = 0.5\n", ""), "contact.plasticity_ratio: is missing");
    refused(other("surface_energy = 0.2\n", ""), "contact.surface_energy: is missing");
    refused(other("plasticity_ratio = 0.5", "plasticity_ratio = 1"),
            "contact.plasticity_ratio = 1: lets nothing of the overlap spring back; give a number >= 0 and < 1");
    refused(other("adhesion_exponent = 3", "adhesion_exponent = 0.5"), "contact.coil.adhesion_exponent = 0.5");
    refused(other("adhesion_exponent = 3", "adhesion_exponent = 11"),
            "contact.coil.adhesion_exponent = 11: lets the force from which friction is counted grow");
    refused(other("pull_off_force = 1e-6", "pull_off_force = -1e-6"), "contact.pull_off_force = -1e-6");
    refused(other("plasticity_ratio = 0.5", "plasticity_ratio = 0"),
            "contact.surface_energy = 0.2: acts on flattened contacts, and with plasticity_ratio = 0 none is; "
            "give a plasticity_ratio > 0, or a surface energy of 0");
    refused(other("plasticity_ratio = 0.3", "plasticity_ratio = 0"),
            "contact.coil.plasticity_ratio = 0: flattens no contact, and its surface_energy = 0.05 acts on flattened "
            "ones alone");
    refused(other("0.25", "0.6"), "contact.poisson_ratio = 0.6");
}

TEST_CASE("a case with elastic adhesive spheres") {
    const std::string sticky = R"([contact]
law = "jkr"
youngs_modulus = 5e6
poisson_ratio = 0.25
restitution = 0.6
surface_energy = 0.2
friction = 0.5
[contact.wall]
youngs_modulus = 2e8
surface_energy = 0
)";
    const Case c = loadText(withContacts(sticky));
    const auto classes = classesOf(c.dosingLaw);
    for (const ContactParameters& p : classes) CHECK(p.law == NormalLaw::Jkr);
    CHECK(classes[0].surfaceEnergy == 0.2);
    CHECK(classes[1].surfaceEnergy == 0);
    CHECK(classes[2].surfaceEnergy == 0);  // from the wall
    CHECK(classes[1].modulus == hertzMindlin({5e6, 0.25}, {2e8, 0.25}, 0.6).modulus);
    CHECK(classes[0].kt == hertzMindlin({5e6, 0.25}, {5e6, 0.25}, 0.6).kt);
    const Case again = loadResolvedCase(c.resolved, "again.toml");
    CHECK(again.resolved == c.resolved);
    CHECK(again.dosingLaw.between(0, 0).surfaceEnergy == 0.2);
    refused(withContacts(replaced(sticky, "surface_energy = 0.2\n", "")), "contact.surface_energy: is missing");
    refused(withContacts(replaced(sticky, "restitution = 0.6\n", "restitution = 0.6\nplasticity_ratio = 0.5\n")),
            "contact.plasticity_ratio = 0.5: is a key of the law eepa");
    refused(withContacts(replaced(sticky, "restitution = 0.6\n", "restitution = 0.6\nk = 100\n")),
            "contact.k = 100: is a key of the law luding");
    refused(withContacts(replaced(kElastic, "restitution = 0.6\n", "restitution = 0.6\nsurface_energy = 0.5\n")),
            "contact.surface_energy = 0.5: is a key of the law jkr; remove it, or give contact.law = \"jkr\"");
}
