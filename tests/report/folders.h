#pragma once
// Folders of a run and of a sweep, written by hand with figures that are easy to follow.

#include <fmt/format.h>

#include <cmath>

#include "host/model/case.h"
#include "host/study/calibration_file.h"
#include "tests/app/sandbox.h"

namespace vkdose::test {

inline constexpr const char* kSeriesHeader =
    "time_s,phase,dose,coil_angle_rad,dosed_mass_kg,canister_mass_kg,throat_mass_kg,lost_mass_kg,dosed_count,"
    "canister_count,throat_count,lost_count,kinetic_energy_J,rotational_energy_J,outlet_velocity_m_s,coil_torque_Nm,"
    "coil_power_W,max_overlap_ratio\n";

inline const std::string kDosesHeader =
    "dose,start_time_s,mass_kg,cumulative_mass_kg,particles,coil_torque_Nm,closed_form_mass_kg,complete,"
    "target_mass_kg,stop_mass_kg,overshoot_kg,rotation_s,stopped_by,end_time_s\n";

/// Rows of a doses.csv that end at `complete`, with the rest of doses for a time.
inline std::string dosesRows(const std::string& rows) {
    std::string whole;
    for (const char c : rows) whole += c == '\n' ? ",0,nan,nan,nan,none,nan\n" : std::string(1, c);
    return whole;
}

/// The table of them. `before` is the header of columns before those of a dose.
inline std::string dosesTable(const std::string& rows, const std::string& before = "") {
    return before + kDosesHeader + dosesRows(rows);
}

/// A run of cases/mini.toml with this reason: 6 g filled, doses of 1.5, 2 and 1.75 g, and one that was cut off. The
/// coil makes half a turn a dose at 2 mN m.
inline std::filesystem::path writeRun(const Sandbox& box, const std::string& reason, const std::string& name = "run") {
    std::filesystem::create_directories(box / name);
    const Case c = loadCase(VKDOSE_SOURCE_DIR "/cases/mini.toml", {"reason=" + reason});
    box.write(name + "/case.toml", c.resolved);
    box.write(name + "/doses.csv", dosesTable("1,0.1,0.0015,0.0015,9,0.002,0.0016,1\n"
                                              "2,0.4,0.002,0.0035,12,0.002,0.0016,1\n"
                                              "3,0.7,0.00175,0.00525,10,0.002,0.0016,1\n"
                                              "4,1.0,0.000123456789,0.005373456789,1,0.002,0.0016,0\n"));
    std::string series = kSeriesHeader;
    series += "0.1,settle,0,0,0,0.006,0,0,0,36,0,0,0,0,nan,0,0,0.01\n";
    series += "0.3,rotate,1,3.14159265,0.0015,0.004,0.0005,0,9,24,3,0,0,0,0.012,0.002,0.03,0.05\n";
    series += "0.4,rest,1,3.14159265,0.0015,0.004,0.0005,0,9,24,3,0,0,0,-0.001,0.001,0,0.02\n";
    series += "0.6,rotate,2,6.2831853,0.0035,0.002,0.0005,0,21,12,3,0,0,0,0.018,0.002,0.03,0.07\n";
    series += "0.7,rest,2,6.2831853,0.0035,0.002,0.0005,0,21,12,3,0,0,0,0,0.001,0,0.02\n";
    box.write(name + "/timeseries.csv", series);
    return box / name;
}

inline constexpr const char* kMembersHeader =
    "member,seed,contact.kc_over_k,contact.friction,status,error,stop_reason,particles,filled_mass_kg,doses,"
    "dosed_mass_kg,mean_dose_kg,sd_dose_kg,rsd,beta_kg_per_dose,beta_standard_error_kg_per_dose,beta_doses,"
    "closed_form_kg_per_dose,doses_to_99_percent,coil_torque_Nm,blocked_at_dose,simulated_time_s,particle_steps,"
    "wall_time_s\n";

inline std::string member(int number, int seed, double kc, double mu, double beta) {
    return fmt::format(
        "{},{},{},{},ok,,dose_count,3234,0.048,2,0.01,0.004,0.0004,0.1,{},0.0001,2,0.0042,12,0.01,,7,1e9,60\n", number,
        seed, kc, mu, beta);
}

/// A sweep over k_c and friction with two seeds; a member of the last point failed. beta falls with both.
inline std::filesystem::path writeSweep(const Sandbox& box) {
    std::filesystem::create_directories(box / "sweep");
    box.write("sweep/study.toml", R"(
name = "k_c against friction"
reason = "which of them decides?"
base = "paper-48g.toml"
seeds = 2
[set]
"dose.rotate_s" = 2.0
[calibrate]
target_g_per_dose = 3.7
[[axis]]
key = "contact.kc_over_k"
values = [0.2, 0.873]
[[axis]]
key = "contact.friction"
values = [0.3, 0.5]
)");
    box.write("sweep/base.toml",
              "[particles]\nmass_g = 48\n[contact]\nkr_over_k = 0.286\n[contact.wall]\nfriction = 0.2\n"
              "[coil]\nturns = 8\nspeed_rpm = 90\n[dose]\nrotate_s = 1\n");
    std::string rows = kMembersHeader;
    rows += member(0, 1, 0.2, 0.3, 4.8e-3) + member(1, 2, 0.2, 0.3, 5.0e-3);
    rows += member(2, 1, 0.2, 0.5, 4.0e-3) + member(3, 2, 0.2, 0.5, 4.2e-3);
    rows += member(4, 1, 0.873, 0.3, 3.8e-3) + member(5, 2, 0.873, 0.3, 4.0e-3);
    rows += member(6, 1, 0.873, 0.5, 3.6e-3);
    rows += "7,2,0.873,0.5,failed,\"particle 3 at (0, 0, 1) \"\"left\"\" the domain\",run_error,,,,,,,,,,,,,,,,,\n";
    box.write("sweep/members.csv", rows);
    std::string doses =
        "0,1,0.2,0.3,1,2,0.004,0.004,300,0.01,0.0042,1\n0,1,0.2,0.3,2,4.5,0.005,0.009,300,0.01,0.0042,1\n";
    doses += "1,2,0.2,0.3,1,2,0.006,0.006,300,0.01,0.0042,1\n1,2,0.2,0.3,2,4.5,0.005,0.011,300,0.01,0.0042,1\n";
    box.write("sweep/doses.csv", dosesTable(doses, "member,seed,contact.kc_over_k,contact.friction,"));
    return box / "sweep";
}

/// Makes a study a search that found: the heap's angle tells the friction, and nothing tells the cohesion. With
/// `compensating` the two are known in their combination alone.
inline void writeSearch(const Sandbox& box, bool compensating = false) {
    std::string study = readText(box / "sweep/study.toml");
    study.replace(study.find("[calibrate]\n"), 12, "[calibrate]\nmethod = \"surrogate\"\n");
    box.write("sweep/study.toml", study);
    CalibrationFinding f;
    f.targets = {{"heap.angle_deg", "", "heap.toml", 24, 0.5, 1, 24.25, 0.2, {2, 0.75, 1.25, 1.5, 0.875}},
                 {"beta", "g", "dose.toml", 3, 0.05, 2, 3.01, 0.02, {2, 0.5, 2.5, 3, -0.25}}};
    f.parameters = {{"contact.friction", 0.1, 0.7, 0.3, {-36, 8}, 0, {0.3125, 0.25, 0.375}},
                    {"contact.kc_over_k", 0, 1, 0.25, {0.5, -0.75}, 1, {0.5, 0.03125, 0.96875}}};
    const double c = compensating ? -0.9375 : 0.125;
    f.fit = {{{1, c}, {c, 1}},
             {{24.25, 0.25}, {3.5, 0.125}},
             {{0.3, 0.75}, {0.31, 0.5}, {0.32, 0.25}},
             2048,
             7,
             0.3125,
             1.00390625,
             640};
    f.points = {{{0.2, 0.5}, {{20, 0.25}, {4, std::nan("")}}}, {{0.3, 0.25}, {{24.5, 0.25}, {3, 0.1}}}};
    f.best = 1;
    f.misfit = 0.375;
    f.confirmingSeeds = {3, 4, 5};
    f.confirmations = {{"contact.friction 0.2, contact.kc_over_k 0.5",
                        {{{20.4, 0.2}, 3, Confirmed::Verdict::Missed}, {{4.1, 0.05}, 3, Confirmed::Verdict::Missed}},
                        false},
                       {"contact.friction 0.3, contact.kc_over_k 0.25",
                        {{{24.1, 0.2}, 3, Confirmed::Verdict::Met}, {{3.02, 0.03}, 3, Confirmed::Verdict::Met}},
                        true}};
    f.met = true;
    writeFinding(box / "sweep", f);
}

}  // namespace vkdose::test
