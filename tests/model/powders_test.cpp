// Several powders and materials in a case file: pairs of materials, what stands for a pair that is not given, faults,
// and where the particles start.
#include <algorithm>
#include <cmath>
#include <set>

#include "host/core/error.h"
#include "host/law/law.h"
#include "host/model/case.h"
#include "host/model/overlaps.h"
#include "host/model/powders.h"
#include "host/model/stability.h"
#include "tests/model/case_files.h"
#include "tests/support/catch.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

constexpr int kSecond = 3;  // the second powder's material, behind those of walls and coil

std::string refusal(const std::string& text) {
    try {
        loadText(text);
    } catch (const CaseError& error) {
        return error.what();
    }
    return "accepted";
}

const std::string kMixture = kGoodCase + kSugar;
/// What sugar has with itself; all else it takes from [contact].
const std::string kSugarPair = "[contact.sugar-sugar]\nk = 1000.0\ndamping = 0.01\nfriction = 0.3\nkc_over_k = 0.2\n";
const std::string kElastic = replaced(
    replaced(kGoodCase, "k = 2000.0\nk1_over_k = 0.2\nkc_over_k = 0.5\nplasticity_depth = 0.05\ndamping = 0.02\n",
             "law = \"hertz-mindlin\"\nyoungs_modulus = 1e7\npoisson_ratio = 0.3\nrestitution = 0.8\n"),
    "[contact.wall]\n", "[contact.wall]\nyoungs_modulus = 5e7\n");
const std::string kSugarMaterial = "[[material]]\nname = \"sugar\"\nyoungs_modulus = 2e7\npoisson_ratio = 0.2\n";

bool tells(const Case& c, const std::string& what) {
    return std::any_of(c.derivations.begin(), c.derivations.end(),
                       [&](const std::string& line) { return line.find(what) != std::string::npos; });
}

}  // namespace

TEST_CASE("a pair of powders that is not given has the means of the two, and says so") {
    const Case c = loadText(kMixture + kSugarPair);
    const ContactParameters& p = c.dosingLaw.between(0, kSecond);
    CHECK(p.k2Max == Approx(4000.0 / 3).epsilon(1e-12));                  // 2 * 2000 * 1000/3000
    CHECK(p.gamma == Approx(0.04 / 3).epsilon(1e-12));                    // 2 * 0.02 * 0.01/0.03
    CHECK(p.mu == Approx(0.3872983346207417).epsilon(1e-12));             // sqrt(0.5 * 0.3)
    CHECK(p.kc / p.k2Max == Approx(0.31622776601683794).epsilon(1e-12));  // sqrt(0.5 * 0.2)
    CHECK(p.k1 / p.k2Max == Approx(0.2).epsilon(1e-15));                  // both have it
    CHECK(p.muR == 0.2);
    CHECK(tells(c,
                "contact.powder-sugar: k = 1333.33, damping = 0.0133333: harmonic means of powder-powder and "
                "sugar-sugar"));
    CHECK(tells(c, "friction = 0.387298"));
    CHECK(tells(c, "geometric means of powder-powder and sugar-sugar"));
    // What the second powder does not state of itself it has from the first, and at the walls from what that has there.
    CHECK(c.dosingLaw.between(3, 3).k1 == Approx(200));
    CHECK(c.dosingLaw.between(3, 3).muR == 0.2);
    CHECK(c.dosingLaw.between(3, kWallMaterial).mu == 0.2);
    CHECK(c.dosingLaw.between(3, kWallMaterial).k2Max == 2000);
    CHECK(tells(c, "contact.sugar-wall: as contact.wall"));
    // The law does not mind the order.
    CHECK(c.dosingLaw.between(kSecond, 0).k2Max == p.k2Max);
    const Case again = loadResolvedCase(c.resolved, "again.toml");
    CHECK(again.resolved == c.resolved);
    CHECK(again.dosingLaw.between(0, 3).mu == p.mu);
    CHECK(again.derivations == c.derivations);
}

TEST_CASE("a pair that is given has its own values, in either order of its names") {
    for (const char* name : {"sugar-powder", "powder-sugar"}) {
        const Case c = loadText(kMixture + kSugarPair + "[contact." + name + "]\nfriction = 0.7\nk = 1500.0\n");
        const ContactParameters& p = c.dosingLaw.between(0, 3);
        CHECK(p.mu == 0.7);
        CHECK(p.k2Max == 1500);
        CHECK(p.gamma == Approx(0.04 / 3));  // the rest is mixed
        CHECK_FALSE(tells(c, "friction = 0.7"));
        CHECK(tells(c, "damping = 0.0133333"));
        CHECK(loadResolvedCase(c.resolved, "again.toml").resolved == c.resolved);
    }
}

