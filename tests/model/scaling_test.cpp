// Spheres that stand for smaller grains: scale_up and contact.scaling.
#include <cmath>

#include "host/backend/reference/reference.h"
#include "host/model/size_distribution.h"
#include "host/model/stability.h"
#include "tests/model/case_files.h"
#include "tests/support/catch.h"
#include "tests/support/near.h"

using namespace vkdose;
using test::Folder;
using test::kGoodCase;
using test::kSugar;
using test::near;
using test::replaced;

namespace {

const std::string kRatios =
    "rolling_friction = 0.2\ntorsion_friction = 0.1\nkt_over_k = 0.8\nkr_over_k = 0.3\ndamping_r_ratio = 0.4\n";
const std::string kModuli =
    "youngs_modulus = 5e6\npoisson_ratio = 0.3\nrestitution = 0.6\n" + replaced(kRatios, "kt_over_k = 0.8\n", "");
const std::string kStiffnesses =
    "k = 4000\nk1_over_k = 0.2\nkc_over_k = 0.5\nplasticity_depth = 0.05\ndamping = 0.02\n";

/// A law with all that it has.
struct Law {
    const char* name;
    std::string lines;
};
const std::vector<Law> kLaws{
    {"luding", kStiffnesses + kRatios},
    {"hertz-mindlin", kModuli},
    {"eepa", kModuli + "plasticity_ratio = 0.6\nsurface_energy = 0.4\npull_off_force = 2e-5\n"},
    {"jkr", kModuli + "surface_energy = 0.05\n"},
};

Case scaledCase(const Law& law, double s, const char* scaling = "stress") {
    const Folder folder;
    return loadCase(folder.write("case.toml",
                                 "boundaries = \"none\"\ngravity = [0, 0, 0]\n[particles]\n"
                                 "density = 1427\nmass_g = 0.1\n[particles.size]\n"
                                 "distribution = \"fixed\"\nradius_mm = 1.0\nscale_up = " +
                                     std::to_string(s) +
                                     "\n[particles.region]\nlow = [0, 0, 0]\nhigh = [0.1, 0.1, 0.1]\n"
                                     "[contact]\nfriction = 0.5\nlaw = \"" +
                                     law.name + "\"\nscaling = \"" + scaling + "\"\n" + law.lines +
                                     "[settle]\ntime_s = 1\n"));
}

/// Two spheres after an oblique impact: velocities [m/s] and spins times `s` [rad/s].
std::vector<Vec3> afterImpact(const Case& c, double s, double step) {
    World world = c.world;
    world.timeStep = step * s;
    world.maxOverlapRatio = 1;
    world.domain = {Vec3(-1), Vec3(1)};
    Particles two;
    for (const double sign : {-1.0, 1.0}) {
        const Vec3 at = sign * s * 1.0000001e-3 * glm::normalize(Vec3(1, 0.3, 0.1));
        two.add(at, s * 1e-3, -sign * Vec3(0.2, 0.1, -0.05), Vec3(20, 40 * sign, -30) / s);
    }
    const auto backend = makeReferenceBackend();
    backend->load(world, c.dosingLaw, two);
    backend->advance(4000, 0);
    const Particles p = backend->particles();
    return {p.velocity[0], p.velocity[1], s * p.spin[0], s * p.spin[1]};
}

double farthest(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
    double most = 0;
    for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, glm::length(a[i] - b[i]) / glm::length(a[i]));
    return most;
}

}  // namespace

