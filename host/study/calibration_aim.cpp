#include "host/study/calibration_aim.h"

#include <fmt/format.h>

#include <utility>

#include "host/analysis/balance.h"
#include "host/analysis/beta.h"
#include "host/core/error.h"
#include "host/core/file.h"
#include "host/model/case_reader.h"

namespace vkdose {

namespace {

/// Sets the target and, unless given, the tolerance from the readings of a balance.
void readMeasured(CaseReader& reader, const std::filesystem::path& file, CalibrationAim& aim) {
    constexpr const char* kPath = "calibrate.measured";
    constexpr const char* kRemedy = "give a CSV with the columns dose and mass_g, or dose and cumulative_g";
    if (!inputFile(file)) {
        reader.fault(kPath, unreadable(file), kRemedy);
        return;
    }
    try {
        const std::vector<double> cumulative = readBalance(file).cumulative;
        const Slope slope = betaOf(cumulative, beforeSaturation(cumulative.empty() ? 0 : cumulative.back()));
        if (slope.doses < 3 || !(slope.beta > 0)) {
            reader.fault(kPath, "there are too few doses before saturation for a slope", "measure at least three");
            return;
        }
        aim.target = slope.beta;
        if (aim.tolerance == 0) aim.tolerance = slope.standardError;
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

}  // namespace

CalibrationAim readCalibrationAim(CaseReader& reader, Section& table, const std::filesystem::path& folder) {
    CalibrationAim aim;
    const bool search = table.choice("method") == std::size_t{1};
    aim.method = search ? CalibrationAim::Method::Surrogate : CalibrationAim::Method::Grid;
    const bool measured = table.has("measured");
    if (!measured || table.has("tolerance_g")) aim.tolerance = table.number("tolerance_g");
    if (measured) {
        if (table.has("target_g_per_dose"))
            reader.fault("calibrate.target_g_per_dose", "the target is measured", "give this or measured, not both");
        table.know("target_g_per_dose");
        const std::string file = table.string("measured");
        if (table.isString("measured")) {
            aim.measured = folder / file;
            readMeasured(reader, aim.measured, aim);
        }
    } else {
        aim.target = table.number("target_g_per_dose");
        table.know("measured");
    }
    if (search) {
        aim.maxRuns = int(table.integer("max_runs"));
        const std::vector<Section*> parameters = table.tables("parameter");
        for (std::size_t i = 0; i < parameters.size(); ++i)
            aim.parameters.push_back(readParameter(reader, *parameters[i], fmt::format("calibrate.parameter[{}]", i)));
        if (parameters.empty() || parameters.size() > 4)
            reader.fault("calibrate.parameter", "a search has one to four free parameters",
                         "add [[calibrate.parameter]] with key, low and high");
    } else {
        aim.along = table.string("along");
    }
    return aim;
}

}  // namespace vkdose
