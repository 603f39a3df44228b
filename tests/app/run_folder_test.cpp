#include "host/output/run_folder.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <thread>

#include "host/app/end_table.h"
#include "host/output/end_state.h"
#include "host/output/frames.h"
#include "host/output/summary.h"
#include "host/sim/run_record.h"
#include "tests/app/sandbox.h"
#include "tests/sim/fake_backend.h"
#include "tests/support/catch.h"

using namespace vkdose;
using namespace vkdose::test;
namespace fs = std::filesystem;

namespace {

RunResult runInto(RunFolder& folder, FakeBackend& backend, const Case& c) {
    const std::atomic<bool> stop{false};
    Derived derived;
    derived.massPerDose = 2e-3;
    RunResult r = runFilled(c, smallFilling(), derived, backend, folder, stop);
    folder.finish(c, r);
    return r;
}

std::size_t column(const std::vector<std::vector<std::string>>& rows, const std::string& name) {
    const auto& header = rows.at(0);
    const auto found = std::find(header.begin(), header.end(), name);
    if (found == header.end()) throw std::logic_error("no column " + name);
    return static_cast<std::size_t>(found - header.begin());
}

}  // namespace

TEST_CASE("the folder of a run parses back to what was computed") {
    const Sandbox box;
    Case c = smallCase();
    c.resolved = "name = \"fake\"\n";
    FakeBackend backend;
    backend.dosed = [](std::uint64_t s) { return s < 130 ? 0 : s < 200 ? 2 : 5; };
    backend.torque = [](std::uint64_t) { return -0.25; };
    RunFolder folder(box / "out", false, c, "fake");
    const RunResult r = runInto(folder, backend, c);

    CHECK(readText(box / "out/case.toml") == c.resolved);

    const auto series = readCsv(box / "out/timeseries.csv");
    REQUIRE(series.size() == 1 + r.ledger.closings());
    const std::vector<std::string> header{"time_s",
                                          "phase",
                                          "dose",
                                          "coil_angle_rad",
                                          "dosed_mass_kg",
                                          "canister_mass_kg",
                                          "throat_mass_kg",
                                          "lost_mass_kg",
                                          "dosed_count",
                                          "canister_count",
                                          "throat_count",
                                          "lost_count",
                                          "kinetic_energy_J",
                                          "rotational_energy_J",
                                          "outlet_velocity_m_s",
                                          "coil_torque_Nm",
                                          "coil_power_W",
                                          "max_overlap_ratio",
                                          "coil.force_x_N",
                                          "coil.force_y_N",
                                          "coil.force_z_N",
                                          "coil.torque_Nm",
                                          "coil.power_W",
                                          "coil.work_J"};
    CHECK(series[0] == header);
    for (std::size_t i = 1; i < series.size(); ++i) {
        REQUIRE(series[i].size() == header.size());
        const double sum = std::stod(series[i][4]) + std::stod(series[i][5]) + std::stod(series[i][6]);
        CHECK(sum == Approx(0.01));
    }
    const auto& last = series.back();
    CHECK(std::stod(last[0]) == Approx(0.31));
    CHECK(last[1] == "rest");
    CHECK(last[2] == "3");
    CHECK(std::stod(last[3]) == Approx(3 * 4 * 0.05));
    CHECK(std::isnan(std::stod(last[14])));
    CHECK(std::stod(last[15]) == Approx(0.25));

    const auto doses = readCsv(box / "out/doses.csv");
    REQUIRE(doses.size() == 4);
    CHECK(std::stod(doses[1][column(doses, "mass_kg")]) == Approx(2e-3));
    CHECK(std::stod(doses[2][column(doses, "cumulative_mass_kg")]) == Approx(5e-3));
    CHECK(std::stod(doses[2][column(doses, "coil_torque_Nm")]) == Approx(0.25));
    CHECK(std::stod(doses[3][column(doses, "closed_form_mass_kg")]) == Approx(2e-3));
    CHECK(doses[3][column(doses, "complete")] == "1");

    const auto summary = nlohmann::json::parse(readText(box / "out/summary.json"));
    CHECK(summary["backend"] == "fake");
    CHECK(summary["stop_reason"] == "dose_count");
    CHECK(summary["error"].is_null());
    CHECK(summary["doses"].size() == 3);
    // Lines at 0.12, 0.15 (the first grain is out), 0.18, 0.21 (the last), 0.22 s while the coil turns, and from 0.24
    // to 0.29 s in dose 3, in which nothing comes.
    CHECK(summary["outlet"]["first_mass_after_rotation_s"].get<double>() == Approx(0.05));
    CHECK(summary["outlet"]["longest_stop_s"].get<double>() == Approx(0.06));
    CHECK(summary["outlet"]["longest_stop_turns"].get<double>() == Approx(0.06 * 4 / (2 * kPi)));
    CHECK(summary["outlet"]["longest_stop_from_s"].get<double>() == Approx(0.21));
    CHECK(summary["outlet"]["longest_stop_from_dose"] == 2);
    CHECK(summary["outlet"]["stopped_at_dose"].is_null());
    CHECK(summary["arches"].empty());  // no frames
    CHECK(summary["doses"][1]["mass_kg"].get<double>() == Approx(3e-3));
    CHECK(summary["dose_statistics"]["mean_kg"].get<double>() == Approx(5e-3 / 3));
    CHECK(summary["dose_statistics"]["rsd"].get<double>() == Approx(r.statistics.relative));
    // 2, 5 and 5 g are out after the doses: a slope of 1.5 g, from doses of 3 and 0 g with equal weights.
    CHECK(summary["analysis"]["beta_kg_per_dose"].get<double>() == Approx(1.5e-3));
    CHECK(summary["analysis"]["beta_standard_error_kg_per_dose"].get<double>() == Approx(1.5e-3));
    CHECK(summary["analysis"]["beta_doses"] == 3);
    CHECK(summary["analysis"]["doses_to_99_percent"].is_null());
    CHECK(summary["analysis"]["blocked_at_dose"].is_null());
    CHECK_THAT(reportText(c, r, "fake"), Catch::Contains("beta     1.500 g/dose +- 1.500, the slope over 3 doses"));
    // The fake has one contact, of a particle with itself: two radii deep.
    CHECK(summary["settled"]["time_s"].get<double>() == Approx(0.1));
    CHECK(summary["settled"]["pairs"] == 1);
    CHECK(summary["settled"]["coordination"].get<double>() == Approx(0.2));
    CHECK(summary["settled"]["overlap_ratio"]["median"].get<double>() == Approx(2));
    CHECK(summary["settled"]["bulk_density_kg_m3"].is_null());
    CHECK(summary["ledger"]["dosed_count"] == 5);
    CHECK(summary["ledger"]["lost_count"] == 0);
    CHECK(summary["ledger"]["closings"] == r.ledger.closings());
    CHECK(summary["closed_form"]["mass_per_dose_kg"].get<double>() == Approx(2e-3));
    CHECK(summary["particle_steps"].get<double>() == Approx(r.particleSteps));
    CHECK(summary["inputs"]["particles"] == 10);
}

