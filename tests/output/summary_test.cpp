// summary.json: what is told of the doses.
#include "host/output/summary.h"

#include <nlohmann/json.hpp>

#include "tests/sim/fake_backend.h"
#include "tests/support/catch.h"
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
    for (const char* key : {"mass_per_dose_kg", "doses", "push_velocity_m_s", "tip_velocity_m_s"}) {
        CAPTURE(key);
        CHECK(summary.at("closed_form").at(key).is_null());
    }
    CHECK(summary.at("doses").at(0).at("closed_form_mass_kg").is_null());
    r.derived.massPerTurn = 1e-3;
    r.derived.pushVelocity = 0.02;
    r.derived.doses = 7;
    r.doses[0].closedForm = 2e-3;
    summary = told();
    CHECK(summary.at("closed_form").at("push_velocity_m_s") == 0.02);
    CHECK(summary.at("closed_form").at("doses") == 7);
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
        CHECK(rateFigureNamed(std::string("rate.") + f.name) == &f);
    }
    CHECK(rateFigureNamed("rate.colour") == nullptr);
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