TEST_CASE("scaled by stress, larger spheres meet as the grains do, whatever the law") {
    for (const Law& law : kLaws) {
        CAPTURE(law.name);
        const Case grains = scaledCase(law, 1), spheres = scaledCase(law, 3), unscaled = scaledCase(law, 3, "none");
        const auto one = afterImpact(grains, 1, grains.world.timeStep);
        const auto three = afterImpact(spheres, 3, grains.world.timeStep);
        CHECK(farthest(one, three) < 1e-6);
        // The impact moved them, so that the comparison means something.
        CHECK(glm::length(one[0] - Vec3(0.2, 0.1, -0.05)) > 0.05);
        CHECK(spheres.world.timeStep == Approx(3 * grains.world.timeStep).epsilon(0.01));
        if (std::string(law.name) == "hertz-mindlin") {
            // Nothing of it depends on the size but by its moduli.
            CHECK(farthest(one, afterImpact(unscaled, 3, grains.world.timeStep)) < 1e-6);
        } else {
            CHECK(farthest(one, afterImpact(unscaled, 3, grains.world.timeStep)) > 1e-3);
        }
    }
}

TEST_CASE("scaled by stress, the parameters that follow from what is wanted are those of grains") {
    const Folder folder;
    const std::string text =
        replaced(replaced(kGoodCase, "k = 2000.0\n", "contact_duration_s = 4e-4\nscaling = \"stress\"\n"),
                 "kc_over_k = 0.5\nplasticity_depth = 0.05\ndamping = 0.02\n",
                 "bond_number = 30\nplasticity_depth = 0.05\nrestitution = 0.5\nrestitution_speed = 0.05\n");
    const auto file = folder.write("case.toml", replaced(text, "radius_min_mm = 0.9\nradius_max_mm = 1.3",
                                                         "radius_min_mm = 0.45\nradius_max_mm = 0.65"));
    const Case grains = loadCase(file), spheres = loadCase(file, {"particles.size.scale_up=2"});
    for (const auto law : {&Case::dosingLaw, &Case::settlingLaw})
        for (std::size_t k = 0; k < kContactClasses; ++k) {
            const ContactParameters a = test::classesOf(grains.*law)[k], b = test::classesOf(spheres.*law)[k];
            CHECK(near(b.k1, 2 * a.k1, a.k1, 1e-9));
            CHECK(near(b.k2Max, 2 * a.k2Max, a.k2Max, 1e-9));
            CHECK(near(b.kc, 2 * a.kc, a.k1, 1e-9));
            CHECK(near(b.kr, 2 * a.kr, a.k1, 1e-9));
            CHECK(near(b.gamma, 4 * a.gamma, a.gamma, 1e-9));
            CHECK(near(b.gammaT, 4 * a.gammaT, a.gamma, 1e-9));
            CHECK(b.plasticityDepth == a.plasticityDepth);
            CHECK(b.mu == a.mu);
        }
    // The resolved case is of the same grains and spheres.
    const Case again = loadResolvedCase(spheres.resolved, folder / "case.toml");
    CHECK(again.resolved == spheres.resolved);
    CHECK(again.dosingLaw.between(0, 0).k1 == spheres.dosingLaw.between(0, 0).k1);
    CHECK(again.dosingLaw.between(0, 1).gamma == spheres.dosingLaw.between(0, 1).gamma);
    CHECK(again.world.timeStep == spheres.world.timeStep);
    CHECK_THAT(spheres.derivations.back(), Catch::Contains("2 times as large"));
}

TEST_CASE("softer spheres are softer grains, scaled") {
    const Folder folder;
    const auto file = folder.write("case.toml", kGoodCase);
    const Case soft = loadCase(file, {"contact.soften=4"});
    const Case both = loadCase(file, {"contact.soften=4", "contact.scaling=stress", "particles.size.scale_up=2",
                                      "particles.size.radius_min_mm=0.45", "particles.size.radius_max_mm=0.65"});
    CHECK(both.dosingLaw.between(0, 0).k1 == Approx(2 * soft.dosingLaw.between(0, 0).k1));
    CHECK(both.dosingLaw.between(0, 0).gamma == Approx(4 * soft.dosingLaw.between(0, 0).gamma));
    const Case again = loadResolvedCase(both.resolved, folder / "case.toml");
    CHECK(again.dosingLaw.between(0, 0).k1 == both.dosingLaw.between(0, 0).k1);
}