TEST_CASE("with an energy book the time series has its columns, and they add up to the residual") {
    const Sandbox box;
    Case c = smallCase();
    c.world.energyBook = true;
    FakeBackend backend;
    backend.spoil = [](std::uint64_t step, Sensors& s) {
        EnergyBook b;
        double next = 1e-3;
        for (double EnergyBook::*term :
             {&EnergyBook::kinetic, &EnergyBook::rotational, &EnergyBook::potential, &EnergyBook::elasticNormal,
              &EnergyBook::elasticSliding, &EnergyBook::elasticRolling, &EnergyBook::elasticTorsion,
              &EnergyBook::plastic, &EnergyBook::adhesive, &EnergyBook::viscous, &EnergyBook::sliding,
              &EnergyBook::rolling, &EnergyBook::torsion, &EnergyBook::numerical, &EnergyBook::left,
              &EnergyBook::coilWork, &EnergyBook::loaded}) {
            b.*term = next;
            next *= 2;
        }
        b.momentum = Vec3(1, 2, 3);
        b.angularMomentum = Vec3(4, 5, static_cast<double>(step));
        s.energy = b;
    };
    RunFolder folder(box / "out", false, c, "fake");
    const RunResult r = runInto(folder, backend, c);

    const auto series = readCsv(box / "out/timeseries.csv");
    const auto& last = series.back();
    REQUIRE(last.size() == series[0].size());
    const auto value = [&](const char* name) { return std::stod(last[column(series, name)]); };
    double closing = value("loaded_J") + value("coil_work_J") - value("left_J");
    for (const char* name :
         {"full_step_kinetic_J", "full_step_rotational_J", "potential_J", "elastic_normal_J", "elastic_sliding_J",
          "elastic_rolling_J", "elastic_torsion_J", "loss_plastic_J", "loss_adhesive_J", "loss_viscous_J",
          "loss_sliding_J", "loss_rolling_J", "loss_torsion_J", "loss_numerical_J"})
        closing -= value(name);
    CHECK(closing == Approx(value("residual_J")));
    CHECK(value("potential_J") == Approx(4e-3));
    CHECK(value("loss_plastic_J") == Approx(0.128 * static_cast<double>(backend.calls.size())));
    CHECK(value("momentum_y_kg_m_s") == 2);
    CHECK(value("angular_momentum_z_kg_m2_s") == static_cast<double>(backend.step));

    const auto summary = nlohmann::json::parse(readText(box / "out/summary.json"));
    CHECK(summary["energy"]["residual_J"].get<double>() == Approx(value("residual_J")));
    CHECK(summary["energy"]["residual_of_coil_work"].get<double>() ==
          Approx(value("residual_J") / value("coil_work_J")));
    CHECK_THAT(reportText(c, r, "fake"),
               Catch::Contains("energy   coil work") && Catch::Contains("of the coil's work"));
}

