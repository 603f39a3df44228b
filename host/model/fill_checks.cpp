// Whether the powder goes into the place that the case has for it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>

#include "host/core/millimetres.h"
#include "host/model/checks.h"
#include "host/model/free_sites.h"
#include "host/model/grid.h"
#include "host/model/powders.h"
#include "host/model/size_distribution.h"

namespace vkdose {
namespace {

/// Smallest volume fraction that a settled bed can keep: a cohesive one (measured beds: about 0.46), and one without
/// adhesion (measured: 0.56).
constexpr double kLoosestBed = 0.35, kLoosestFreeBed = 0.5;
/// More particles than this mean that a unit is wrong.
constexpr double kMaxParticles = 5e6;

/// Compares the volume of the bed with that of the canister. The bed is taken at the loosest packing that it can keep.
void checkBed(CaseReader& reader, const Case& c) {
    const Canister& can = *c.canister;
    const double half = can.width / 2;
    const double below = can.flatFloor ? can.width * half : 0.5 * kPi * half * half;
    const double volume = can.length * (below + can.width * (can.height - half));
    const ContactParameters& pair = c.dosingLaw.of(ContactClass::ParticleParticle);
    const bool sticky = pair.kc > 0 || pair.surfaceEnergy > 0 || pair.constantPull > 0;
    const double loosest = sticky ? kLoosestBed : kLoosestFreeBed;
    const Fill fill = fillOf(c);
    const double bed = fill.volume / loosest;
    // No powder is lighter than this. A lower density was probably given in g/cm3; without this bound the message would
    // blame the mass.
    constexpr double kLightest = 20;
    const std::vector<PowderOf> powders = powdersOf(c);
    const auto light = std::find_if(powders.begin(), powders.end(),
                                    [&](const PowderOf& p) { return c.world.density(p.material) < kLightest; });
    if (bed > volume && light != powders.end()) {
        const double density = c.world.density(light->material);
        reader.fault(
            light->path + ".density",
            fmt::format("makes the fill too large: {:.4g} cm3 for a canister of {:.4g} cm3", bed * 1e6, volume * 1e6),
            fmt::format("give kg/m3; {:.6g} g/cm3 is {:.6g} kg/m3", density, 1e3 * density));
    } else if (bed > volume) {
        // The powder that takes the most room is most probably the wrong one.
        const auto most = std::max_element(powders.begin(), powders.end(), [&](const PowderOf& a, const PowderOf& b) {
            return a.filling.mass / c.world.density(a.material) < b.filling.mass / c.world.density(b.material);
        });
        const double rest = bed - most->filling.mass / c.world.density(most->material) / loosest;
        const double room = (volume - rest) * loosest * c.world.density(most->material);
        reader.fault(most->path + ".mass_g",
                     fmt::format("the fill does not fit: a loose bed of it (volume fraction {}) takes {:.4g} cm3, the "
                                 "canister holds {:.4g} cm3",
                                 loosest, bed * 1e6, volume * 1e6),
                     room > 0 ? fmt::format("give at most {:.4g} g or a higher canister", room * 1e3)
                              : "give less of all powders, or a higher canister");
    }
}

/// The largest sphere must pass the canister and its outlet.
void checkLargest(CaseReader& reader, const Case& c, double largest) {
    const Canister& can = *c.canister;
    std::string key = "particles.list";
    if (!c.filling.list)
        for (const PowderOf& p : powdersOf(c))
            if (largestRadius(p.filling.size) == largest)
                key = p.path + (p.filling.size.kind == SizeDistribution::Kind::Fixed ? ".size.radius_mm"
                                                                                     : ".size.radius_max_mm");
    const double narrowest = std::min(can.width, can.outletDiameter);
    if (largest >= narrowest / 2)
        reader.fault(key,
                     fmt::format("spheres of radius {:.4g} mm do not pass the {:.4g} mm {}", mm(largest), mm(narrowest),
                                 can.outletDiameter < can.width ? "outlet" : "trough"),
                     fmt::format("keep radii below {:.4g} mm{}", mm(narrowest / 2),
                                 c.filling.list ? "; a list is in metres" : ""));
}

/// Where a mass of the case is given, and how many particles it takes about.
struct Amount {
    std::string key;
    std::string powder;  ///< the table that has its sizes
    double mass = 0, particles = 0;
};

std::vector<Amount> amountsOf(const Case& c) {
    const std::vector<PowderOf> powders = powdersOf(c);
    std::vector<Amount> amounts;
    const auto add = [&](std::string key, double mass, const PowderOf& p) {
        const double each = sphereMass(c.world.density(p.material), std::cbrt(meanCubedRadius(p.filling.size)));
        amounts.push_back({std::move(key), p.path, mass, mass / each});
    };
    for (const PowderOf& p : powders) add(p.path + ".mass_g", p.filling.mass, p);
    for (std::size_t k = 0; k < c.refills.size(); ++k)
        add(fmt::format("refill[{}].mass_g", c.refills[k].table), c.refills[k].mass,
            powders[powderIndex(c, c.refills[k].material)]);
    return amounts;
}

/// Refuses a mass too small for a single sphere, and names the file that has the density if it is another one.
void refuseLittle(CaseReader& reader, const Case& c, const std::string& key, const PowderOf& p) {
    const double density = c.world.density(p.material);
    const std::string& file = reader.fileOf(p.path + ".density");
    reader.fault(key,
                 fmt::format("is less than half of the first particle drawn; at {:.6g} kg/m3{} a sphere weighs about "
                             "{:.3g} g",
                             density, file == reader.fileOf(key) ? "" : fmt::format(" ({})", file),
                             1e3 * sphereMass(density, std::cbrt(meanCubedRadius(p.filling.size)))),
                 "give more mass, or look at the density");
}

/// Refuses absurd numbers of particles. Returns whether there are as many as that.
bool checkNumber(CaseReader& reader, const Case& c) {
    const std::vector<Amount> amounts = amountsOf(c);
    // The key that makes the most particles is most probably the wrong one.
    const auto most = std::max_element(amounts.begin(), amounts.end(),
                                       [](const Amount& a, const Amount& b) { return a.particles < b.particles; });
    double particles = 0;
    for (const Amount& a : amounts) particles += a.particles;
    if (particles <= kMaxParticles) return false;
    const SizeDistribution::Kind kind = c.filling.size.kind;
    const std::string& file = reader.fileOf(most->powder + ".size");
    reader.fault(most->key,
                 fmt::format("takes about {:.2g} particles{}{}", most->particles,
                             file == reader.fileOf(most->key) ? "" : fmt::format(" of the sizes in {}", file),
                             amounts.size() == 1 ? "" : fmt::format(", and with the other masses {:.2g}", particles)),
                 kind == SizeDistribution::Kind::Quantiles
                     ? "give less mass or a larger scale_up; d10_um, d50_um and d90_um are in micrometres"
                 : kind == SizeDistribution::Kind::Sieve
                     ? "give less mass, a larger scale_up, or a radius_min_mm that leaves the finest out"
                     : "give less mass or larger meso-particles");
    return true;
}

void checkGrid(CaseReader& reader, const Case& c, double largest) {
    if (checkNumber(reader, c)) return;
    const std::vector<PowderOf> powders = powdersOf(c);
    const std::vector<std::size_t> counts = drawnParticles(c);
    const auto inMixture = static_cast<double>(std::accumulate(counts.begin(), counts.end(), std::size_t{0}));
    for (std::size_t k = 0; k < powders.size(); ++k) {
        const PowderOf& p = powders[k];
        const double widest = c.mixed ? largest : largestRadius(p.filling.size);
        // In a canister all grids have the same sites in a layer, and layers without end.
        const Box& region = c.canister || c.mixed ? c.filling.region : p.filling.region;
        const Filling& filling = c.mixed ? c.filling : p.filling;
        const double capacity = filling.sites ? static_cast<double>(filling.sites->size())
                                              : InsertionGrid(region, widest, p.filling.gridGap).capacity();
        const double count = c.mixed ? inMixture : static_cast<double>(counts[k]);
        if (counts[k] == 0)
            refuseLittle(reader, c, p.path + ".mass_g", p);
        else if (capacity < 1 && c.canister)
            reader.fault(p.path + ".size", "the largest sphere does not fit between the walls",
                         "give smaller particles");
        else if (capacity < count && filling.sites && (!c.mixed || k == 0))
            reader.fault("particles.inside",
                         fmt::format("has {:.0f} clear sites of the grid for {:.0f} particles", capacity, count),
                         fmt::format("give at most {:.3g} g, smaller particles or a larger vessel",
                                     1e3 * fillOf(c).mass * std::floor(0.98 * capacity) / count));
        else if (capacity < count && (!c.mixed || k == 0))
            reader.fault(p.path + ".region",
                         fmt::format("has {:.0f} sites of the grid for {:.0f} particles", capacity, count),
                         "give a larger region, less mass or smaller particles");
    }
}

/// The vessel's grid is as wide as the powder of the fill needs it.
void checkVesselRefills(CaseReader& reader, const Case& c, const Insertion& filled) {
    const InsertionGrid grid = gridOfFill(c);
    for (std::size_t k = 0; k < c.refills.size(); ++k) {
        const auto fault = [&](const char* key, const std::string& problem, const std::string& remedy) {
            reader.fault(fmt::format("refill[{}].{}", c.refills[k].table, key), problem, remedy);
        };
        const double largest = largestRadius(powdersOf(c)[powderIndex(c, c.refills[k].material)].filling.size);
        const std::size_t spheres = filled.waiting[k].particles.size();
        if (2 * largest > grid.pitch())
            fault("powder", "has larger spheres than the powder that starts inside the vessel",
                  "let the powder with the largest spheres be that of [particles]");
        if (static_cast<double>(spheres) > grid.capacity())
            fault(
                "mass_g",
                fmt::format("takes {} spheres, and the vessel has {:.0f} sites of the grid", spheres, grid.capacity()),
                "add it in several refills");
    }
}

/// The bulk density times the room of the vessel below the height.
void fillToHeight(CaseReader& reader, Section& particles, Case& c) {
    Filling& filling = c.filling;
    Box below = filling.region;
    below.high.y = below.low.y + *filling.height;
    if (below.high.y > filling.region.high.y) {
        reader.fault("particles.fill_height_mm",
                     fmt::format("reaches over the vessel, which is {:.4g} mm high",
                                 mm(filling.region.high.y - filling.region.low.y)),
                     "give a height in it");
        return;
    }
    const double room = roomInside(c.world, below, gridOfFill(c).pitch() / 2);
    filling.mass = c.bulkDensity * room;
    if (!(filling.mass > 0)) {
        reader.fault("particles.fill_height_mm", "leaves no room in the vessel for powder", "give a larger height");
        return;
    }
    particles.record("mass_g", 1e3 * filling.mass);
    c.derivations.push_back(fmt::format("particles: mass_g = {:.4g} from fill_height_mm = {:.4g}, a room of {:.4g} cm3",
                                        1e3 * filling.mass, mm(*filling.height), 1e6 * room));
}

}  // namespace

void findVessel(CaseReader& reader, Section& particles, Case& c) {
    Filling& filling = c.filling;
    if (filling.vessel.empty()) return;
    const InsertionGrid grid = gridOfFill(c);
    if (!(grid.capacity() < kMaxParticles)) {
        reader.fault("particles.inside", fmt::format("is a vessel with {:.2g} sites of the grid", grid.capacity()),
                     "bound it by [particles.region], or give larger meso-particles");
        return;
    }
    filling.sites = std::make_shared<const std::vector<std::uint64_t>>(
        sitesInside(c.world, grid, boxAround(c.world.bodies, filling.vessel), grid.pitch() / 2));
    if (filling.height) fillToHeight(reader, particles, c);
}

void checkFilling(CaseReader& reader, const Case& c, double largestRadius) {
    if (c.canister) checkLargest(reader, c, largestRadius);
    if (c.canister && !c.filling.list) checkBed(reader, c);
    if (!reader.faulty() && !c.filling.list) checkGrid(reader, c, largestRadius);
}

void checkRefills(CaseReader& reader, const Case& c, const Insertion& filled) {
    for (std::size_t k = 0; k < c.refills.size(); ++k)
        if (filled.waiting[k].particles.size() == 0 && !c.refills[k].again)
            refuseLittle(reader, c, fmt::format("refill[{}].mass_g", c.refills[k].table),
                         powdersOf(c)[powderIndex(c, c.refills[k].material)]);
    if (c.filling.sites) {
        checkVesselRefills(reader, c, filled);
        return;  // they stand in the vessel, wherever gravity points
    }
    const Vec3& g = c.world.gravity;
    if (!c.refills.empty() && -g.y < glm::length(g) * std::sqrt(0.5))  // more than 45 degrees from -y
        reader.fault("gravity",
                     "does not point along -y; a refill stands over the powder along +y and would not fall onto it",
                     "turn the device so that gravity points along -y, or leave the refill out");
}

}  // namespace vkdose
