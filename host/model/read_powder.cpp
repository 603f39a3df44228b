// The sizes of a powder, and where it starts.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/model/body_form.h"
#include "host/model/case_sections.h"
#include "host/model/free_sites.h"
#include "host/model/size_distribution.h"

namespace vkdose {
namespace {

/// Says what number distribution the sieves make. An older text, in a resolved case, gives way to it.
void recordDerivation(Section& section, const SizeDistribution& size, Told& told) {
    if (section.has("derived")) (void)section.string("derived");
    section.know("derived");
    if (size.sieve.empty() || !(size.radiusMin < size.radiusMax)) return;  // told elsewhere
    const std::string words = sieveDerivation(size);
    section.record("derived", words);
    told.derivations.push_back(fmt::format("{}: {}", section.path(), words));
}

}  // namespace

SizeDistribution readSize(CaseReader& reader, Section& section, Told& told) {
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
            readSieve(reader, section, size, told.files);
            boundsOfSpheres(size.sieve.empty() ? kNaN : finestRadius(size),
                            size.sieve.empty() ? kNaN : coarsestRadius(size));
            recordDerivation(section, size, told);
            break;
    }
    return size;
}

namespace {

/// The bodies that the powder starts inside of, and the box around them.
void readVessel(CaseReader& reader, Section& particles, const std::vector<RigidBody>& bodies, StartRead& start) {
    const std::string text = particles.string("inside");
    if (!particles.isString("inside")) return;
    for (const std::string& name : wordsOf(text))
        if (const auto body = placeOfBody(reader, particles.path("inside"), name, bodies))
            start.vessel.push_back(*body);
    if (wordsOf(text).empty())
        reader.fault(particles.path("inside"), "names no body", "give the name of the [[body]] that holds the powder");
    start.region = boxAround(bodies, start.vessel);
    const bool bounded = glm::all(glm::lessThan(start.region.low, start.region.high));
    if (start.vessel.empty() || bounded) return;
    if (!particles.has("region"))
        reader.fault(particles.path("inside"), "names only bodies without an end", "add [particles.region] as a bound");
    start.region = {Vec3(-kInfinity), Vec3(kInfinity)};
}

/// The highest point that a body which follows the drive comes to [m].
double topOfDriven(const std::vector<RigidBody>& bodies) {
    double top = -kInfinity;
    for (const RigidBody& body : bodies)
        if (const auto* turn = std::get_if<geometry::Turn>(&body.course.motion); turn && body.clock == Clock::Drive)
            top = std::max(top, highestOfTurn(trianglesOf(body), turn->axis, turn->through));
    return top;
}

Box readCanisterRegion(CaseReader& reader, Section& particles, const Canister& can,
                       const std::optional<geometry::Coil>& coil, const std::vector<RigidBody>& bodies) {
    // "the initial position of the lowest particle is higher than the diameter of the coil" (paper)
    double floor = can.flatFloor ? -can.width / 2 : 0.0;
    if (coil) floor = coil->radius + coil->wireRadius;
    const double drop = particles.number("drop_mm");
    if (particles.has("inside"))
        reader.fault(particles.path("inside"), "stands beside a canister, which holds the powder above its coil",
                     "leave it out, or make the walls of bodies: boundaries = \"none\"");
    particles.know("inside");
    floor += drop;
    if (!reader.faulty()) floor = std::max(floor, topOfDriven(bodies) + drop);
    return {{-can.width / 2, floor, 0}, {can.width / 2, kInfinity, can.length}};
}

}  // namespace

StartRead readStart(CaseReader& reader, Section& root, const PowdersRead& powders, const WallsRead& walls,
                    const std::optional<geometry::Coil>& coil, const std::vector<RigidBody>& bodies) {
    Section& particles = root.table("particles");
    StartRead start;
    if (!walls.kind)
        for (const char* key : {"region", "drop_mm", "inside"}) particles.know(key);
    if (!walls.kind || powders.filling.list) return start;
    if (walls.kind == Boundaries::Canister) {
        start.region = readCanisterRegion(reader, particles, *walls.canister, coil, bodies);
        return start;
    }
    const auto readBox = [](Section& region) { return Box{region.vector("low"), region.vector("high")}; };
    if (particles.has("inside"))
        readVessel(reader, particles, bodies, start);
    else
        start.region = readBox(particles.requiredTable("region"));
    if (particles.has("inside") && particles.has("region")) {
        const Box given = readBox(particles.table("region"));
        start.region = {glm::max(start.region.low, given.low), glm::min(start.region.high, given.high)};
    }
    particles.know("inside");
    particles.know("region");
    if (powders.mixed) return start;
    for (std::size_t k = 0; k < powders.further.size(); ++k)
        start.further.push_back(readBox(root.item("powder", k).requiredTable("region")));
    return start;
}

}  // namespace vkdose
