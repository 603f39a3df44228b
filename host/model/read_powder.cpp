// The table [particles].
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "host/model/body_form.h"
#include "host/model/case_sections.h"
#include "host/model/free_sites.h"
#include "host/model/size_distribution.h"

namespace vkdose {
namespace {

/// Says what number distribution the sieves make. An older text, in a resolved case, gives way to it.
void recordDerivation(Section& section, const SizeDistribution& size, Case& c) {
    if (section.has("derived")) (void)section.string("derived");
    section.know("derived");
    if (size.sieve.empty() || !(size.radiusMin < size.radiusMax)) return;  // told elsewhere
    const std::string words = sieveDerivation(size);
    section.record("derived", words);
    c.derivations.push_back(fmt::format("{}: {}", section.path(), words));
}

}  // namespace

SizeDistribution readSize(CaseReader& reader, Section& section, Case& c) {
    using Kind = SizeDistribution::Kind;
    SizeDistribution size;
    const auto kind = section.choice("distribution");
    if (!kind) {
        section.abandon();
        return size;
    }
    size.kind = static_cast<Kind>(*kind);
    size.scaleUp = section.number("scale_up");
    const auto ofGrains = [&](const char* key, std::optional<double> standard = {}) {
        return size.scaleUp * section.number(key, standard);
    };
    const auto boundsOfGrains = [&](double low, double high) {  // defaults, of the spheres [m]
        size.radiusMin = ofGrains("radius_min_mm", low * 1e3 / size.scaleUp);
        size.radiusMax = ofGrains("radius_max_mm", high * 1e3 / size.scaleUp);
    };
    const auto boundsOfSpheres = [&](double low, double high) {
        size.radiusMin = section.number("radius_min_mm", low * 1e3);
        size.radiusMax = section.number("radius_max_mm", high * 1e3);
    };
    switch (size.kind) {
        case Kind::Uniform:
            size.radiusMin = ofGrains("radius_min_mm");
            size.radiusMax = ofGrains("radius_max_mm");
            break;
        case Kind::Fixed:
            size.radius = ofGrains("radius_mm");
            break;
        case Kind::Normal:
            size.radius = ofGrains("radius_mean_mm");
            size.deviation = ofGrains("radius_deviation_mm");
            boundsOfGrains(std::max(size.radius - 2 * size.deviation, 0.1 * size.radius),
                           size.radius + 2 * size.deviation);
            break;
        case Kind::Lognormal:
            size.radius = ofGrains("radius_median_mm");
            size.deviation = section.number("log_deviation");
            boundsOfGrains(size.radius * std::exp(-2 * size.deviation), size.radius * std::exp(2 * size.deviation));
            break;
        case Kind::Quantiles:
            size.r10 = 0.5 * ofGrains("d10_um");
            size.r50 = 0.5 * ofGrains("d50_um");
            size.r90 = 0.5 * ofGrains("d90_um");
            boundsOfSpheres(finestRadius(size), coarsestRadius(size));
            break;
        case Kind::Sieve:
            readSieve(reader, section, size, c.files);
            boundsOfSpheres(size.sieve.empty() ? kNaN : finestRadius(size),
                            size.sieve.empty() ? kNaN : coarsestRadius(size));
            recordDerivation(section, size, c);
            break;
    }
    return size;
}

namespace {

/// The mass, or the height of the vessel that it follows from.
void readAmount(CaseReader& reader, Section& particles, Filling& filling) {
    if (!particles.has("fill_height_mm")) {
        particles.know("fill_height_mm");
        filling.mass = particles.number("mass_g");
        return;
    }
    filling.height = particles.number("fill_height_mm");
    particles.forget("fill_height_mm");
    particles.record("mass_g", 0.0);  // keeps its place in the resolved case; findVessel knows it
    const std::string path = particles.path("fill_height_mm");
    if (particles.has("mass_g")) reader.fault(path, "mass_g is given too", "give one of the two");
    if (!particles.has("inside"))
        reader.fault(path, "is the height of a vessel, and no vessel is given", "give particles.inside, or mass_g");
    particles.know("mass_g");
}

}  // namespace

void readParticles(CaseReader& reader, Section& root, Case& c) {
    Section& section = root.requiredTable("particles");
    c.world.density() = section.number("density");
    if (section.has("list")) {
        if (section.has("mass_g"))
            reader.fault("particles.mass_g", "a list of particles has its own mass", "give mass_g or list, not both");
        section.know("mass_g");
        section.know("fill_height_mm");
        c.filling.list.emplace();
        (void)section.string("list");  // readList reads the file, once the powders have names
        return;
    }
    section.know("list");
    readAmount(reader, section, c.filling);
    c.filling.gridGap = section.number("grid_gap");
    c.filling.size = readSize(reader, section.requiredTable("size"), c);
}

namespace {

/// The bodies that the powder starts inside of, and the box around them.
void readVessel(CaseReader& reader, Section& particles, Case& c) {
    const std::string text = particles.string("inside");
    if (!particles.isString("inside")) return;
    for (const std::string& name : wordsOf(text))
        if (const auto body = placeOfBody(reader, particles.path("inside"), name, c)) c.filling.vessel.push_back(*body);
    if (wordsOf(text).empty())
        reader.fault(particles.path("inside"), "names no body", "give the name of the [[body]] that holds the powder");
    c.filling.region = boxAround(c.world, c.filling.vessel);
    const bool bounded = glm::all(glm::lessThan(c.filling.region.low, c.filling.region.high));
    if (c.filling.vessel.empty() || bounded) return;
    if (!particles.has("region"))
        reader.fault(particles.path("inside"), "names only bodies without an end", "add [particles.region] as a bound");
    c.filling.region = {Vec3(-kInfinity), Vec3(kInfinity)};
}

}  // namespace

void readRegion(CaseReader& reader, Section& root, std::optional<Boundaries> kind, Case& c) {
    Section& particles = root.table("particles");
    if (!kind)
        for (const char* key : {"region", "drop_mm", "inside"}) particles.know(key);
    if (!kind || c.filling.list) return;
    if (kind == Boundaries::Canister) {
        const Canister& can = *c.canister;
        // "the initial position of the lowest particle is higher than the diameter of the coil" (paper)
        double floor = can.flatFloor ? -can.width / 2 : 0.0;
        if (c.world.coil) floor = c.world.coil->radius + c.world.coil->wireRadius;
        floor += particles.number("drop_mm");
        if (particles.has("inside"))
            reader.fault(particles.path("inside"), "stands beside a canister, which holds the powder above its coil",
                         "leave it out, or make the walls of bodies: boundaries = \"none\"");
        particles.know("inside");
        c.filling.region = {{-can.width / 2, floor, 0}, {can.width / 2, kInfinity, can.length}};
        return;
    }
    const auto readBox = [](Section& region) { return Box{region.vector("low"), region.vector("high")}; };
    if (particles.has("inside"))
        readVessel(reader, particles, c);
    else
        c.filling.region = readBox(particles.requiredTable("region"));
    if (particles.has("inside") && particles.has("region")) {
        const Box given = readBox(particles.table("region"));
        c.filling.region = {glm::max(c.filling.region.low, given.low), glm::min(c.filling.region.high, given.high)};
    }
    particles.know("inside");
    particles.know("region");
    if (c.mixed) return;
    for (std::size_t k = 0; k < c.furtherPowders.size(); ++k)
        c.furtherPowders[k].filling.region = readBox(root.item("powder", k).requiredTable("region"));
}

namespace {

/// What says when a refill comes: at most one of three keys.
void readOccasion(CaseReader& reader, Section& s, const Case& c, Refill& refill) {
    if (s.has("time_s")) refill.time = s.number("time_s");
    if (s.has("before_dose")) refill.beforeDose = static_cast<int>(s.integer("before_dose"));
    if (s.has("below_g")) refill.below = s.number("below_g");
    std::string first;
    for (const char* key : {"time_s", "before_dose", "below_g"}) {
        s.know(key);
        if (!s.has(key)) continue;
        if (first.empty())
            first = key;
        else
            reader.fault(s.path(key), first + " is given too", "give one of the two");
    }
    if (refill.beforeDose && c.schedule.rotateTime == 0)
        reader.fault(s.path("before_dose"), "there are no doses", "give time_s, or dose.rotate_s");
}

/// The region that a mark is for.
void readWatched(CaseReader& reader, Section& s, const Case& c, Refill& refill) {
    s.know("region");
    if (!s.has("region")) return;
    refill.watched = readRegionName(reader, s, c);
    if (!refill.below)
        reader.fault(s.path("region"), "is watched for below_g, which is missing", "give below_g too");
    else if (*refill.watched < c.world.regions.size() && c.world.regions[*refill.watched].deletes)
        reader.fault(s.path("region"), "names one that takes the powder away, so that its content never falls",
                     "name a region that counts");
}

/// Adds the refill as often as its table says.
void addTimes(CaseReader& reader, Section& s, const Refill& refill, std::set<std::string>& names, Case& c) {
    for (const char* key : {"every_s", "times"}) s.know(key);
    const double every = s.has("every_s") ? s.number("every_s") : 0;
    const std::int64_t times = s.has("times") ? s.integer("times") : 1;
    if (every > 0 && !refill.time)
        reader.fault(s.path("every_s"), "counts from time_s, which is missing", "give time_s too");
    if (every > 0 && !s.has("times")) reader.fault(s.path("every_s"), "does not say how often", "give times too");
    if (times > 1 && !refill.below && !(refill.time && every > 0))
        reader.fault(s.path("times"), "does not say when the others come", "give below_g, or time_s and every_s");
    for (std::int64_t i = 0; i < times; ++i) {
        Refill& one = c.refills.emplace_back(refill);
        one.again = i > 0;
        if (one.time) *one.time += static_cast<double>(i) * every;
        if (times == 1) continue;
        one.name = fmt::format("{}-{}", refill.name, i + 1);
        if (!names.insert(one.name).second)
            reader.fault(s.path("name"), fmt::format("gives a refill \"{}\", and another has that name", one.name),
                         "give each refill a name of its own");
    }
}

}  // namespace

void readRefills(CaseReader& reader, Section& root, Case& c) {
    std::set<std::string> names;
    std::size_t table = 0;
    for (Section* section : root.tables("refill")) {
        Section& s = *section;
        Refill refill;
        refill.name = readName(reader, s, "refill", names);
        refill.table = table++;
        refill.material = readPowderName(reader, s, c).value_or(kFirstPowder);
        refill.mass = s.number("mass_g");
        readOccasion(reader, s, c, refill);
        readWatched(reader, s, c, refill);
        if (c.filling.list)
            reader.fault(s.path("name"), "the powder is a list, and a refill is drawn from the sizes of its powder",
                         "give particles.mass_g and particles.size in place of particles.list");
        addTimes(reader, s, refill, names, c);
    }
}

void fillAboveDriven(Section& root, Case& c) {
    if (c.filling.list || !c.canister) return;
    double top = -kInfinity;
    for (const RigidBody& body : c.world.bodies)
        if (const auto* turn = std::get_if<geometry::Turn>(&body.course.motion); turn && body.clock == Clock::Drive)
            top = std::max(top, highestOfTurn(trianglesOf(body), turn->axis, turn->through));
    c.filling.region.low.y = std::max(c.filling.region.low.y, top + root.table("particles").number("drop_mm"));
}

}  // namespace vkdose
