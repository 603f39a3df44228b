#include "host/output/run_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <system_error>
#include <utility>

#include "host/core/error.h"
#include "host/core/file.h"
#include "host/output/run_history.h"
#include "host/output/summary.h"

namespace vkdose {

namespace fs = std::filesystem;

namespace {

constexpr std::array kFiles{"case.toml",    "timeseries.csv", "doses.csv",    "particles.csv",
                            "summary.json", "report.html",    kCheckpointName};

constexpr const char* kTimeSeriesHeader =
    "time_s,phase,dose,coil_angle_rad,dosed_mass_kg,canister_mass_kg,throat_mass_kg,lost_mass_kg,"
    "dosed_count,canister_count,throat_count,lost_count,kinetic_energy_J,rotational_energy_J,outlet_velocity_m_s,"
    "coil_torque_Nm,coil_power_W,max_overlap_ratio";

constexpr const char* kEnergyHeader =
    ",full_step_kinetic_J,full_step_rotational_J,potential_J,elastic_normal_J,elastic_sliding_J,elastic_rolling_J,"
    "elastic_torsion_J,loaded_J,coil_work_J,left_J,loss_plastic_J,loss_adhesive_J,loss_viscous_J,loss_sliding_J,"
    "loss_rolling_J,loss_torsion_J,loss_numerical_J,residual_J,momentum_x_kg_m_s,momentum_y_kg_m_s,momentum_z_kg_m_s,"
    "angular_momentum_x_kg_m2_s,angular_momentum_y_kg_m2_s,angular_momentum_z_kg_m2_s";

constexpr const char* kParticlesHeader =
    "id,x_m,y_m,z_m,vx_m_s,vy_m_s,vz_m_s,wx_rad_s,wy_rad_s,wz_rad_s,radius_m,status";

[[noreturn]] void busy(const fs::path& folder) {
    throw FolderError(fmt::format("another vkdose is writing into {}; wait for it or stop it", folder.string()));
}

void refuseBusy(const fs::path& folder) {
    std::error_code error;
    const fs::path file = folder / "timeseries.csv";
    if (fs::exists(file, error) && !CsvFile(file, {fs::file_size(file, error)}).lock()) busy(folder);
}

/// A lock on the run's time series, given up by closing: true if it was to be had. `how`: see flock.
bool tryLock(const fs::path& folder, int how) {
    const int handle = ::open((folder / "timeseries.csv").c_str(), O_RDONLY | O_CLOEXEC);
    if (handle < 0) return true;  // nobody has begun there
    const bool had = ::flock(handle, how) == 0;
    ::close(handle);
    return had;
}

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

void prepareFolder(const fs::path& folder, bool force) {
    std::error_code error;
    if (fs::exists(folder, error) && !fs::is_directory(folder, error)) {
        throw FolderError(fmt::format("{} is a file, not a folder; choose another with --out", folder.string()));
    }
    if (fs::is_directory(folder, error) && !fs::is_empty(folder, error) && !force) {
        const bool former = fs::exists(folder / "summary.json") || fs::exists(folder / "case.toml");
        const bool unfinished = fs::exists(folder / kCheckpointName);
        throw FolderError(fmt::format("{} {}; {}choose another folder with --out, or --force to {}", folder.string(),
                                      unfinished ? "holds an unfinished run"
                                      : former   ? "holds a former run"
                                                 : "is not empty",
                                      unfinished ? fmt::format("go on with `vkdose resume {}`, ", folder.string()) : "",
                                      former ? "replace that run" : "write into it"));
    }
    refuseBusy(folder);
    fs::create_directories(folder, error);
    if (error) throw FolderError(fmt::format("cannot create {}: {}", folder.string(), error.message()));
    // A stale summary beside a new time series would lie if this run is killed.
    for (const char* name : kFiles) fs::remove(folder / name, error);
    FrameWriter::remove(folder);
    if (error) throw FolderError(fmt::format("cannot write in {}: {}", folder.string(), error.message()));
    FieldFiles::remove(folder);
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
    try {
        prepareFolder(folder_, force);
        replaceFile(folder_ / "case.toml", c.resolved);
        const std::string energy = c.world.energyBook ? kEnergyHeader : "";
        timeSeries_.emplace(folder_ / "timeseries.csv", kTimeSeriesHeader + energy);
        doses_.emplace(folder_ / "doses.csv", kDosesHeader);
        if (c.frames.interval > 0) frames_.emplace(folder_, c, member_);
        fields_.emplace(folder_, c);
    } catch (const OutputError& e) {
        throw FolderError(e.what());
    }
    if (!timeSeries_->lock()) busy(folder_);
}

RunFolder::RunFolder(fs::path folder, const Checkpoint& from, const Case& c, std::string backend)
    : folder_(std::move(folder)),
      backend_(std::move(backend)),
      caseText_(c.resolved),
      member_(from.member),
      checkpointTime_(from.time) {
    try {
        refuseBusy(folder_);
        if (!fs::exists(folder_ / "case.toml")) replaceFile(folder_ / "case.toml", c.resolved);
        timeSeries_.emplace(folder_ / "timeseries.csv", from.timeSeries);
        doses_.emplace(folder_ / "doses.csv", from.doses);
        if (c.frames.interval > 0) frames_.emplace(folder_, c, member_, from.frames);
        fields_.emplace(folder_, c, from.fields);
    } catch (const OutputError& e) {
        throw FolderError(e.what());
    }
    if (!timeSeries_->lock()) busy(folder_);
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

bool isBusy(const fs::path& folder) {
    return !tryLock(folder, LOCK_EX | LOCK_NB);
}

void awaitFree(const fs::path& folder) {
    (void)tryLock(folder, LOCK_EX);
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
