#include "host/study/calibration_aim.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "host/analysis/balance.h"
#include "host/analysis/beta.h"
#include "host/core/error.h"
#include "host/model/case_reader.h"
#include "host/model/named_file.h"

namespace vkdose {

namespace {

/// Sets the target and, unless given, the tolerance from the readings of a balance.
void readMeasured(CaseReader& reader, const std::filesystem::path& file, CalibrationAim& aim) {
    constexpr const char* kPath = "calibrate.measured";
    constexpr const char* kRemedy = "give a CSV with the columns dose and mass_g, or dose and cumulative_g";
    if (!requireFile(reader, kPath, file, kRemedy)) return;
    try {
        const std::vector<double> cumulative = readBalance(file).cumulative;
        const Slope slope = betaOf(cumulative, beforeSaturation(cumulative.empty() ? 0 : cumulative.back()));
        if (slope.doses < 3 || !(slope.beta > 0)) {
            reader.fault(kPath, "there are too few doses before saturation for a slope", "measure at least three");
            return;
        }
        aim.target = slope.beta;
        if (aim.tolerance > 0) return;
        aim.tolerance = slope.standardError;
        constexpr double kRounding = 1e-9;  // equal doses scatter by no more than this share of their mass
        if (!(aim.tolerance > kRounding * slope.beta))
            reader.fault("calibrate.tolerance_g", "is missing, and the balance's doses are too equal to give one",
                         "give the tolerance, the balance's resolution at least");
    } catch (const CaseError& error) {
        Diagnostic fault = error.faults().at(0);
        const std::string remedy = std::exchange(fault.remedy, "");
        reader.fault(kPath, fault.text(), remedy);
    }
}

FreeParameter readParameter(CaseReader& reader, Section& table, const std::string& path) {
    FreeParameter p;
    p.key = table.string("key");
    p.low = table.number("low");
    p.high = table.number("high");
    if (p.low >= p.high) reader.fault(path + ".high", "is not above low", "give bounds with low < high");
    return p;
}

/// The figure that a target or a goal is of, and the case whose run gives it.
CalibrationTarget readFigure(CaseReader& reader, Section& table, const std::string& path,
                             const std::filesystem::path& folder, const std::filesystem::path& base) {
    CalibrationTarget t;
    t.figure = table.string("figure");
    if (table.isString("figure")) {
        t.line = table.node("figure")->line;
        if (t.figure != kMassPerDose && std::count(t.figure.begin(), t.figure.end(), '.') != 1)
            reader.fault(
                path + ".figure", "is no figure of a run",
                fmt::format("give \"{}\", or a measure of the case and its figure: \"heap.angle_deg\"", kMassPerDose));
    }
    t.base = base;
    if (table.isString("base")) {
        t.base = folder / table.string("base");
        requireFile(reader, path + ".base", t.base, "give the path of a case file, relative to the study's folder");
    } else if (table.has("base")) {
        (void)table.string("base");
    }
    table.know("base");
    return t;
}

CalibrationTarget readTarget(CaseReader& reader, Section& table, const std::string& path,
                             const std::filesystem::path& folder, const std::filesystem::path& base) {
    CalibrationTarget t = readFigure(reader, table, path, folder, base);
    t.value = table.number("value");
    t.uncertainty = table.number("uncertainty");
    t.weight = table.number("weight");
    return t;
}

CalibrationTarget readGoal(CaseReader& reader, Section& table, const std::string& path,
                           const std::filesystem::path& folder, const std::filesystem::path& base) {
    CalibrationTarget t = readFigure(reader, table, path, folder, base);
    t.wish = static_cast<CalibrationTarget::Wish>(table.choice("wish").value_or(0));
    if (table.has("at_least")) t.atLeast = table.number("at_least");
    if (table.has("at_most")) t.atMost = table.number("at_most");
    for (const char* key : {"at_least", "at_most"}) table.know(key);
    if (t.wish == CalibrationTarget::Wish::None && !table.has("at_least") && !table.has("at_most"))
        reader.fault(path + ".wish", "asks nothing of the figure", "give \"largest\" or \"smallest\", or a bound");
    if (t.atLeast > t.atMost)
        reader.fault(path + ".at_most", "is below at_least", "give bounds with at_least < at_most");
    return t;
}

/// The free parameters of a search, in the tables [[TABLE.parameter]].
void readParameters(CaseReader& reader, Section& table, CalibrationAim& aim) {
    const std::string path = fmt::format("{}.parameter", aim.table());
    const std::vector<Section*> parameters = table.tables("parameter");
    for (std::size_t i = 0; i < parameters.size(); ++i)
        aim.parameters.push_back(readParameter(reader, *parameters[i], fmt::format("{}[{}]", path, i)));
    if (parameters.empty() || parameters.size() > 4)
        reader.fault(path, "a search has one to four free parameters",
                     fmt::format("add [[{}]] with key, low and high", path));
}

/// Reads [[calibrate.target]] in place of the mass per dose alone.
void readTargets(CaseReader& reader, Section& table, const std::filesystem::path& folder,
                 const std::filesystem::path& base, CalibrationAim& aim) {
    const std::vector<Section*> targets = table.tables("target");
    for (const char* key : {"target_g_per_dose", "tolerance_g", "measured"}) {
        if (table.has(key))
            reader.fault(fmt::format("calibrate.{}", key), "stands beside [[calibrate.target]]",
                         fmt::format("give the mass per dose as a target with figure = \"{}\"", kMassPerDose));
        table.know(key);
    }
    for (std::size_t i = 0; i < targets.size(); ++i)
        aim.targets.push_back(readTarget(reader, *targets[i], fmt::format("calibrate.target[{}]", i), folder, base));
    if (targets.size() > kMostTargets)
        reader.fault("calibrate.target", fmt::format("there are {}", targets.size()),
                     fmt::format("give at most {}", kMostTargets));
    if (aim.method == CalibrationAim::Method::Grid)
        reader.fault("calibrate.target", "a grid meets a mass per dose alone",
                     "write method = \"surrogate\" with [[calibrate.parameter]], or give target_g_per_dose");
}

/// Reads the measured mass per dose and its error.
void readMassPerDose(CaseReader& reader, Section& table, const std::filesystem::path& folder, CalibrationAim& aim) {
    const bool measured = table.has("measured");
    if (!measured || table.has("tolerance_g")) aim.tolerance = table.number("tolerance_g");
    if (!measured) {
        aim.target = table.number("target_g_per_dose");
        table.know("measured");
        return;
    }
    if (table.has("target_g_per_dose"))
        reader.fault("calibrate.target_g_per_dose", "the target is measured", "give this or measured, not both");
    table.know("target_g_per_dose");
    const std::string file = table.string("measured");
    if (!table.isString("measured")) return;
    aim.measured = folder / file;
    readMeasured(reader, aim.measured, aim);
}

}  // namespace

std::string CalibrationAim::nameOf(const CalibrationTarget& of) const {
    const bool shared = std::any_of(targets.begin(), targets.end(), [&](const CalibrationTarget& other) {
        return other.figure == of.figure && other.base != of.base;
    });
    return shared ? of.figure + " of " + of.base.filename().string() : of.figure;
}

std::vector<std::filesystem::path> CalibrationAim::bases() const {
    std::vector<std::filesystem::path> all;
    for (const CalibrationTarget& t : targets)
        if (std::find(all.begin(), all.end(), t.base) == all.end()) all.push_back(t.base);
    return all;
}

CalibrationAim readCalibrationAim(CaseReader& reader, Section& table, const std::filesystem::path& folder,
                                  const std::filesystem::path& base) {
    CalibrationAim aim;
    const bool search = table.choice("method") == std::size_t{1};
    aim.method = search ? CalibrationAim::Method::Surrogate : CalibrationAim::Method::Grid;
    if (table.has("target")) {
        readTargets(reader, table, folder, base, aim);
    } else {
        table.know("target");
        readMassPerDose(reader, table, folder, aim);
    }
    aim.confirmingSeeds = int(table.integer("confirming_seeds"));
    if (search) {
        aim.maxRuns = int(table.integer("max_runs"));
        table.know("first_points");
        if (table.has("first_points")) aim.firstPoints = int(table.integer("first_points"));
        if (aim.firstPoints > aim.maxRuns)
            reader.fault("calibrate.first_points", "is more than max_runs", "give a larger max_runs, or fewer");
        readParameters(reader, table, aim);
    } else {
        aim.along = table.string("along");
    }
    return aim;
}

CalibrationAim readDesignAim(CaseReader& reader, Section& table, const std::filesystem::path& folder,
                             const std::filesystem::path& base) {
    CalibrationAim aim;
    aim.method = CalibrationAim::Method::Design;
    aim.maxRuns = int(table.integer("max_runs"));
    aim.confirmingSeeds = int(table.integer("confirming_seeds"));
    const std::vector<Section*> goals = table.tables("goal");
    for (std::size_t i = 0; i < goals.size(); ++i)
        aim.targets.push_back(readGoal(reader, *goals[i], fmt::format("design.goal[{}]", i), folder, base));
    const bool wished = std::any_of(aim.targets.begin(), aim.targets.end(),
                                    [](const CalibrationTarget& t) { return t.wish != CalibrationTarget::Wish::None; });
    if (!wished || goals.size() > kMostTargets)
        reader.fault("design.goal",
                     fmt::format("a design has one to {} goals, and wishes at least one to be the "
                                 "largest or the smallest",
                                 kMostTargets),
                     "add [[design.goal]] with figure and wish");
    readParameters(reader, table, aim);
    return aim;
}

}  // namespace vkdose