TEST_CASE("equal powders have their own values with each other, to the bit") {
    const Case c = loadText(kMixture);
    CHECK(c.dosingLaw.between(0, 3).k2Max == c.dosingLaw.between(0, 0).k2Max);
    CHECK(c.dosingLaw.between(0, 3).gamma == c.dosingLaw.between(0, 0).gamma);
    CHECK(c.dosingLaw.between(0, 3).mu == c.dosingLaw.between(0, 0).mu);
    CHECK(c.dosingLaw.between(0, 3).plasticityDepth == c.dosingLaw.between(0, 0).plasticityDepth);
}

TEST_CASE("a powder without plasticity leaves the depth to the other") {
    const Case c = loadText(kMixture + "[contact.sugar-sugar]\nk1_over_k = 1.0\nplasticity_depth = 0.0\n");
    CHECK(c.dosingLaw.between(0, 3).plasticityDepth == 0.05);
    CHECK(c.dosingLaw.between(0, 3).k1 / c.dosingLaw.between(0, 3).k2Max == Approx(std::sqrt(0.2)));
}

TEST_CASE("without plasticity there is no adhesion, with itself or with another powder") {
    const Case c = loadText(replaced(kMixture, "[contact.wall]\n", "[contact.wall]\nk1_over_k = 1.0\n") +
                            "[contact.sugar-sugar]\nk1_over_k = 1.0\n");
    CHECK(c.dosingLaw.between(0, 0).kc > 0);
    CHECK(c.settlingLaw.between(0, 0).kc > 0);
    for (const ContactLaw& law : {c.dosingLaw, c.settlingLaw}) {
        CHECK(law.between(3, 3).kc == 0);
        CHECK(law.between(0, kWallMaterial).kc == 0);
    }
    CHECK(c.dosingLaw.between(0, 3).kc == 0);
}

TEST_CASE("two restitutions make one, with the damping that the pair needs") {
    const std::string text = replaced(kGoodCase, "damping = 0.02", "restitution = 0.5") + kSugar;
    const Case c = loadText(text + "[contact.sugar-sugar]\nrestitution = 0.3\n");
    const PowderSizes sizes = powderSizes(c);
    const double mass = reducedMass(1427, sizes[0].mean, 1590, 1e-3);
    CHECK(restitution(c.dosingLaw.between(0, 3), mass) == Approx(std::sqrt(0.15)).epsilon(1e-9));
    CHECK(restitution(c.dosingLaw.between(3, 3), reducedMass(1590, 1e-3, 1e-3)) == Approx(0.3).epsilon(1e-9));
}

TEST_CASE("moduli of two materials make the exact modulus of their contact, restitution and friction are mixed") {
    const Case c = loadText(kElastic + kSugar + kSugarMaterial +
                            "[contact.sugar-sugar]\nrestitution = 0.5\nfriction = 0.32\n"
                            "[contact.sugar-wall]\nfriction = 0.1\n");
    const ContactParameters& p = c.dosingLaw.between(0, 3);
    CHECK(p.modulus == Approx(7194244.604316547).epsilon(1e-12));  // 1/(0.91/1e7 + 0.96/2e7)
    // 4 G*/E* with 1/G* = 2 (1 + 0.3) (2 - 0.3)/1e7 + 2 (1 + 0.2) (2 - 0.2)/2e7.
    CHECK(p.kt == Approx(4 / (4.42e-7 + 2.16e-7) / 7194244.604316547).epsilon(1e-12));
    CHECK(p.mu == Approx(0.4).epsilon(1e-12));  // sqrt(0.5 * 0.32)
    CHECK(restitution(p, 1e-6) == Approx(std::sqrt(0.4)).epsilon(1e-9));
    CHECK(c.dosingLaw.between(3, 3).modulus == Approx(2e7 / 0.96 / 2));
    // At the wall: 1/(0.96/2e7 + 0.91/5e7); the wall has the Poisson's ratio of the first powder.
    CHECK(c.dosingLaw.between(3, 1).modulus == Approx(15105740.181268882).epsilon(1e-12));
    CHECK(c.dosingLaw.between(3, 1).mu == 0.1);
    CHECK(restitution(c.dosingLaw.between(3, 1), 1e-6) == Approx(0.8).epsilon(1e-9));
    CHECK(tells(c,
                "contact.powder-sugar: E* = 7.19424e+06 Pa from the moduli of the two; restitution = 0.632456, "
                "friction = 0.4"));
    const Case again = loadResolvedCase(c.resolved, "again.toml");
    CHECK(again.resolved == c.resolved);
    CHECK(again.dosingLaw.between(0, 3).dampingShare == p.dampingShare);
}

