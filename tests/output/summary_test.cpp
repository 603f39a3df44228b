// summary.json: what is told of the doses.
#include "host/output/summary.h"

#include <nlohmann/json.hpp>

#include "host/core/file.h"
#include "host/output/run_folder.h"

#include "tests/sim/fake_backend.h"
#include "tests/support/catch.h"
#include "tests/support/folder.h"
#include "tests/support/near.h"

using namespace vkdose;
using namespace vkdose::test;

TEST_CASE("doses to a mass have the closed form of the turns that they made, not their target") {
    Case c = smallCase();
    RunResult r;
    r.derived.massPerDose = 1e-3;
    const auto told = [&] {
        return nlohmann::json::parse(summaryJson(c, r, "fake"))["closed_form"]["mass_per_dose_kg"];
    };
    CHECK(told() == 1e-3);
    c.schedule.targetMass = 1e-3;  // by which `derive` plans
    CHECK(told().is_null());
    for (const double closedForm : {6e-3, 3e-3, 99e-3}) {
        Dose d;
        d.target = 1e-3;
        d.closedForm = closedForm;
        d.complete = closedForm < 99e-3;
        r.doses.push_back(d);
    }
    CHECK(nearRelative(told().get<double>(), 4.5e-3, 1e-12));
}

TEST_CASE("a run without a closed form tells none, and never zero") {
    Case c = smallCase();
    c.world.coil.reset();
    RunResult r;
    r.doses.emplace_back();
    const auto told = [&] { return nlohmann::json::parse(summaryJson(c, r, "fake")); };
    auto summary = told();
    for (const char* key : {"rate_kg_s", "mass_per_dose_kg", "doses", "push_velocity_m_s", "tip_velocity_m_s"}) {
        CAPTURE(key);
        CHECK(summary.at("closed_form").at(key).is_null());
    }
    CHECK(summary.at("doses").at(0).at("closed_form_mass_kg").is_null());
    CHECK(summary.at("closed_form").at("bodies").empty());
    r.derived.massPerTurn = 1e-3;
    r.derived.conveyors = {"left", "right"};
    r.derived.pushVelocity = 0.02;
    r.derived.doses = 7;
    r.doses[0].closedForm = 2e-3;
    summary = told();
    CHECK(summary.at("closed_form").at("push_velocity_m_s") == 0.02);
    CHECK(summary.at("closed_form").at("doses") == 7);
    CHECK(summary.at("closed_form").at("bodies") == nlohmann::json{"left", "right"});
    CHECK(nearRelative(summary.at("closed_form").at("rate_kg_s").get<double>(), 1e-3 * c.schedule.coilSpeed / (2 * kPi),
                       1e-9));
    CHECK(summary.at("doses").at(0).at("closed_form_mass_kg") == 2e-3);
}

TEST_CASE("the summary has the figures of the mass rate, null where there are none") {
    RunHistory history;
    const auto told = [&] {
        return nlohmann::json::parse(summaryJson(smallCase(), RunResult{}, "fake", history)).at("analysis").at("rate");
    };
    CHECK(told().at("windows") == 0);
    for (const RateFigure& f : kRateFigures) {
        CAPTURE(f.name);
        CHECK(told().at(f.name).is_null());
        if (f.error != nullptr) CHECK(told().contains(f.error));
        CHECK(figureNamed(kRateFigures, kRateName, std::string("rate.") + f.name) == &f);
    }
    CHECK(figureNamed(kRateFigures, kRateName, "rate.colour") == nullptr);
    history.rate.window = 0.5;
    history.rate.windows = {{1, 1.5, 2e-3}, {1.5, 2, 3e-3}};
    history.rate.all = {2.5e-3, 1e-4, 0.25};
    history.rate.steady = 1;
    history.rate.steadyPart = {3e-3, 2e-4, 0.125};
    const nlohmann::json expected{{"windows", 2},        {"window_s", 0.5},         {"mean_kg_s", 2.5e-3},
                                  {"rsd", 0.25},         {"mean_error_kg_s", 1e-4}, {"steady_from_s", 1.5},
                                  {"steady_kg_s", 3e-3}, {"steady_rsd", 0.125},     {"steady_error_kg_s", 2e-4}};
    CHECK(told() == expected);
}

TEST_CASE("the summary has the mass of the cycles, and says what a cycle is, and cycles.csv has each") {
    RunHistory history;
    const auto told = [&] {
        return nlohmann::json::parse(summaryJson(smallCase(), RunResult{}, "fake", history)).at("analysis").at("cycle");
    };
    CHECK(told().at("is").is_null());
    CHECK(told().at("cycles") == 0);
    for (const CycleFigure& f : kCycleFigures) {
        CAPTURE(f.name);
        CHECK(told().at(f.name).is_null());
        if (f.error != nullptr) CHECK(told().contains(f.error));
        CHECK(figureNamed(kCycleFigures, kCycleName, std::string("cycle.") + f.name) == &f);
    }
    history.cycles.what = "turn of the drive";
    history.cycles.list = {{1, 1, 1.5, 2e-3, 0.25}, {2, 1.5, 2, 3e-3, 0.125}};
    history.cycles.all = {2.5e-3, 1e-4, 0.25};
    history.cycles.steady = 1;
    history.cycles.steadyPart = {3e-3, 2e-4, 0.125};
    const nlohmann::json expected{
        {"is", "turn of the drive"}, {"cycles", 2},          {"mean_kg", 2.5e-3}, {"rsd", 0.25},
        {"mean_error_kg", 1e-4},     {"steady_from_s", 1.5}, {"steady_kg", 3e-3}, {"steady_rsd", 0.125},
        {"steady_error_kg", 2e-4}};
    CHECK(told() == expected);

    const Folder folder;
    const auto file = folder / kCyclesName;
    writeCycles(file, history.cycles);
    CHECK(fileContent(file) ==
          "cycle,start_time_s,end_time_s,mass_kg,left_kg\n1,1,1.5,0.002,0.25\n2,1.5,2,0.003,0.125\n");
    writeCycles(file, {});
    CHECK_FALSE(std::filesystem::exists(file));
}
