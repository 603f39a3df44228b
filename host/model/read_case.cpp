// A case as its file says it: the tables, one after another.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "host/core/printable.h"
#include "host/model/bed_weight.h"
#include "host/model/case_sections.h"
#include "host/model/checks.h"
#include "host/model/powders.h"
#include "host/model/stability.h"

namespace vkdose {
namespace {

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

void add(std::vector<std::filesystem::path>& files, const std::vector<std::filesystem::path>& more) {
    files.insert(files.end(), more.begin(), more.end());
}

}  // namespace

double meshReach(const Case& c, std::optional<double> skin, double contactReach) {
    const SizeRange sizes = overall(powderSizes(c));
    return (sizes.largest + contactReach + skin.value_or(kUsualSkin * sizes.mean)) * (1 + 1e-12);
}

CaseRead readCase(CaseReader& reader, const std::filesystem::path& file) {
    Section& root = reader.root();
    CaseRead read;
    Case& c = read.c;
    c.name = root.string("name", file.stem().string());
    if (!root.has("name") || root.isString("name")) checkName(reader, c.name);
    c.reason = root.string("reason");
    (void)root.string("accepted_warnings");  // host/advice takes it from the resolved case
    c.seed = static_cast<std::uint64_t>(root.integer("seed"));
    c.world.gravity = root.vector("gravity");
    readBulkDensity(root, c);
    const PowdersRead powders = readPowders(reader, root);
    c.world.materials = powders.materials;
    c.filling = powders.filling;
    c.furtherPowders = powders.further;
    c.mixed = powders.mixed;
    c.derivations = powders.told.derivations;
    add(c.files, powders.told.files);
    estimateBulkDensity(root, c);
    placeContact(reader, root, c.world);
    const WallsRead walls = readBoundaries(reader, root, c.world.materials);
    c.canister = walls.canister;
    c.world.walls = walls.walls;
    c.world.throatZ = walls.throatZ;
    c.world.outletZ = walls.outletZ;
    const CoilRead coil = readCoil(reader, root, c.canister);
    c.world.coil = coil.coil;
    c.world.coilSurfaceMoves = coil.surfaceMoves;
    c.world.coilWireCurved = coil.wireCurved;
    const TimeRead& time = read.time = readTime(reader, root);
    c.stepsPerContact = time.stepsPerContact;
    BodiesRead bodies = readBodies(reader, root, c.world.materials,
                                   reader.faulty() ? std::nullopt : std::optional(meshReach(c, time.skin, 0)));
    c.world.bodies = std::move(bodies.bodies);
    c.mendedMeshes = std::move(bodies.mended);
    add(c.files, bodies.files);
    alignWithDrive(c.world.coil, c.world.bodies);
    c.world.regions = readRegions(reader, root, c.world.bodies);
    // A region that deletes stands in the place of the plane behind the throat.
    if (std::any_of(c.world.regions.begin(), c.world.regions.end(), [](const CountRegion& r) { return r.deletes; }))
        c.world.outletZ = kInfinity;
    readContact(reader, root, powders.tables, c);
    const StartRead start = readStart(reader, root, powders, walls, c.world.coil, c.world.bodies);
    c.filling.region = start.region;
    c.filling.vessel = start.vessel;
    for (std::size_t k = 0; k < start.further.size(); ++k) c.furtherPowders[k].filling.region = start.further[k];
    const ScheduleRead run = readSchedule(reader, root, walls, coil, c.world.bodies);
    c.schedule = run.schedule;
    c.sensorInterval = run.sensorInterval;
    c.rateWindow = run.rateWindow;
    c.world.energyBook = run.energyBook;
    c.world.wallLoads = run.wallLoads;
    c.frames = run.frames;
    c.checkpoint = run.checkpoint;
    c.refills = readRefills(reader, root, powders, c.world.regions, c.schedule);
    checkBulkDensity(reader, c);
    c.fields = readFields(reader, root, powders.named(), c.canister, c.sensorInterval,
                          reader.faulty() ? std::nullopt : std::optional(2 * overall(powderSizes(c)).mean));
    c.measures = readMeasures(reader, root, c.world, c.frames);
    read.domain = readDomain(root);
    if (read.domain) {
        c.world.domain = read.domain->box;
        c.world.period = read.domain->period;
    }
    return read;
}

}  // namespace vkdose