TEST_CASE("EEPA and JKR mix their adhesion by geometric means") {
    std::string jkr = replaced(kElastic, "law = \"hertz-mindlin\"\n", "law = \"jkr\"\nsurface_energy = 0.04\n");
    const Case c = loadText(jkr + kSugar + kSugarMaterial + "[contact.sugar-sugar]\nsurface_energy = 0.01\n");
    CHECK(c.dosingLaw.between(0, 3).surfaceEnergy == Approx(0.02).epsilon(1e-12));
    CHECK(c.dosingLaw.between(0, 3).law == NormalLaw::Jkr);
    std::string eepa = replaced(kElastic, "law = \"hertz-mindlin\"\n",
                                "law = \"eepa\"\nsurface_energy = 0.04\nplasticity_ratio = 0.4\n");
    const Case e = loadText(eepa + kSugar + kSugarMaterial + "[contact.sugar-sugar]\nplasticity_ratio = 0.9\n");
    CHECK(e.dosingLaw.between(0, 3).plasticityRatio == Approx(0.6).epsilon(1e-12));
    CHECK(e.dosingLaw.between(0, 3).surfaceEnergy == 0.04);
}

TEST_CASE("bodies and walls have materials of their own") {
    const Case c = loadText(kMixture +
                                "[[material]]\nname = \"steel\"\n"
                                "[[body]]\nname = \"rod\"\nshape = \"ball\"\nradius_mm = 1\nat = [0, 0.05, 0.01]\n"
                                "material = \"steel\"\n"
                                "[contact.powder-steel]\nfriction = 0.9\n",
                            {"canister.material=steel"});
    const int steel = 4;
    REQUIRE(c.world.materials.size() == 5);
    CHECK(c.world.bodies[0].material == steel);
    for (const Wall& wall : c.world.walls) CHECK(wall.material == steel);
    CHECK(c.dosingLaw.between(0, steel).mu == 0.9);
    CHECK(c.dosingLaw.between(3, steel).mu == 0.9);   // the second powder has what the first has there
    CHECK(c.dosingLaw.between(0, steel).muR == 0.2);  // and that takes the rest from the walls
    CHECK(loadResolvedCase(c.resolved, "again.toml").resolved == c.resolved);
}

TEST_CASE("softening and settling hold for all pairs") {
    const Case plain = loadText(kMixture + kSugarPair);
    const Case soft = loadText(kMixture + kSugarPair, {"contact.soften=4", "settle.kc_over_k=0.1"});
    for (const MaterialPair pair : {MaterialPair{0, 0}, {0, 3}, {3, 3}, {3, 1}, {0, 2}}) {
        CHECK(soft.dosingLaw.of(pair).k2Max == Approx(plain.dosingLaw.of(pair).k2Max / 4).epsilon(1e-12));
        CHECK(soft.dosingLaw.of(pair).gamma == Approx(plain.dosingLaw.of(pair).gamma / 2).epsilon(1e-12));
        CHECK(soft.settlingLaw.of(pair).kc / soft.settlingLaw.of(pair).k2Max == Approx(0.1).epsilon(1e-12));
        // Without a word of settling every pair keeps its own.
        CHECK(plain.settlingLaw.of(pair).kc == plain.dosingLaw.of(pair).kc);
    }
    CHECK(loadResolvedCase(soft.resolved, "again.toml").resolved == soft.resolved);
    CHECK(loadResolvedCase(plain.resolved, "again.toml").resolved == plain.resolved);
    const Case own = loadText(kMixture + "[contact.powder-sugar]\nsettling_kc_over_k = 0.05\n");
    CHECK(own.settlingLaw.between(0, 3).kc / own.settlingLaw.between(0, 3).k2Max == Approx(0.05));
}

