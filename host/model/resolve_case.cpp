// What follows from a case as its file says it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "host/core/number.h"
#include "host/model/case_sections.h"
#include "host/model/checks.h"
#include "host/model/shared_places.h"
#include "host/model/stability.h"
#include "host/model/user_law_trial.h"

namespace vkdose {
namespace {

/// Makes meshes anew that were read for a shorter reach, because the law was not known yet.
void widenMeshes(Case& c, std::optional<double> skin, double largest) {
    const double reach = meshReach(
        c, skin, std::max(longestReach(c.world, c.settlingLaw, largest), longestReach(c.world, c.dosingLaw, largest)));
    for (RigidBody& body : c.world.bodies)
        for (geometry::Shape& shape : body.shapes)
            if (auto* mesh = std::get_if<std::shared_ptr<const geometry::MeshSurface>>(&shape))
                if ((*mesh)->reach() < reach)
                    *mesh = std::make_shared<const geometry::MeshSurface>((*mesh)->mesh(), reach);
}

void completeTime(Section& time, const TimeRead& given, Case& c, const PowderSizes& powders) {
    const auto modes = modesOf(c, powders);
    if (given.step) {
        c.world.timeStep = *given.step;
    } else {
        // Three digits are enough and read better in the resolved case.
        const double exact = automaticTimeStep(modes, c.stepsPerContact);
        const double unit = std::pow(10.0, std::floor(std::log10(exact)) - 2);
        c.world.timeStep = nearestDecimal(std::floor(exact / unit) * unit, 3);
        time.record("step_s", c.world.timeStep);
    }
    c.world.skin = given.skin ? *given.skin : time.number("skin_mm", kUsualSkin * overall(powders).mean * 1e3);
    const double steps = std::max(1.0, std::round(c.sensorInterval / c.world.timeStep));
    c.sensorInterval = steps * c.world.timeStep;
    if (c.frames.interval > 0)
        c.frames.interval = std::max(1.0, std::round(c.frames.interval / c.sensorInterval)) * c.sensorInterval;
}

/// Height of the canister's top, or of the fill where that is higher [m, y].
double canisterTop(const Canister& can, const Insertion& filled) {
    return std::max(can.height - can.width / 2, filled.fillHeight);
}

/// The domain of a case that states none: the canister up to the top of the grid, or the box around the particles with
/// a margin of at least ten diameters.
Box defaultDomain(const Case& c, const SizeRange& sizes, const Insertion& filled) {
    const double diameter = 2 * sizes.largest;
    double above = 0;                                        // the grids of refills stand on the powder
    for (std::size_t k = 0; k < filled.waiting.size(); ++k)  // the powder fell below a mark before the next one came
        if (!c.refills[k].below || !c.refills[k].again) above += filled.waiting[k].height;
    if (c.canister) {
        const Canister& can = *c.canister;
        const double half = can.width / 2;
        return {Vec3(-half, -half, 0) - diameter,
                Vec3(half, canisterTop(can, filled) + above, can.length + can.throatLength) + diameter};
    }
    Box box{Vec3(kInfinity), Vec3(-kInfinity)};
    for (std::size_t i = 0; i < filled.particles.size(); ++i) {
        box.low = glm::min(box.low, filled.particles.position[i] - filled.particles.radius[i]);
        box.high = glm::max(box.high, filled.particles.position[i] + filled.particles.radius[i]);
    }
    const Vec3 size = box.high - box.low;
    const double margin = std::max({10 * diameter, size.x, size.y, size.z});
    return {box.low - margin, box.high + margin + Vec3(0, above, 0)};
}

/// What the particles at the start tell: the lid of a canister, the domain, the places that bodies share.
void resolveStart(CaseReader& reader, bool domainGiven, Case& c, const SizeRange& sizes) {
    const Insertion filled = insertParticles(c);
    checkRefills(reader, c, filled);
    if (c.canister && c.canister->lid) {
        const geometry::Plane lid{{0, canisterTop(*c.canister, filled), 0}, {0, -1, 0}};
        auto& walls = c.world.walls;
        const int material = walls.back().material;                 // of all walls the same
        walls.insert(walls.end() - 1, Wall(lid, "lid", material));  // the front wall stays the last (world.h)
    }
    if (!domainGiven) {
        c.world.domain = defaultDomain(c, sizes, filled);
        Section& domain = reader.root().table("domain");
        domain.record("low", c.world.domain.low);
        domain.record("high", c.world.domain.high);
        domain.record("periodic", std::string("none"));
    }
    checkExtent(reader, c, sizes.smallest, domainGiven || !c.filling.list ? "domain" : "particles.list");
    reader.throwIfFaulty();
    checkSurfaces(reader, c, sizes.smallest);
    checkPlacement(reader, c, filled.particles);
    if (!reader.faulty()) {
        c.sharedPlaces = sharedPlaces(c, filled.particles, sizes.smallest);
        checkBodies(reader, c);
    }
    checkRows(reader, c, filled.particles, sizes);
    reader.throwIfFaulty();
}

}  // namespace

Case resolveCase(CaseReader& reader, CaseRead read) {
    Case& c = read.c;
    // The powder is checked before the times: a size or a density in a wrong unit leads to absurd time steps, and the
    // message must blame the powder for them.
    findVessel(reader, reader.root().table("particles"), c);
    reader.throwIfFaulty();
    const PowderSizes powders = powderSizes(c);
    const SizeRange sizes = overall(powders);
    checkFilling(reader, c, sizes.largest);
    reader.throwIfFaulty();
    tryUserLaw(reader, c, powders);
    reader.throwIfFaulty();
    widenMeshes(c, read.time.skin, sizes.largest);
    completeTime(reader.root().table("time"), read.time, c, powders);
    checkTimeStep(reader, c, powders);
    checkScales(reader, c, sizes);
    reader.throwIfFaulty();
    checkTouches(reader, c, sizes.largest);
    checkPeriod(reader, c, sizes);
    reader.throwIfFaulty();
    resolveStart(reader, read.domain.has_value(), c, sizes);
    return std::move(read.c);
}
}  // namespace vkdose
