#include "host/output/run_folder.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <system_error>
#include <utility>

#include "host/core/error.h"
#include "host/output/summary.h"

namespace vkdose {

namespace fs = std::filesystem;

namespace {

constexpr std::array kFiles{"case.toml", "timeseries.csv", "doses.csv", "particles.csv", "summary.json"};

constexpr const char* kTimeSeriesHeader =
    "time_s,phase,dose,coil_angle_rad,dosed_mass_kg,canister_mass_kg,throat_mass_kg,lost_mass_kg,"
    "dosed_count,canister_count,throat_count,lost_count,kinetic_energy_J,rotational_energy_J,outlet_velocity_m_s,"
    "coil_torque_Nm,coil_power_W,max_overlap_ratio";

constexpr const char* kEnergyHeader =
    ",full_step_kinetic_J,full_step_rotational_J,potential_J,elastic_normal_J,elastic_sliding_J,elastic_rolling_J,"
    "elastic_torsion_J,loaded_J,coil_work_J,left_J,loss_plastic_J,loss_adhesive_J,loss_viscous_J,loss_sliding_J,"
    "loss_rolling_J,loss_torsion_J,loss_numerical_J,residual_J,momentum_x_kg_m_s,momentum_y_kg_m_s,momentum_z_kg_m_s,"
    "angular_momentum_x_kg_m2_s,angular_momentum_y_kg_m2_s,angular_momentum_z_kg_m2_s";

constexpr const char* kDosesHeader =
    "dose,start_time_s,mass_kg,cumulative_mass_kg,particles,coil_torque_Nm,closed_form_mass_kg,complete";

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

void prepareFolder(const fs::path& folder, bool force) {
    std::error_code error;
    if (fs::exists(folder, error) && !fs::is_directory(folder, error)) {
        throw FolderError(fmt::format("{} is a file, not a folder; choose another with --out", folder.string()));
    }
    if (fs::is_directory(folder, error) && !fs::is_empty(folder, error) && !force) {
        const bool former = fs::exists(folder / "summary.json") || fs::exists(folder / "case.toml");
        throw FolderError(fmt::format("{} {}; choose another folder with --out, or --force to {}", folder.string(),
                                      former ? "holds a former run" : "is not empty",
                                      former ? "replace that run" : "write into it"));
    }
    fs::create_directories(folder, error);
    if (error) throw FolderError(fmt::format("cannot create {}: {}", folder.string(), error.message()));
    // A stale summary beside a new time series would lie if this run is killed.
    for (const char* name : kFiles) fs::remove(folder / name, error);
    if (error) throw FolderError(fmt::format("cannot write in {}: {}", folder.string(), error.message()));
}

void writeText(const fs::path& file, const std::string& text) {
    std::ofstream stream(file);
    stream << text;
    stream.flush();
    if (!stream) throw RunError(fmt::format("cannot write {}: is the disk full or the folder gone?", file.string()));
}

double mass(const Sensors& s, Region r) {
    return s.mass[static_cast<std::size_t>(r)];
}
std::uint64_t count(const Sensors& s, Region r) {
    return s.count[static_cast<std::size_t>(r)];
}

}  // namespace

RunFolder::RunFolder(fs::path folder, bool force, const Case& c) : folder_(std::move(folder)) {
    prepareFolder(folder_, force);
    try {
        writeText(folder_ / "case.toml", c.resolved);
        const std::string energy = c.world.energyBook ? kEnergyHeader : "";
        timeSeries_.emplace(folder_ / "timeseries.csv", kTimeSeriesHeader + energy);
        doses_.emplace(folder_ / "doses.csv", kDosesHeader);
    } catch (const RunError& e) {
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

void RunFolder::finish(const Case& c, const RunResult& result, const std::string& backend) {
    if (result.endState) writeParticles(folder_ / "particles.csv", result.particles);
    writeText(folder_ / "summary.json", summaryJson(c, result, backend) + "\n");
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