TEST_CASE("where the walls state their adhesion, all that takes it from them keeps it while settling") {
    const std::string steel =
        "[[material]]\nname = \"steel\"\n"
        "[[body]]\nname = \"rod\"\nshape = \"ball\"\nradius_mm = 1\nat = [0, 0.05, 0.01]\nmaterial = \"steel\"\n";
    const std::vector<std::string> settling{"contact.wall.kc_over_k=0", "settle.kc_over_k=0.3"};
    const Case c = loadText(kMixture + steel, settling);
    for (const MaterialPair pair : occurringPairs(c.world)) {
        CAPTURE(pair.a, pair.b);
        const bool powders = c.world.materials[std::size_t(pair.b)].powder;
        CHECK(c.settlingLaw.of(pair).kc / c.settlingLaw.of(pair).k2Max == Approx(powders ? 0.3 : 0.0));
    }
    const Case own = loadText(kMixture + steel + "[contact.sugar-steel]\nkc_over_k = 0.1\n", settling);
    CHECK(own.settlingLaw.between(kSecond, 4).kc / own.settlingLaw.between(kSecond, 4).k2Max == Approx(0.1));
    // Without a word of the walls they settle with the powder's adhesion, whatever they are made of.
    const Case plain = loadText(kMixture + steel, {"settle.kc_over_k=0.3"});
    CHECK(plain.settlingLaw.between(kSecond, 4).kc / plain.settlingLaw.between(kSecond, 4).k2Max == Approx(0.3));
}

TEST_CASE("faults of powders, materials and pairs name the culprit and the remedy") {
    const auto refused = [](const std::string& text, const std::string& what) {
        INFO(text);
        CHECK_THAT(refusal(text), Catch::Contains(what));
    };
    refused(kMixture + "[contact.powder-suger]\nfriction = 0.1\n", "did you mean \"sugar\"?");
    refused(kMixture + "[contact.powder-lactose]\nfriction = 0.1\n", "known: powder, wall, coil, sugar");
    refused(kMixture + "[contact.wall-coil]\nfriction = 0.1\n", "have no contact");
    refused(kMixture + "[contact.powder-powder]\nfriction = 0.1\n", "write [contact]");
    refused(kMixture + "[contact.wall-powder]\nfriction = 0.1\n", "write [contact.wall]");
    refused(kMixture + "[contact.sugar-powder]\nfriction = 0.1\n[contact.powder-sugar]\nfriction = 0.1\n",
            "join the two tables");
    refused(kMixture + "[contact.powder-sugar]\nfrictoin = 0.1\n", "did you mean friction?");
    refused(kMixture + "[contact.powder-sugar]\nyoungs_modulus = 1e7\n", "hertz-mindlin");
    refused(replaced(kMixture, "name = \"sugar\"", "name = \"fine-sugar\""), "hyphen");
    refused(kMixture + kSugar, "is the name of another powder already");
    refused(replaced(kMixture, "name = \"sugar\"", "name = \"wall\""), "there is a material \"wall\" already");
    refused(replaced(kMixture, "name = \"sugar\"", "name = \"powder\""), "another powder already");
    refused(replaced(kMixture, "density = 1590.0\n", ""), "powder[0].density: is missing");
    refused(kMixture + "[[material]]\nname = \"sugar\"\ndensity = 1.0\n", "states its density too");
    refused(kMixture + "[[material]]\nname = \"powder\"\n", "first powder");
    refused(
        kMixture + "[[body]]\nname = \"b\"\nshape = \"plane\"\nmaterial = \"stel\"\n[[material]]\nname = \"steel\"\n",
        "did you mean \"steel\"?");
    refused(kMixture + "[[body]]\nname = \"b\"\nshape = \"plane\"\nmaterial = \"sugar\"\n", "material of a powder");
    refused(kMixture + "[[body]]\nname = \"b\"\nshape = \"plane\"\nmaterial = \"coil\"\ncontact = \"wall\"\n",
            "give one of the two");
    refused(kMixture + "[[refill]]\nname = \"r\"\nmass_g = 0.1\ntime_s = 0.2\npowder = \"suggar\"\n",
            "did you mean \"sugar\"?");
    refused(kElastic + kSugar, "whose moduli are not known");
    refused(kElastic + kSugar + kSugarMaterial + "[contact.powder-sugar]\nyoungs_modulus = 1e7\n", "[[material]]");
    refused(kMixture + kSugarMaterial, "is a key of the law hertz-mindlin");
    refused(replaced(kGoodCase, "mass_g = 0.9", "mass_g = 0.9\nmixed = true"), "there is only one powder");
    std::string many = kMixture;
    for (const char* name : {"a", "b", "c", "d", "e"}) many += std::string("[[material]]\nname = \"") + name + "\"\n";
    refused(many, "give at most 8");
    refused(replaced(kMixture, "radius_mm = 1.0", "radius_mm = 8.0"), "powder[0].size.radius_mm");
    refused(replaced(kMixture, "mass_g = 0.4", "mass_g = 400.0"), "powder[0].mass_g = 400.0: the fill does not fit");
}