TEST_CASE("particles are written with every digit") {
    const Sandbox box;
    Particles p;
    p.add(Vec3(0.1, 1.0 / 3, -2.5e-9), 1.25e-3, Vec3(1e-17, -0.1, 3), Vec3(7, 8.000000000000002, 9));
    p.add(Vec3(0, 0, 0), 1e-3);
    p.status[1] = Status::Dosed;
    writeParticles(box / "p.csv", p);
    const auto rows = readCsv(box / "p.csv");
    REQUIRE(rows.size() == 3);
    const std::vector<std::string> header{"id",     "x_m",      "y_m",      "z_m",      "vx_m_s",   "vy_m_s",
                                          "vz_m_s", "wx_rad_s", "wy_rad_s", "wz_rad_s", "radius_m", "status"};
    CHECK(rows[0] == header);
    CHECK(std::stod(rows[1][1]) == p.position[0].x);
    CHECK(std::stod(rows[1][2]) == p.position[0].y);
    CHECK(std::stod(rows[1][3]) == p.position[0].z);
    CHECK(std::stod(rows[1][4]) == p.velocity[0].x);
    CHECK(std::stod(rows[1][8]) == p.spin[0].y);
    CHECK(std::stod(rows[1][10]) == p.radius[0]);
    CHECK(rows[1][11] == "active");
    CHECK(rows[2][11] == "dosed");
    CHECK(rows[2][0] == "1");
}

TEST_CASE("the time series can be read while the run goes on") {
    const Sandbox box;
    RunFolder folder(box / "out", false, smallCase(), "fake");
    folder.onSample(Sample{});
    CHECK(readCsv(box / "out/timeseries.csv").size() == 2);
    folder.onDose(Dose{});
    CHECK(readCsv(box / "out/doses.csv").size() == 2);
}

TEST_CASE("a folder that holds something is refused, a former run replaced only by force") {
    const Sandbox box;
    const Case c = smallCase();
    FakeBackend backend;
    {
        RunFolder folder(box / "out", false, c, "fake");
        runInto(folder, backend, c);
    }
    box.write("out/mine.txt", "keep");
    const std::string before = readText(box / "out/timeseries.csv");
    CHECK_THROWS_WITH(RunFolder(box / "out", false, c, "fake"),
                      Catch::Contains("former run") && Catch::Contains("--force"));
    CHECK(readText(box / "out/timeseries.csv") == before);
    RunFolder again(box / "out", true, c, "fake");
    CHECK_FALSE(fs::exists(box / "out/summary.json"));  // a stale one would lie
    CHECK_FALSE(fs::exists(box / "out/particles.csv"));
    CHECK(readCsv(box / "out/timeseries.csv").size() == 1);
    CHECK(readText(box / "out/mine.txt") == "keep");

    fs::create_directories(box / "other");
    box.write("other/thesis.txt", "x");
    CHECK_THROWS_WITH(RunFolder(box / "other", false, c, "fake"), Catch::Contains("not empty"));
    fs::create_directories(box / "empty");
    CHECK_NOTHROW(RunFolder(box / "empty", false, c, "fake"));
    CHECK_THROWS_AS(RunFolder(box / "other/thesis.txt", true, c, "fake"), FolderError);
    CHECK_THROWS_AS(RunFolder(box / "other/thesis.txt/below", true, c, "fake"), FolderError);
}

