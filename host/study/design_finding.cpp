#include "host/study/design_finding.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "host/core/json.h"
#include "host/study/calibration_finding.h"
#include "host/study/finding_file.h"

namespace vkdose {

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::ordered_json;

const char* wishText(CalibrationTarget::Wish wish) {
    switch (wish) {
        case CalibrationTarget::Wish::Largest:
            return "largest";
        case CalibrationTarget::Wish::Smallest:
            return "smallest";
        case CalibrationTarget::Wish::None:
            break;
    }
    return "none";
}

Json measuredJson(const Measured& m) {
    return {jsonNumber(m.value), jsonNumber(m.error)};
}

/// Whether every list has an entry for each goal, parameter or point that it is about.
bool isDesign(const Json& j) {
    const std::size_t goals = j.at("goals").size(), parameters = j.at("parameters").size();
    const auto counts = [&](const char* list, const char* figures) {
        return std::all_of(j.at(list).begin(), j.at(list).end(), [&](const Json& p) {
            return p.at("at").size() == parameters && p.at(figures).size() == goals;
        });
    };
    const auto named = [](const Json& g) { return g.at("name").is_string() && g.at("wish").is_string(); };
    return goals > 0 && std::all_of(j.at("goals").begin(), j.at("goals").end(), named) && counts("points", "values") &&
           counts("front", "figures") && j.at("confirming_seeds").is_array();
}

}  // namespace

std::string goalText(const CalibrationAim& aim, const CalibrationTarget& goal) {
    std::string text = aim.nameOf(goal);
    if (goal.wish != CalibrationTarget::Wish::None) text += fmt::format(" {}", wishText(goal.wish));
    if (std::isfinite(goal.atLeast)) text += fmt::format(", at least {:.4g}", goal.atLeast);
    if (std::isfinite(goal.atMost)) text += fmt::format(", at most {:.4g}", goal.atMost);
    return text;
}

Json designJson(const Study& study, const FrontResult& result, const std::vector<std::uint64_t>& confirmingSeeds) {
    const CalibrationAim& aim = *study.calibration;
    Json j;
    for (const char* list : {"goals", "parameters", "points", "front"}) j[list] = Json::array();
    for (const CalibrationTarget& g : aim.targets)
        j["goals"].push_back({{"name", aim.nameOf(g)},
                              {"base", g.base.filename().string()},
                              {"wish", wishText(g.wish)},
                              {"at_least", jsonNumber(g.atLeast)},
                              {"at_most", jsonNumber(g.atMost)}});
    for (const FreeParameter& p : aim.parameters)
        j["parameters"].push_back({{"key", p.key}, {"low", jsonNumber(p.low)}, {"high", jsonNumber(p.high)}});
    for (std::size_t i = 0; i < result.points.size(); ++i) {
        Json values = Json::array();
        for (const std::vector<Measured>& of : result.values) values.push_back(measuredJson(of[i]));
        j["points"].push_back({{"at", jsonNumbers(result.points[i])}, {"values", values}});
    }
    j["confirming_seeds"] = confirmingSeeds;
    for (const FrontPoint& p : result.front) {
        Json figures = Json::array();
        for (const Measured& m : p.figures) figures.push_back(measuredJson(m));
        j["front"].push_back({{"point", p.point},
                              {"at", jsonNumbers(result.points[p.point])},
                              {"figures", figures},
                              {"verdict", verdictText(p.verdict)}});
    }
    return j;
}

Json readDesign(const fs::path& folder) {
    return readFindingFile(folder / kDesignName, isDesign, "the finding of a design", "vkdose design");
}

fs::path designCase(const fs::path& folder, std::size_t number) {
    return folder / fmt::format("design-{}.toml", number);
}

std::vector<fs::path> designFiles(const fs::path& folder) {
    std::vector<fs::path> files{folder / kDesignName};
    for (std::size_t n = 1; n <= kMostOnFront; ++n) files.push_back(designCase(folder, n));
    return files;
}

void forgetDesign(const fs::path& folder) {
    removeFindings(designFiles(folder));
}

}  // namespace vkdose