TEST_CASE("each powder has its mass, and the first starts as it would alone") {
    const Insertion alone = insertParticles(loadText(kGoodCase));
    const Case c = loadText(kMixture);
    const Insertion filled = insertParticles(c);
    REQUIRE(filled.powders.size() == 2);
    const std::size_t first = alone.particles.size();
    CHECK(filled.powders[0].particles == first);
    CHECK(filled.powders[0].mass == alone.mass);
    const double sphere = sphereMass(1590, 1e-3);
    CHECK(filled.powders[1].particles == static_cast<std::size_t>(std::llround(0.4e-3 / sphere)));
    CHECK(filled.powders[1].mass == Approx(static_cast<double>(filled.powders[1].particles) * sphere));
    CHECK(filled.mass == filled.powders[0].mass + filled.powders[1].mass);
    CHECK(filled.targetMass == Approx(1.3e-3));
    double top = 0;
    for (std::size_t i = 0; i < filled.particles.size(); ++i) {
        const bool ofFirst = i < first;
        REQUIRE(int(filled.particles.material[i]) == (ofFirst ? 0 : 3));
        if (ofFirst) {
            REQUIRE(filled.particles.position[i] == alone.particles.position[i]);
            REQUIRE(filled.particles.radius[i] == alone.particles.radius[i]);
            top = std::max(top, filled.particles.position[i].y + filled.particles.radius[i]);
        } else {
            REQUIRE(filled.particles.position[i].y - 1e-3 > top);  // on the grid of the first
        }
    }
    CHECK(filled.fillHeight > alone.fillHeight);
}

TEST_CASE("mixed powders start at random places of one grid, the same for the same seed") {
    const std::string text = replaced(kMixture, "mass_g = 0.9", "mass_g = 0.9\nmixed = true");
    const Case c = loadText(text);
    const Insertion apart = insertParticles(loadText(kMixture)), mixed = insertParticles(c);
    CHECK(mixed.particles.radius == apart.particles.radius);
    CHECK(mixed.particles.material == apart.particles.material);
    std::size_t overlaps = 0;
    forEachOverlap(mixed.particles, [&](std::size_t, std::size_t, double) { ++overlaps; });
    CHECK(overlaps == 0);
    std::set<std::tuple<double, double, double>> places;
    double height[2] = {0, 0};
    for (std::size_t i = 0; i < mixed.particles.size(); ++i) {
        const Vec3& x = mixed.particles.position[i];
        places.insert({x.x, x.y, x.z});
        const bool second = mixed.particles.material[i] == 3;
        height[second] += x.y / static_cast<double>(mixed.powders[second].particles);
    }
    CHECK(places.size() == mixed.particles.size());
    // Both lie at the same mean height, to the scatter of a uniform one over the second powder's 60 spheres.
    const double depth = mixed.fillHeight - c.filling.region.low.y;
    CHECK(std::abs(height[0] - height[1]) < 3 * depth / std::sqrt(12.0) / std::sqrt(60.0));
    CHECK(insertParticles(loadText(text)).particles.position == mixed.particles.position);
    CHECK(insertParticles(loadText(text, {"seed=4"})).particles.position[0] != mixed.particles.position[0]);
    CHECK(insertParticles(loadResolvedCase(c.resolved, "again.toml")).particles.position == mixed.particles.position);
}