TEST_CASE("a failed run is summed up as such") {
    const Sandbox box;
    const Case c = smallCase();
    FakeBackend backend;
    backend.runErrorAt = 120;
    RunFolder folder(box / "out", false, c, "fake");
    runInto(folder, backend, c);
    const auto summary = nlohmann::json::parse(readText(box / "out/summary.json"));
    CHECK(summary["stop_reason"] == "run_error");
    CHECK_THAT(summary["error"].get<std::string>(), Catch::Contains("particle 3"));
    CHECK(summary["dose_statistics"]["mean_kg"].is_null());
    CHECK(summary["doses"][0]["complete"] == false);
}

TEST_CASE("a time series that cannot be written stops the run with a reason") {
    REQUIRE(fs::exists("/dev/full"));  // stands in for a full disk
    CHECK_THROWS_AS(CsvFile("/dev/full", "header"), OutputError);
}

TEST_CASE("a table that is removed while the last files of a run are written is told") {
    const Case c = smallCase();
    const std::string name = GENERATE("doses.csv", "case.toml");
    for (bool conclusive = false; !conclusive;) {
        const Sandbox box;
        FakeBackend backend;
        RunFolder folder(box / "out", false, c, "fake");
        RunResult r = runInto(folder, backend, c);
        fs::remove(box / "out/summary.json");
        fs::remove(box / "out/particles.csv");
        for (int i = 0; i < 100000; ++i) r.particles.add({1e-3 * i, 0, 0}, 1e-3);  // takes a while to write
        std::thread vandal([&] {
            while (!fs::exists(box / "out/particles.csv")) std::this_thread::yield();
            fs::remove(box / "out" / name);
            conclusive = !fs::exists(box / "out/summary.json");  // or it came too late
        });
        std::string told;
        try {
            folder.finish(c, r);
        } catch (const OutputError& e) {
            told = e.what();
        }
        vandal.join();
        if (conclusive) CHECK_THAT(told, Catch::Contains(name) && Catch::Contains("removed or moved away"));
    }
}

TEST_CASE("figures that are not numbers become null in the summary") {
    RunResult r;
    r.last.coilAngle = std::numeric_limits<double>::quiet_NaN();
    r.derived.doses = std::numeric_limits<double>::infinity();
    const auto summary = nlohmann::json::parse(summaryJson(smallCase(), r, "fake"));
    CHECK(summary["coil_angle_rad"].is_null());
    CHECK(summary["closed_form"]["doses"].is_null());
}

TEST_CASE("the angle of the coil is the same in every file of a run, whatever its hand") {
    for (const int hand : {-1, 1}) {
        CAPTURE(hand);
        const Sandbox box;
        Case c = smallCase();
        c.world.coil->hand = hand;
        c.frames.interval = 0.03;
        c.checkpoint.wall = 0;
        c.checkpoint.simulated = 0.001;
        c.schedule.stop.maxDoses = 1;
        c.resolved = "name = \"fake\"\n";
        FakeBackend backend;
        backend.spoil = [&](std::uint64_t step, Sensors&) { backend.runErrorAt = step >= 150 ? 150 : 1000; };
        RunFolder folder(box / "out", false, c, "fake");
        const RunResult r = runInto(folder, backend, c);  // fails at rest, so that the checkpoint stays
        REQUIRE(r.reason == StopReason::RunError);

        const double turned = -hand * 4 * 0.05;  // a right-handed coil conveys clockwise
        CHECK(r.last.coilAngle == Approx(turned));
        const auto series = readCsv(box / "out/timeseries.csv");
        CHECK(std::stod(series.back()[column(series, "coil_angle_rad")]) == Approx(turned));
        const auto summary = nlohmann::json::parse(readText(box / "out/summary.json"));
        CHECK(summary["coil_angle_rad"].get<double>() == Approx(turned));
        const Frames frames(box / "out");
        REQUIRE(frames.entries().back().step == 150);
        CHECK(frames.entries().back().coilAngle == Approx(turned));
        CHECK(frames.read(frames.entries().back()).coilAngle == Approx(turned));
        const Checkpoint checkpoint = readCheckpoint(box / "out/checkpoint.h5");
        CHECK(checkpoint.run.backend.one<double>("angle") == Approx(turned));
        Sample last;
        get(checkpoint.run.run, "last", last);
        CHECK(last.coilAngle == Approx(turned));
        CHECK(readEndState(box / "out", c).coilAngle == Approx(turned));
    }
}
