// Warnings about the particles, their contacts and gravity.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "host/advice/rules.h"
#include "host/law/luding.h"
#include "host/model/bed_weight.h"
#include "host/model/powders.h"
#include "host/model/stability.h"

namespace vkdose {
namespace {

constexpr double kWall = std::numeric_limits<double>::infinity();
constexpr double kLightest = 50, kHeaviest = 23000;  ///< densities of materials: foams to platinum metals [kg/m3]
/// The densities of the default's powder: in the bed (the default of bulk_density) and of its particles [kg/m3].
constexpr double kCocoaBulk = 471, kCocoa = 1427;
constexpr double kLoosest = 0.15, kDensest = 0.75;  ///< volume fractions of settled beds
/// Coefficients of friction beyond this are angles.
constexpr double kMostFriction = 1.5;
constexpr double kLeastRestitution = 0.1, kMostRestitution = 0.95;
constexpr double kDeepFall = 0.5;  ///< share of the largest overlap that one sphere's fall may take
constexpr std::size_t kFewest = 60;
constexpr double kWidest = 7;  ///< size ratio up to which the automatic step is exact (host/verify/README.md)

/// The key of a pair's table, whose name has the two materials in the order that the case has.
std::string pairKey(const Subject& s, MaterialPair pair, const char* key) {
    constexpr std::array<const char*, kUsualMaterials> kTable{"contact", "contact.wall", "contact.coil"};
    if (pair.a == kFirstPowder && pair.b < kUsualMaterials)
        return fmt::format("{}.{}", kTable[std::size_t(pair.b)], key);
    const std::string turned = fmt::format("contact.{}.{}", nameOf(s.c.world, {pair.b, pair.a}), key);
    return s.node(turned) != nullptr ? turned : fmt::format("contact.{}.{}", nameOf(s.c.world, pair), key);
}

/// The key that says how stiff the contacts of the first powder with itself, or with a wall, are. Walls that are as
/// stiff as the powder have it from there. Of two moduli that of the powder counts, which is softer than its walls.
std::string stiffnessKey(const Subject& s, MaterialPair pair) {
    const NormalLaw law = s.c.dosingLaw.of(pair).law;
    if (law == NormalLaw::User) return "contact.law";
    if (law != NormalLaw::Luding) return "contact.youngs_modulus";
    const bool asPowder = pair.b == kWallMaterial && s.value("contact.wall.k") == s.value("contact.k");
    return pairKey(s, asPowder ? pairOf(ContactClass::ParticleParticle) : pair, "k");
}

/// The cure of overlaps that are too large: `linear` times the stiffness of Luding's law, before it is softened, or
/// `elastic` times the modulus of Hertz's.
std::string stiffer(const Subject& s, const ContactParameters& p, double linear, double elastic) {
    return p.law == NormalLaw::Luding ? fmt::format("give at least {:.2g}", s.c.softened * p.k2Max * linear)
                                      : fmt::format("make it at least {:.2g} times as large", elastic);
}

/// The damping that would give mean spheres what the key was perhaps meant to say, or else one half.
std::string dampingCure(const Subject& s, const Restitution& e) {
    const ContactParameters& p = s.c.dosingLaw.of(e.pair);
    const double given = std::sqrt(s.c.softened) * p.gamma;
    const bool meant = given >= kLeastRestitution && given <= kMostRestitution;
    const double wanted = meant ? given : 0.5;
    const double partner = s.c.world.materials.at(std::size_t(e.pair.b)).powder ? s.f.mean : kWall;
    const double damping =
        std::sqrt(s.c.softened) * dampingFor(wanted, p, reducedMass(s.c.world, e.pair, s.f.mean, partner));
    return fmt::format(
        "damping is a dashpot in kg/s; {:.3g} gives mean spheres a restitution of {:.2g}; or give "
        "restitution = {:.2g} in its place",
        damping, wanted, wanted);
}

}  // namespace

Found lightOrHeavyPowder(const Subject& s) {
    for (const PowderOf& p : powdersOf(s.c)) {
        const double density = s.c.world.density(p.material);
        if (density >= kLightest && density <= kHeaviest) continue;
        return Finding{p.path + ".density",
                       fmt::format("particles of {:.4g} kg/m3 are {} than any material", density,
                                   density < kLightest ? "lighter" : "heavier"),
                       density < kLightest ? fmt::format("give kg/m3: {:.4g} g/cm3 is {:.4g}", density, density * 1e3)
                                           : "give kg/m3"};
    }
    return {};
}

Found roundedLaw(const Subject& s) {
    constexpr double kMost = 1e-3;
    const auto& r = s.c.lawRounding;
    if (!r || r->share <= kMost) return {};
    return Finding{
        "contact.law",
        fmt::format("{} of {} answers {:.5g} in single precision and {:.5g} exactly ({}, overlap {:.3g} m)",
                    r->function, s.c.dosingLaw.user->name, r->device, r->exact, r->pair, r->overlap),
        "write it so that no two numbers which are almost the same are subtracted; devices compute in single "
        "precision, --backend reference in double"};
}

Found unusedMaterial(const Subject& s) {
    const World& w = s.c.world;
    for (std::size_t m = kUsualMaterials; m < w.materials.size(); ++m) {
        const auto isOf = [&](int material) { return material == int(m); };
        const bool used =
            w.materials[m].powder ||
            std::any_of(w.walls.begin(), w.walls.end(), [&](const Wall& wall) { return isOf(wall.material); }) ||
            std::any_of(w.bodies.begin(), w.bodies.end(), [&](const RigidBody& body) { return isOf(body.material); });
        if (used) continue;
        return Finding{"material", fmt::format("nothing is made of \"{}\"", w.materials[m].name),
                       "name it as `material` of a powder, a wall or a body, or remove it"};
    }
    return {};
}

Found strangeBulkDensity(const Subject& s) {
    if (!s.c.world.coil || s.c.schedule.rotateTime == 0) return {};
    const double density = solidDensity(s.c), fraction = s.c.bulkDensity / density;
    const std::string cure =
        fmt::format("give the density of the settled powder; spheres settle to about {:.3g}", kBedFraction * density);
    if (s.c.bulkDensity == kCocoaBulk && std::abs(density / kCocoa - 1) > 0.02)
        return Finding{
            "bulk_density",
            fmt::format("is that of cocoa, whose particles have {} kg/m3, while these have {:.4g}; the closed "
                        "form of the dose is in proportion to it",
                        kCocoa, density),
            cure};
    if (fraction >= kLoosest && fraction <= kDensest) return {};
    return Finding{"bulk_density",
                   fmt::format("is {:.3g} of the density of the particles; settled powders have {} to {}", fraction,
                               kLoosest, kDensest),
                   cure};
}

Found strangeGravity(const Subject& s) {
    const Vec3 g = s.c.world.gravity;
    const double size = glm::length(g);
    if (size > 100)
        return Finding{"gravity", fmt::format("is {:.3g} times the earth's", size / 9.81), "give m/s2: [0, -9.81, 0]"};
    if (!s.c.canister) return {};  // without a canister there is no up and down
    if (size < 0.5)
        return Finding{"gravity", fmt::format("of {:.3g} m/s2 hardly moves the powder", size),
                       "give m/s2: [0, -9.81, 0]"};
    if (g.y > 0 && g.y >= std::max(std::abs(g.x), std::abs(g.z)))
        return Finding{"gravity", "points upwards, out of the canister", "y is up: give [0, -9.81, 0]"};
    if (-g.y < std::max(std::abs(g.x), std::abs(g.z)))
        return Finding{"gravity",
                       fmt::format("points along {}, so that the powder lies against a wall",
                                   std::abs(g.x) > std::abs(g.z) ? "x, across the canister" : "z, the coil's axis"),
                       "y is up: give [0, -9.81, 0]"};
    return {};
}

Found strangeFriction(const Subject& s) {
    struct Coefficient {
        const char* key;
        double ContactParameters::*value;
    };
    constexpr std::array<Coefficient, 3> kAll{{{"friction", &ContactParameters::mu},
                                               {"rolling_friction", &ContactParameters::muR},
                                               {"torsion_friction", &ContactParameters::muTo}}};
    for (const MaterialPair& pair : occurringPairs(s.c.world)) {
        for (const Coefficient& k : kAll) {
            const double value = s.c.dosingLaw.of(pair).*k.value;
            if (!(value > kMostFriction)) continue;
            return Finding{pairKey(s, pair, k.key),
                           fmt::format("a coefficient of {:.3g} bears {:.3g} times the normal force", value, value),
                           value < 90 ? fmt::format("give the coefficient, not the angle: {:.3g} degrees are {:.3g}",
                                                    value, std::tan(value * kPi / 180))
                                      : "give a coefficient, as a rule below 1"};
        }
    }
    return {};
}

Found overdampedContacts(const Subject& s) {
    for (const Restitution& e : s.f.restitutions) {
        if (e.mean > 0 || s.c.dosingLaw.user) continue;  // what a user's law damps, its file says
        return Finding{
            pairKey(s, e.pair, "damping"),
            fmt::format("{} contacts of mean spheres are overdamped: they creep apart and never rebound, and "
                        "their duration is infinite",
                        nameOf(s.c.world, e.pair)),
            dampingCure(s, e)};
    }
    return {};
}

Found strangeRestitution(const Subject& s) {
    for (const Restitution& e : s.f.restitutions) {
        if (e.mean == 0) continue;  // overdamped, which is told already
        const ContactParameters& p = s.c.dosingLaw.of(e.pair);
        if (p.law != NormalLaw::Luding) continue;  // the case states the restitution itself
        const bool elastic = e.mean > kMostRestitution && p.k1 == p.k2Max;
        if (!elastic && e.mean >= kLeastRestitution && e.smallest > 0) continue;
        return Finding{pairKey(s, e.pair, "damping"),
                       fmt::format("gives {} contacts of mean spheres a restitution of {:.2g}, of the smallest {:.2g}, "
                                   "of the largest {:.2g}",
                                   nameOf(s.c.world, e.pair), e.mean, e.smallest, e.largest),
                       dampingCure(s, e)};
    }
    return {};
}

Found deepUnderWeight(const Subject& s) {
    const double limit = s.c.world.maxOverlapRatio;
    if (!(kChain * s.f.overlapUnderBed > limit)) return {};
    const double growth = kChain * s.f.overlapUnderBed / limit;
    const MaterialPair pair = pairOf(ContactClass::ParticleParticle);
    return Finding{stiffnessKey(s, pair),
                   fmt::format("under {:.3g} mm of powder mean spheres overlap by {:.2g} of their radius, in chains of "
                               "force {} times that; the run ends at {:.3g}",
                               s.f.bedDepth * 1e3, s.f.overlapUnderBed, kChain, limit),
                   stiffer(s, s.c.dosingLaw.of(pair), growth, std::pow(growth, 1.5))};
}

Found deepOfFall(const Subject& s) {
    const double limit = s.c.world.maxOverlapRatio;
    if (!(s.f.overlapOfFall > kDeepFall * limit)) return {};
    const double growth = s.f.overlapOfFall / (kDeepFall * limit);
    const MaterialPair pair = canisterPair(s.c);
    return Finding{
        stiffnessKey(s, pair),
        fmt::format("the fill falls {:.3g} mm and arrives at {:.2g} m/s, where a largest sphere alone goes "
                    "{:.2g} of its radius into the wall and several at once go deeper; the run ends at {:.3g}",
                    s.f.fall * 1e3, s.f.fallSpeed, s.f.overlapOfFall, limit),
        stiffer(s, s.c.dosingLaw.of(pair), growth * growth, std::pow(growth, 2.5)) + ", or a larger max_overlap_ratio"};
}

Found fewSpheres(const Subject& s) {
    const std::size_t count = s.filled.particles.size();
    if (!s.c.canister || s.c.schedule.rotateTime == 0 || count >= kFewest) return {};
    return Finding{
        s.given("particles.mass_g", "particles.list"),
        fmt::format("{} spheres are no powder: what they do depends on where each one lies", count),
        fmt::format("give more mass, or spheres {:.2g} times smaller", std::cbrt(500.0 / static_cast<double>(count)))};
}

Found wideSizes(const Subject& s) {
    const double ratio = s.f.largest / s.f.smallest;
    if (!(ratio > kWidest) || s.c.world.timeStep < 0.6 * s.f.automaticStep) return {};
    return Finding{
        "time.step_s",
        fmt::format("the largest sphere is {:.3g} times the smallest; above {} the automatic step is too long "
                    "where a small one rolls between large ones",
                    ratio, kWidest),
        fmt::format("give {:.2g}, half of it, or narrower sizes", 0.5 * s.f.automaticStep)};
}

/// Amounts that lie on each sieve have a peak somewhere. Sums of all that is coarser grow to the finest sieve.
Found cumulativeSieves(const Subject& s) {
    constexpr std::size_t kFewestSieves = 4;  // of fewer the finest may have most by chance
    for (const PowderOf& p : powdersOf(s.c)) {
        const std::string key = p.path + ".size.retained";
        const Node* table = s.node(key);
        if (table == nullptr || table->children.size() < kFewestSieves) continue;
        const auto& on = table->children;
        double sum = 0;
        bool grows = true;
        for (std::size_t i = 0; i < on.size(); ++i) {
            sum += on[i].number;
            grows = grows && (i == 0 || on[i].number <= on[i - 1].number);
        }
        const double finest = on.front().number;
        const bool percent = std::abs(finest - 100) < 1 || std::abs(finest - 1) < 0.01;
        const bool several = sum > 1.2 * finest;
        if (!grows || !several || !(percent || on.size() > kFewestSieves)) continue;
        return Finding{
            key,
            fmt::format("grows from sieve to sieve up to {:.4g} on the finest, as sums of all that is coarser "
                        "do; it is taken as what lies on each sieve alone",
                        finest),
            "give the differences, or passing_percent = 100 minus the sum"};
    }
    return {};
}

}  // namespace vkdose