TEST_CASE("with other boundaries each powder has a region of its own") {
    const std::string first = replaced(kFreeCase, "list = \"two.csv\"",
                                       "mass_g = 0.1\n[particles.size]\ndistribution = \"fixed\"\nradius_mm = 1\n"
                                       "[particles.region]\nlow = [0, 0, 0]\nhigh = [0.01, 0.01, 0.01]");
    const std::string text =
        first + replaced(kSugar, "0.4", "0.1") + "[powder.region]\nlow = [0.01, 0, 0]\nhigh = [0.02, 0.01, 0.01]\n";
    const Insertion filled = insertParticles(loadText(text));
    for (std::size_t i = 0; i < filled.particles.size(); ++i)
        REQUIRE((filled.particles.position[i].x > 0.01) == (filled.particles.material[i] == 3));
    CHECK_THAT(refusal(first + kSugar), Catch::Contains("powder[0].region: the table is missing"));
    CHECK_THAT(refusal(replaced(text, "[powder.region]\nlow = [0.01, 0, 0]", "[powder.region]\nlow = [0.005, 0, 0]")),
               Catch::Contains("overlap"));
}

TEST_CASE("a refill is of the powder that it names") {
    const Case c = loadText(kMixture + "[[refill]]\nname = \"r\"\nmass_g = 0.1\ntime_s = 0.2\npowder = \"sugar\"\n");
    const Insertion filled = insertParticles(c);
    CHECK(c.refills[0].material == 3);
    const Particles& waiting = filled.waiting[0].particles;
    CHECK(waiting.size() == static_cast<std::size_t>(std::llround(0.1e-3 / sphereMass(1590, 1e-3))));
    CHECK(std::all_of(waiting.material.begin(), waiting.material.end(), [](int m) { return m == 3; }));
    CHECK(std::all_of(waiting.radius.begin(), waiting.radius.end(), [](double r) { return r == 1e-3; }));
}

TEST_CASE("the targets of a powder without particles are met as if its spheres were as large as the others'") {
    const Folder folder;
    const auto file = folder.write(
        "case.toml", replaced(kFreeCase, "damping = 0.0827", "restitution = 0.5") +
                         "[[powder]]\nname = \"sugar\"\ndensity = 1590.0\n[contact.sugar-sugar]\nrestitution = 0.3\n");
    folder.write("two.csv", "x,y,z,r,powder\n0,0,0,1e-3,powder\n0,3e-3,0,1e-3,powder\n");
    const Case c = loadCase(file);
    CHECK(restitution(c.dosingLaw.between(3, 3), reducedMass(1590, 1e-3, 1e-3)) == Approx(0.3).epsilon(1e-9));
    CHECK(loadResolvedCase(c.resolved, "again.toml").resolved == c.resolved);
}

TEST_CASE("a list names the powder of each particle") {
    const std::string text = kFreeCase + "[[powder]]\nname = \"sugar\"\ndensity = 1590.0\n";
    const Folder folder;
    const auto file = folder.write("case.toml", text);
    folder.write("two.csv", "x,y,z,r,powder\n0,0,0,1e-3,powder\n0,3e-3,0,1e-3,sugar\n");
    const Insertion filled = insertParticles(loadCase(file));
    REQUIRE(filled.particles.size() == 2);
    CHECK(int(filled.particles.material[1]) == 3);
    CHECK(filled.powders[1].mass == Approx(sphereMass(1590, 1e-3)));
    CHECK(filled.mass == Approx(sphereMass(1427 + 1590, 1e-3)));
    const auto refused = [&](const std::string& list, const std::string& what) {
        folder.write("two.csv", list);
        CHECK_THAT(
            [&] {
                try {
                    loadCase(file);
                } catch (const CaseError& e) {
                    return std::string(e.what());
                }
                return std::string("accepted");
            }(),
            Catch::Contains(what));
    };
    refused("x,y,z,r\n0,0,0,1e-3\n", "name the powder of each particle");
    refused("x,y,z,r,powder\n0,0,0,1e-3,salt\n", "is no powder of the case");
    CHECK_THAT(refusal(text + "mass_g = 0.1\n"), Catch::Contains("come from a list"));
}

TEST_CASE("the mean density of a fill is that of its volume") {
    const Case c = loadText(kMixture);
    const Fill fill = fillOf(c);
    CHECK(fill.mass == Approx(1.3e-3));
    CHECK(fill.volume == Approx(0.9e-3 / 1427 + 0.4e-3 / 1590));
    CHECK(solidDensity(c) == Approx(1.3e-3 / (0.9e-3 / 1427 + 0.4e-3 / 1590)));
    CHECK(solidDensity(c, 3) == 1590);
    CHECK(solidDensity(loadText(kGoodCase)) == 1427);
}