TEST_CASE("every kind of sizes can be scaled up") {
    const std::string sizes = "distribution = \"uniform\"\nradius_min_mm = 0.9\nradius_max_mm = 1.3\n";
    for (const char* kind :
         {"distribution = \"uniform\"\nradius_min_mm = 0.3\nradius_max_mm = 0.4\n",
          "distribution = \"fixed\"\nradius_mm = 0.35\n",
          "distribution = \"normal\"\nradius_mean_mm = 0.35\nradius_deviation_mm = 0.03\n",
          "distribution = \"normal\"\nradius_mean_mm = 0.35\nradius_deviation_mm = 0.03\n"
          "radius_min_mm = 0.33\nradius_max_mm = 0.37\n",
          "distribution = \"lognormal\"\nradius_median_mm = 0.35\nlog_deviation = 0.1\n",
          "distribution = \"quantiles\"\nd10_um = 600\nd50_um = 700\nd90_um = 800\n",
          "distribution = \"sieve\"\nopenings_um = [600, 700, 800]\npassing_percent = [0, 40, 100]\n"}) {
        CAPTURE(kind);
        const Folder folder;
        const auto file = folder.write("case.toml", replaced(kGoodCase, sizes, kind));
        const Case spheres = loadCase(file, {"particles.size.scale_up=3"});
        const Case larger = loadCase(file, {"particles.size.scale_up=3.3"});
        const SizeDistribution &three = spheres.filling.size, &more = larger.filling.size;
        CHECK(three.scaleUp == 3);
        CHECK(smallestRadius(three) > 0.8e-3);
        CHECK(largestRadius(more) == Approx(1.1 * largestRadius(three)));
        CHECK(smallestRadius(more) == Approx(1.1 * smallestRadius(three)));
        const SizeDistribution same = enlarged(three, 1.1);
        CHECK(same.scaleUp == Approx(3.3));
        CHECK(meanRadius(same) == Approx(meanRadius(more)));
        CHECK(meanCubedRadius(same) == Approx(meanCubedRadius(more)));
        CHECK(smallestRadius(same) == Approx(smallestRadius(more)));
        CHECK(largestRadius(same) == Approx(largestRadius(more)));
        std::uint64_t redrawn = 0;
        for (std::uint64_t i = 0; i < 200; ++i)
            CHECK(drawRadius(more, 7, i, redrawn) == Approx(1.1 * drawRadius(three, 7, i, redrawn)));
        const Case again = loadResolvedCase(larger.resolved, folder / "case.toml");
        CHECK(again.resolved == larger.resolved);
        CHECK(insertParticles(again).particles.radius == insertParticles(larger).particles.radius);
    }
}

TEST_CASE("a scaling that cannot be is refused by name") {
    const Folder folder;
    const auto file = folder.write("case.toml", kGoodCase + kSugar);
    CHECK_NOTHROW(loadCase(file, {"contact.scaling=stress"}));
    CHECK_THROWS_WITH(loadCase(file, {"contact.scaling=stress", "powder.sugar.size.scale_up=1.1"}),
                      Catch::Contains("powder[0].size.scale_up") && Catch::Contains("one for all powders"));
    CHECK_NOTHROW(loadCase(file, {"powder.sugar.size.scale_up=1.1"}));
    CHECK_THROWS_WITH(loadCase(file, {"contact.scaling=weight"}), Catch::Contains("contact.scaling"));

    folder.write("spring.glsl",
                 "parameter float k;\nfloat force(Contact c) { return k * c.overlap; }\n"
                 "float stiffness(Contact c) { return k; }\n");
    const std::string contact =
        kGoodCase.substr(kGoodCase.find("k = 2000"), kGoodCase.find("friction = 0.5") - kGoodCase.find("k = 2000"));
    const auto own = folder.write(
        "own.toml", replaced(kGoodCase, contact, "law = \"spring.glsl\"\n") + "[contact.parameters]\nk = 2000\n");
    CHECK_THROWS_WITH(loadCase(own, {"contact.scaling=stress", "particles.size.scale_up=1.1"}),
                      Catch::Contains("contact.scaling") && Catch::Contains("law of one's own"));
}
