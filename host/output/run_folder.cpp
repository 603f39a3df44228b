#include "host/output/run_folder.h"

#include <fmt/format.h>

#include <cmath>
#include <system_error>
#include <utility>

#include "host/core/error.h"
#include "host/core/file.h"
#include "host/core/printable.h"
#include "host/output/run_files.h"
#include "host/output/run_history.h"
#include "host/output/summary.h"

namespace vkdose {

namespace fs = std::filesystem;

namespace {

constexpr const char* kTimeSeriesHeader =  // after kTimeSeriesStart
    ",dosed_mass_kg,canister_mass_kg,throat_mass_kg,lost_mass_kg,"
    "dosed_count,canister_count,throat_count,lost_count,kinetic_energy_J,rotational_energy_J,outlet_velocity_m_s,"
    "coil_torque_Nm,coil_power_W,max_overlap_ratio";

constexpr const char* kEnergyHeader =
    ",full_step_kinetic_J,full_step_rotational_J,potential_J,elastic_normal_J,elastic_sliding_J,elastic_rolling_J,"
    "elastic_torsion_J,loaded_J,coil_work_J,left_J,loss_plastic_J,loss_adhesive_J,loss_viscous_J,loss_sliding_J,"
    "loss_rolling_J,loss_torsion_J,loss_numerical_J,residual_J,momentum_x_kg_m_s,momentum_y_kg_m_s,momentum_z_kg_m_s,"
    "angular_momentum_x_kg_m2_s,angular_momentum_y_kg_m2_s,angular_momentum_z_kg_m2_s";

constexpr const char* kParticlesHeader =
    "id,x_m,y_m,z_m,vx_m_s,vy_m_s,vz_m_s,wx_rad_s,wy_rad_s,wz_rad_s,radius_m,status";

std::string energyFields(const EnergyLedger& ledger) {
    const EnergyBook& b = ledger.sum;
    std::string fields;
    for (const double x : {b.kinetic,           b.rotational,
                           b.potential,         b.elasticNormal,
                           b.elasticSliding,    b.elasticRolling,
                           b.elasticTorsion,    b.loaded,
                           b.coilWork,          b.left,
                           b.plastic,           b.adhesive,
                           b.viscous,           b.sliding,
                           b.rolling,           b.torsion,
                           b.numerical,         ledger.residual(),
                           b.momentum.x,        b.momentum.y,
                           b.momentum.z,        b.angularMomentum.x,
                           b.angularMomentum.y, b.angularMomentum.z})
        fields += fmt::format(",{:.9g}", x);
    return fields;
}

/// Why a folder that is not empty is not written into.
std::string occupied(const fs::path& folder) {
    const bool unfinished = fs::exists(folder / kCheckpointName), run = holdsRun(folder);
    return fmt::format("{} {}; {}choose another folder with --out{}", folder.string(),
                       unfinished ? "holds an unfinished run"
                       : run      ? "holds a former run"
                                  : "is not empty and holds no run of vkdose",
                       unfinished ? fmt::format("go on with `vkdose resume {}`, ", shellWord(folder.string())) : "",
                       run ? ", or --force to replace that run" : "");
}

/// Whether the folder holds nothing but this case: a sweep leaves it where a member is to run.
bool isPrepared(const fs::path& folder, const Case& c) {
    for (const auto& entry : fs::directory_iterator(folder))
        if (entry.path().stem() != "case" && entry.path().stem() != "case.toml") return false;
    return fileContent(folder / "case.toml") == c.resolved;
}

/// What a new run removes. A case that is there already stays: it may be what the run is read from.
std::vector<fs::path> replacedIn(const fs::path& folder, const Case& c) {
    std::vector<fs::path> files = filesOfRun(folder);
    if (fileContent(folder / "case.toml") == c.resolved) std::erase(files, folder / "case.toml");
    return files;
}

/// Refuses what would lose a file that is no run's, or that the case is read from.
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

/// The folders that have to be made for `folder`, itself first.
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

double mass(const Sensors& s, Region r) {
    return s.mass[static_cast<std::size_t>(r)];
}
std::uint64_t count(const Sensors& s, Region r) {
    return s.count[static_cast<std::size_t>(r)];
}

}  // namespace

RunFolder::RunFolder(fs::path folder, bool force, const Case& c, std::string backend, std::uint32_t member)
    : folder_(std::move(folder)), backend_(std::move(backend)), caseText_(c.resolved), member_(member) {
    const std::vector<fs::path> made = missingFolders(folder_);
    makeFolder(folder_);
    lock_.emplace(lockRun(folder_));
    requireNothingLost(folder_, force, c);
    const bool hadCase = fileContent(folder_ / "case.toml") == c.resolved;
    try {
        removeRun(folder_, replacedIn(folder_, c));  // a stale summary would lie if this run is killed
        const std::string energy = c.world.energyBook ? kEnergyHeader : "";
        timeSeries_.emplace(folder_ / "timeseries.csv", std::string(kTimeSeriesStart) + kTimeSeriesHeader + energy);
        if (!hadCase) replaceFile(folder_ / "case.toml", c.resolved);
        doses_.emplace(folder_ / "doses.csv", kDosesHeader);
        if (c.frames.interval > 0) frames_.emplace(folder_, c, member_);
        fields_.emplace(folder_, c);
    } catch (const OutputError&) {
        removeRun(folder_, hadCase ? replacedIn(folder_, c) : filesOfRun(folder_));
        std::error_code ignored;
        for (const fs::path& ours : made) fs::remove(ours, ignored);
        throw;
    }
}

RunFolder::RunFolder(fs::path folder, FolderLock lock, const Checkpoint& from, const Case& c, std::string backend)
    : folder_(std::move(folder)),
      lock_(std::move(lock)),
      backend_(std::move(backend)),
      caseText_(c.resolved),
      member_(from.member),
      checkpointTime_(from.time) {
    try {
        if (!fs::exists(folder_ / "case.toml")) replaceFile(folder_ / "case.toml", c.resolved);
        timeSeries_.emplace(folder_ / "timeseries.csv", from.timeSeries);
        doses_.emplace(folder_ / "doses.csv", from.doses);
        if (c.frames.interval > 0) frames_.emplace(folder_, c, member_, from.frames);
        fields_.emplace(folder_, c, from.fields);
    } catch (const OutputError& e) {
        throw FolderError(e.what());
    }
}

void RunFolder::onSample(const Sample& s) {
    const Sensors& v = s.sensors;
    std::string line = fmt::format(
        "{:.9g},{},{},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{},{},{},{},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.6g}", s.time,
        phaseName(s.phase), s.dose, s.coilAngle, mass(v, Region::Dosed), mass(v, Region::Canister),
        mass(v, Region::Throat), mass(v, Region::Lost), count(v, Region::Dosed), count(v, Region::Canister),
        count(v, Region::Throat), count(v, Region::Lost), v.kineticEnergy, v.rotationalEnergy, s.outletVelocity,
        s.coilTorque, s.coilPower, v.maxOverlapRatio);
    if (s.energy) line += energyFields(*s.energy);
    timeSeries_->line(line);
    timeSeries_->flush();
}

void RunFolder::onDose(const Dose& d) {
    doses_->line(fmt::format("{},{:.9g},{:.9g},{:.9g},{},{:.9g},{:.9g},{}", d.index, d.startTime, d.mass, d.cumulative,
                             d.particles, d.coilTorque, d.closedForm, d.complete ? 1 : 0));
    doses_->flush();
}

void RunFolder::onCheckpoint(const RunCheckpoint& checkpoint, double time) {
    // The lines first, then the checkpoint that counts on them.
    const CsvMark timeSeries = timeSeries_->store(), doses = doses_->store();
    const CsvMark frames = frames_ ? frames_->store() : CsvMark();
    writeCheckpoint(folder_ / kCheckpointName, {VKDOSE_VERSION, backend_, caseText_, time, checkpoint, timeSeries,
                                                doses, frames, fields_->store(), member_});
    checkpointTime_ = time;
}

void RunFolder::finish(const Case& c, const RunResult& result) {
    timeSeries_->store();
    doses_->store();
    if (frames_) frames_->store();
    fields_->store();
    if (result.endState) writeParticles(folder_ / "particles.csv", result.particles);
    replaceFile(folder_ / "summary.json", summaryJson(c, result, backend_, historyOf(folder_, c, result)) + "\n");
    if (result.reason == StopReason::Interrupted || !result.error.empty()) return;
    std::error_code ignored;
    fs::remove(folder_ / kCheckpointName, ignored);
    checkpointTime_.reset();
}

void writeParticles(const fs::path& file, const Particles& p) {
    CsvFile csv(file, kParticlesHeader);
    for (std::size_t i = 0; i < p.size(); ++i) {
        const Vec3& x = p.position[i];
        const Vec3& v = p.velocity[i];
        const Vec3& w = p.spin[i];
        csv.line(fmt::format("{},{},{},{},{},{},{},{},{},{},{},{}", i, x.x, x.y, x.z, v.x, v.y, v.z, w.x, w.y, w.z,
                             p.radius[i], statusName(p.status[i])));
    }
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

std::string statusName(Status status) {
    switch (status) {
        case Status::Active:
            return "active";
        case Status::Dosed:
            return "dosed";
        case Status::Lost:
            return "lost";
    }
    return "unknown";
}

}  // namespace vkdose
