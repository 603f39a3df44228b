// From a case file to a Case: read the tables, check them, work out what follows from them.
#include "host/model/case.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "host/core/number.h"
#include "host/core/printable.h"
#include "host/model/bed_weight.h"
#include "host/model/case_keys.h"
#include "host/model/case_reader.h"
#include "host/model/case_sections.h"
#include "host/model/checks.h"
#include "host/model/parse_toml.h"
#include "host/model/powder_file.h"
#include "host/model/powders.h"
#include "host/model/shared_places.h"
#include "host/model/size_distribution.h"
#include "host/model/stability.h"
#include "host/model/user_law_trial.h"

namespace vkdose {
namespace {

SizeRange sizeRange(const Case& c) {
    return overall(powderSizes(c));
}

/// The largest distance from a centre at which a backend asks for a mesh: within the skin and the longest reach of a
/// contact [m]. The factor covers the rounding of a skin that is read back.
double meshReach(const Case& c, double contactReach) {
    const SizeRange sizes = sizeRange(c);
    const double skin = c.world.skin > 0 ? c.world.skin : kUsualSkin * sizes.mean;
    return (sizes.largest + contactReach + skin) * (1 + 1e-12);
}

/// Makes meshes anew that were read for a shorter reach, because the law was not known yet.
void widenMeshes(Case& c) {
    const double largest = sizeRange(c).largest;
    const double reach = meshReach(
        c, std::max(longestReach(c.world, c.settlingLaw, largest), longestReach(c.world, c.dosingLaw, largest)));
    for (RigidBody& body : c.world.bodies)
        for (geometry::Shape& shape : body.shapes)
            if (auto* mesh = std::get_if<std::shared_ptr<const geometry::MeshSurface>>(&shape))
                if ((*mesh)->reach() < reach)
                    *mesh = std::make_shared<const geometry::MeshSurface>((*mesh)->mesh(), reach);
}

/// The name becomes the name of a folder and is written into the summary, which is UTF-8. It has to be checked even by
/// default: then it is the name of the case file, which may be anything.
void checkName(CaseReader& reader, const std::string& name) {
    constexpr std::size_t kLongestName = 200;
    const std::string shown = name.substr(0, kLongestName);
    if (printable(name) != name)
        reader.fault("name", fmt::format("\"{}\" is no name for a folder: it holds what cannot be seen", shown),
                     "give a name of characters that show");
    else if (name.empty() || name == "." || name == ".." || name.size() > kLongestName ||
             name.find('/') != std::string::npos)
        reader.fault("name", fmt::format("\"{}\" is no name for a folder", shown), "give a short name without slashes");
    else if (name.front() == ' ' || name.back() == ' ')
        reader.fault("name", fmt::format("\"{}\" is no name for a folder: it begins or ends with a blank", shown),
                     "leave the blank out");
}

void completeTime(Section& time, Case& c, const SizeRange& sizes) {
    const auto modes = modesOf(c, powderSizes(c));
    if (c.world.timeStep == 0) {
        // Three digits are enough and read better in the resolved case.
        const double exact = automaticTimeStep(modes, c.stepsPerContact);
        const double unit = std::pow(10.0, std::floor(std::log10(exact)) - 2);
        c.world.timeStep = nearestDecimal(std::floor(exact / unit) * unit, 3);
        time.record("step_s", c.world.timeStep);
    }
    if (c.world.skin == 0) c.world.skin = time.number("skin_mm", kUsualSkin * sizes.mean * 1e3);
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

/// Refuses a study. It has the shape of a case, so that without this check every key of it would be reported as
/// unknown.
void refuseStudy(const Node& tree) {
    for (const char* name : {"axis", "calibrate", "design", "set"}) {
        const Node* node = tree.child(name);
        if (node == nullptr || (node->kind != Node::Kind::Array && node->kind != Node::Kind::Table)) continue;
        throw CaseError({{node->file, node->line, "", "", "this is a study, not a case",
                          "give it to `vkdose sweep`, or name its base case here"}});
    }
}

/// A number, or "measure".
void readBulkDensity(Section& root, Case& c) {
    c.bulkDensityMeasured = root.isString("bulk_density");
    if (c.bulkDensityMeasured)
        root.onlyWord("bulk_density");
    else
        c.bulkDensity = root.number("bulk_density");
    if (root.has("derived")) (void)root.string("derived");
    root.know("derived");
    root.forget("derived");
}

/// The estimate that stands for a measured bulk density until the bed has settled.
void estimateBulkDensity(Section& root, Case& c) {
    if (!c.bulkDensityMeasured) return;
    c.bulkDensity = kBedFraction * solidDensity(c);
    if (!(c.bulkDensity > 0)) return;  // the density is at fault
    const std::string words = fmt::format(
        "bulk_density = {:.4g} kg/m3, {} of the particles' density, until the bed has settled; then its own",
        c.bulkDensity, kBedFraction);
    root.record("derived", words);
    c.derivations.push_back(words);
}

void checkBulkDensity(CaseReader& reader, const Case& c) {
    if (!c.bulkDensityMeasured) return;
    if (!c.canister)
        reader.fault("bulk_density", "is measured in a canister, and there is none",
                     "give a number, or add a [[measure]] of kind \"bulk_density\"");
    else if (c.schedule.settleTime == 0)
        reader.fault("bulk_density", "is measured when the bed has settled, and it does not settle",
                     "give a number, or settle.time_s");
}

Case interpret(const std::filesystem::path& file, Node tree, std::vector<std::filesystem::path> files) {
    refuseStudy(tree);
    CaseReader reader(file.string(), std::move(tree), caseKeys());
    Section& root = reader.root();
    Case c;
    c.files = std::move(files);
    c.name = root.string("name", file.stem().string());
    if (!root.has("name") || root.isString("name")) checkName(reader, c.name);
    c.reason = root.string("reason");
    (void)root.string("accepted_warnings");  // host/advice takes it from the resolved case
    c.seed = static_cast<std::uint64_t>(root.integer("seed"));
    c.world.gravity = root.vector("gravity");
    readBulkDensity(root, c);
    readParticles(reader, root, c);
    const MaterialTables materials = readMaterials(reader, root, c);
    readList(reader, root, c);
    estimateBulkDensity(root, c);
    placeContact(reader, root, c);
    const std::optional<Boundaries> kind = readBoundaries(reader, root, c);
    readCoil(reader, root, c);
    readTime(reader, root, c);
    readBodies(reader, root, reader.faulty() ? std::numeric_limits<double>::quiet_NaN() : meshReach(c, 0), c);
    alignWithDrive(c);
    readRegions(reader, root, c);
    readContact(reader, root, materials, c);
    readRegion(reader, root, kind, c);
    if (!reader.faulty()) fillAboveDriven(root, c);
    readSchedule(reader, root, c);
    readRefills(reader, root, c);
    checkBulkDensity(reader, c);
    readFields(reader, root, reader.faulty() ? std::numeric_limits<double>::quiet_NaN() : 2 * sizeRange(c).mean, c);
    readMeasures(reader, root, c);
    const bool domainGiven = readDomain(root, c);
    reader.finish();
    checkFields(reader, c);
    reader.throwIfFaulty();

    // The powder is checked before the times: a size or a density in a wrong unit leads to absurd time steps, and the
    // message must blame the powder for them.
    findVessel(reader, root.table("particles"), c);
    reader.throwIfFaulty();
    const SizeRange sizes = sizeRange(c);
    checkFilling(reader, c, sizes.largest);
    reader.throwIfFaulty();
    tryUserLaw(reader, c, powderSizes(c));
    reader.throwIfFaulty();
    widenMeshes(c);
    completeTime(root.table("time"), c, sizes);
    checkTimeStep(reader, c, powderSizes(c));
    checkScales(reader, c, sizes);
    reader.throwIfFaulty();
    checkTouches(reader, c, sizes.largest);
    checkPeriod(reader, c, sizes);
    reader.throwIfFaulty();

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
        root.table("domain").record("low", c.world.domain.low);
        root.table("domain").record("high", c.world.domain.high);
        root.table("domain").record("periodic", std::string("none"));
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
    c.resolved = reader.resolved();
    (void)parseToml(c.resolved, "the case with all its defaults");  // or a run could not go on from its folder
    return c;
}

/// Interprets a case and keeps it as it was given.
Case interpretKept(const std::filesystem::path& file, Node tree, std::vector<std::filesystem::path> files) {
    std::string given = treeText(tree);
    const bool named = tree.child("name") != nullptr;
    Case c = interpret(file, std::move(tree), std::move(files));
    c.given = named ? std::move(given) : fmt::format("name = {}\n{}", tomlString(c.name), given);
    return c;
}

}  // namespace

Case loadCase(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
    return loadVariant(file, {overrideTree(overrides)});
}

Case loadVariant(const std::filesystem::path& file, std::vector<Node> layers) {
    std::vector<std::filesystem::path> files;
    Node tree = readTree(file, files);
    for (Node& layer : layers) layOver(tree, std::move(layer), files);
    return interpretKept(file, std::move(tree), std::move(files));
}

Case loadResolvedCase(const std::string& text, const std::filesystem::path& file,
                      const std::vector<std::string>& overrides) {
    std::vector<std::filesystem::path> files{file};
    Node tree;
    layOver(tree, readTreeText(text, file.string()), files);
    layOver(tree, overrideTree(overrides), files);
    return interpretKept(file, std::move(tree), std::move(files));
}

}  // namespace vkdose
