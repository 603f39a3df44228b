#include "host/output/run_folder.h"

#include <fmt/format.h>

#include <cmath>
#include <system_error>
#include <utility>

#include "host/core/error.h"
#include "host/core/file.h"
#include "host/core/printable.h"
#include "host/model/powders.h"
#include "host/output/particle_row.h"
#include "host/output/run_files.h"
#include "host/output/run_history.h"
#include "host/output/summary.h"

namespace vkdose {

namespace fs = std::filesystem;

namespace {

/// The reason for not writing into a folder that is not empty.
std::string occupied(const fs::path& folder) {
    const bool unfinished = fs::exists(folder / kCheckpointName), run = holdsRun(folder);
    return fmt::format("{} {}; {}choose another folder with --out{}", folder.string(),
                       unfinished ? "holds an unfinished run"
                       : run      ? "holds a former run"
                                  : "is not empty and holds no run of vkdose",
                       unfinished ? fmt::format("go on with `vkdose resume {}`, ", shellWord(folder.string())) : "",
                       run ? ", or --force to replace that run" : "");
}

/// Whether the folder holds nothing but this case. A sweep prepares the folder of a member like this.
bool isPrepared(const fs::path& folder, const Case& c) {
    for (const auto& entry : fs::directory_iterator(folder))
        if (entry.path().stem() != "case" && entry.path().stem() != "case.toml") return false;
    return fileContent(folder / "case.toml") == c.resolved;
}

/// The files that a new run removes. A case.toml that already holds this case stays, because the run may be read from
/// it.
std::vector<fs::path> replacedIn(const fs::path& folder, const Case& c) {
    std::vector<fs::path> files = filesOfRun(folder);
    if (fileContent(folder / "case.toml") == c.resolved) std::erase(files, folder / "case.toml");
    return files;
}

/// Refuses the folder if the new run would lose a file that belongs to no run, or one that the case is read from.
void requireNothingLost(const fs::path& folder, bool force, const Case& c) {
    std::error_code code;
    if (fs::is_empty(folder, code)) return;
    if (!force || !(holdsRun(folder) || isPrepared(folder, c))) throw FolderError(occupied(folder));
    if (const auto file = readAndWritten(c.files, replacedIn(folder, c)))
        throw FolderError(
            fmt::format("the case is read from {}, which the run would replace; choose another folder "
                        "with --out",
                        file->string()));
}

/// The folders that must be made for `folder`; `folder` itself comes first.
std::vector<fs::path> missingFolders(fs::path folder) {
    std::error_code code;
    std::vector<fs::path> missing;
    for (; !folder.empty() && !fs::exists(folder, code); folder = folder.parent_path()) missing.push_back(folder);
    return missing;
}

void makeFolder(const fs::path& folder) {
    std::error_code error;
    if (fs::exists(folder, error) && !fs::is_directory(folder, error))
        throw FolderError(fmt::format("{} is a file, not a folder; choose another with --out", folder.string()));
    fs::create_directories(folder, error);
    const std::string fault = fmt::format("cannot create {}: {}", folder.string(), error.message());
    if (error == std::errc::no_space_on_device) throw OutputError(fault);
    if (error) throw FolderError(fault);
}

}  // namespace

namespace {

/// The columns of the bodies, each named by its body.
template <class Columns>
std::string bodyHeader(const Columns& columns, const World& world) {
    std::string header;
    for (const std::string& body : loadNames(world))
        forEachColumn(columns, [&](const auto& c) { header += fmt::format(",{}.{}", body, c.name); });
    return header;
}

/// The columns of the bodies that move freely, likewise.
std::string freeHeader(const World& world) {
    std::string header;
    for (const RigidBody& body : world.bodies) {
        const auto name = [&](const auto& c) { header += fmt::format(",{}.{}", body.name, c.name); };
        if (body.movesFreely()) forEachColumn(kFreeBodyColumns, name);
        if (body.hinge() != nullptr) forEachColumn(kHingedBodyColumns, name);
    }
    return header;
}

/// The columns of the regions, likewise.
template <class Columns>
std::string regionHeader(const Columns& columns, const World& world) {
    std::string header;
    for (const CountRegion& region : world.regions)
        forEachColumn(columns, [&](const auto& c) { header += fmt::format(",{}.{}", region.name, c.name); });
    return header;
}

/// The columns of the powders, likewise; none with one powder.
template <class Columns>
std::string powderHeader(const Case& c, const Columns& columns) {
    std::string header;
    if (c.furtherPowders.empty()) return header;
    for (const PowderOf& powder : powdersOf(c))
        forEachColumn(columns, [&](const auto& column) { header += fmt::format(",{}.{}", powder.name, column.name); });
    return header;
}

/// The cells of the rows, with a comma before each.
template <class Columns, class R>
std::string cellsOf(const Columns& columns, const std::vector<R>& rows) {
    std::string cells;
    for (const R& row : rows) cells += "," + csvRow(columns, row);
    return cells;
}

}  // namespace

RunFolder::RunFolder(fs::path folder, bool force, const Case& c, std::string backend, RunRole role)
    : folder_(std::move(folder)),
      backend_(std::move(backend)),
      caseText_(c.resolved),
      given_(c.given),
      role_(std::move(role)),
      repeats_(c.world.repeats()) {
    const std::vector<fs::path> made = missingFolders(folder_);
    makeFolder(folder_);
    lock_.emplace(lockRun(folder_));
    requireNothingLost(folder_, force, c);
    const bool hadCase = fileContent(folder_ / "case.toml") == c.resolved;
    try {
        removeRun(folder_, replacedIn(folder_, c));  // a stale summary would mislead if this run is killed
        const std::string energy = c.world.energyBook ? "," + csvHeader(kEnergyColumns) : "";
        const std::string through = repeats_ ? "," + csvHeader(kThroughColumns) : "";
        timeSeries_.emplace(folder_ / "timeseries.csv", csvHeader(kSampleColumns) + energy + through +
                                                            bodyHeader(kBodyColumns, c.world) + freeHeader(c.world) +
                                                            regionHeader(kRegionSampleColumns, c.world) +
                                                            powderHeader(c, kPowderColumns));
        if (!hadCase) replaceFile(folder_ / "case.toml", c.resolved);
        doses_.emplace(folder_ / "doses.csv", csvHeader(kDoseColumns) + bodyHeader(kDoseBodyColumns, c.world) +
                                                  regionHeader(kRegionColumns, c.world) +
                                                  powderHeader(c, kPowderDoseColumns));
        if (c.frames.interval > 0) frames_.emplace(folder_, c, role_.member);
        fields_.emplace(folder_, c);
    } catch (const OutputError&) {
        removeRun(folder_, hadCase ? replacedIn(folder_, c) : filesOfRun(folder_));
        for (const fs::path& ours : made) removeEmptyFolder(ours);
        throw;
    }
}

RunFolder::RunFolder(fs::path folder, FolderLock lock, const Checkpoint& from, const Case& c, std::string backend)
    : folder_(std::move(folder)),
      lock_(std::move(lock)),
      backend_(std::move(backend)),
      caseText_(c.resolved),
      given_(from.given),
      role_{from.member, from.keepsStates, from.origin},
      repeats_(c.world.repeats()),
      checkpointTime_(from.time) {
    try {
        if (!fs::exists(folder_ / "case.toml")) replaceFile(folder_ / "case.toml", c.resolved);
        timeSeries_.emplace(folder_ / "timeseries.csv", from.timeSeries);
        doses_.emplace(folder_ / "doses.csv", from.doses);
        if (c.frames.interval > 0) frames_.emplace(folder_, c, role_.member, from.frames);
        fields_.emplace(folder_, c, from.fields);
    } catch (const OutputError& e) {
        throw FolderError(e.what());
    }
}

void RunFolder::onSample(const Sample& s) {
    std::string line = csvRow(kSampleColumns, s) + (s.energy ? "," + csvRow(kEnergyColumns, *s.energy) : "");
    if (repeats_) line += "," + csvRow(kThroughColumns, s.sensors);
    line += cellsOf(kBodyColumns, s.bodies);
    for (const FreePlace& place : s.free) {
        line += "," + csvRow(kFreeBodyColumns, place);
        if (place.hinged) line += "," + csvRow(kHingedBodyColumns, place);
    }
    line += cellsOf(kRegionSampleColumns, s.regions) + cellsOf(kPowderColumns, s.powders);
    timeSeries_->line(line);
    timeSeries_->flush();
}

void RunFolder::onDose(const Dose& d) {
    doses_->line(csvRow(kDoseColumns, d) + cellsOf(kDoseBodyColumns, d.bodies) + cellsOf(kRegionColumns, d.regions) +
                 cellsOf(kPowderDoseColumns, d.powders));
    doses_->flush();
}

void RunFolder::store(const fs::path& name, const RunCheckpoint& state, double time) {
    // The lines come first, because the state counts on them.
    const CsvMark timeSeries = timeSeries_->store(), doses = doses_->store();
    const CsvMark frames = frames_ ? frames_->store() : CsvMark();
    writeCheckpoint(folder_ / name, {VKDOSE_VERSION, backend_, caseText_, time, state, timeSeries, doses, frames,
                                     fields_->store(), role_.member, given_, role_.origin, role_.keepsStates});
}

void RunFolder::onCheckpoint(const RunCheckpoint& checkpoint, double time) {
    store(kCheckpointName, checkpoint, time);
    checkpointTime_ = time;
}

void RunFolder::onState(KeptState kind, const RunCheckpoint& state, double time) {
    if (kind != KeptState::Frame)
        store(kind == KeptState::Settled ? kSettledName : kEndName, state, time);
    else if (frames_)
        store(fs::path(kFramesFolder) / frameStateFile(frames_->last()), state, time);
}

void RunFolder::storeTables() {
    timeSeries_->store();
    doses_->store();
    if (frames_) frames_->store();
    fields_->store();
}

void RunFolder::finish(const Case& c, const RunResult& result) {
    storeTables();
    if (result.endState)
        writeParticles(folder_ / "particles.csv", result.particles, powderNames(c), c.world.properties);
    RunHistory history = historyOf(folder_, c, result);
    writeCycles(folder_ / kCyclesName, history.cycles);
    history.origin = role_.origin;
    replaceFile(folder_ / "summary.json", summaryJson(c, result, backend_, history) + "\n");
    // Whoever removed the folder while these two were written has removed the tables by now, or the case, and is told.
    storeTables();
    if (!fs::exists(folder_ / "case.toml"))
        throw OutputError(fmt::format("{} has been removed or moved away", (folder_ / "case.toml").string()));
    if (result.reason == StopReason::Interrupted || !result.error.empty()) return;
    std::error_code ignored;
    fs::remove(folder_ / kCheckpointName, ignored);
    checkpointTime_.reset();
}

std::vector<std::string> powderNames(const Case& c) {
    std::vector<std::string> names;
    if (c.furtherPowders.empty()) return names;
    names.resize(c.world.materials.size());
    for (const PowderOf& powder : powdersOf(c)) names[std::size_t(powder.material)] = powder.name;
    return names;
}

void writeParticles(const fs::path& file, const Particles& p, const std::vector<std::string>& powders,
                    const std::vector<std::string>& properties) {
    std::string header = csvHeader(kParticleColumns) + (powders.empty() ? "" : ",powder");
    for (const std::string& name : properties) header += "," + name;
    CsvFile csv(file, header);
    for (std::size_t i = 0; i < p.size(); ++i) {
        const ParticleRow row{i, p.position[i], p.velocity[i], p.spin[i], p.radius[i], p.status[i]};
        std::string line = csvRow(kParticleColumns, row) + (powders.empty() ? "" : "," + powders.at(p.material[i]));
        for (std::size_t k = 0; k < properties.size(); ++k) line += fmt::format(",{:.17g}", p.properties.at(i)[k]);
        csv.line(line);
    }
    csv.flush();
}

void writeCycles(const fs::path& file, const Cycles& cycles) {
    std::error_code none;
    if (cycles.list.empty()) {  // there may be one of the run before it went on
        fs::remove(file, none);
        return;
    }
    CsvFile csv(file, csvHeader(kCycleColumns));
    for (const CycleMass& cycle : cycles.list) csv.line(csvRow(kCycleColumns, cycle));
    csv.flush();
}

FolderLock lockRun(const fs::path& folder) {
    try {
        if (std::optional<FolderLock> lock = FolderLock::take(folder)) return *std::move(lock);
    } catch (const OutputError& e) {
        throw FolderError(e.what());
    }
    throw FolderError(fmt::format("another vkdose is writing into {}; wait for it or stop it", folder.string()));
}

}  // namespace vkdose
