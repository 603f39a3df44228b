#include "host/study/prediction.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "host/analysis/beta.h"
#include "host/core/json.h"
#include "host/model/case.h"
#include "host/study/finding_file.h"
#include "host/study/read_axis.h"
#include "host/study/seed_scatter.h"
#include "host/study/trials.h"

namespace vkdose {

Study drawsStudy(const std::filesystem::path& file, const std::vector<std::string>& overrides,
                 const std::filesystem::path& draws, int count) {
    Study study;
    study.file = file;
    study.base = file;
    study.name = file.stem().string() + "-draws";
    study.reason = fmt::format("What comes of {} with a powder that is known by {}?", file.filename().string(),
                               draws.filename().string());
    study.axes.push_back(axisOfTable(draws, count));
    applyOverrides(study, overrides);
    study.text = fmt::format("# {} draws of {}, each with a seed of its own: vkdose run {} --draws {}\nbase = {}\n",
                             count, draws.string(), file.string(), count, tomlString(file.string()));
    return study;
}

std::vector<Member> drawsMembers(const Study& study) {
    const std::vector<std::string> keys = study.keys();
    std::vector<Member> members;
    std::uint64_t seed = 0;
    for (const std::vector<Node>& row : study.axes.front().points) {
        std::vector<Setting> point;
        for (std::size_t k = 0; k < keys.size(); ++k) point.push_back({keys[k], row[k]});
        const int number = int(members.size());
        // The first tells the seed of the case.
        members.push_back(memberAt(study, number, number == 0 ? std::nullopt : std::optional(seed + number), point));
        if (number == 0) seed = members.front().seed;
    }
    return members;
}

PredictedFigure predictedFrom(const std::string& name, const std::vector<double>& values) {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    const Estimate estimate = estimateOf(values);
    const double n = double(values.size());
    PredictedFigure figure{name, values.size(), estimate.mean, kNone, kNone, kNone};
    if (values.size() < 2) return figure;
    figure.deviation = estimate.standardError * std::sqrt(n);
    const double half =
        studentFactor(kPredictionChance, int(values.size()) - 1) * figure.deviation * std::sqrt(1 + 1 / n);
    figure.low = figure.mean - half;
    figure.high = figure.mean + half;
    return figure;
}

Prediction predictionOf(const std::vector<Member>& members, const SweepFolder& folder) {
    Prediction prediction{members.size(), 0, {}};
    std::vector<RunFigures> whole;
    for (const Member& m : members)
        if (folder.status(m.number) == MemberStatus::Ok) whole.emplace_back(folder.memberFolder(m.number));
    prediction.failed = members.size() - whole.size();
    const Case c = loadResolvedCase(members.front().caseText, "case.toml");
    for (const std::string& name : figureNames(c)) {
        std::vector<double> values;
        for (const RunFigures& run : whole) {
            const double value = run.at(name).value;
            if (std::isfinite(value)) values.push_back(value);
        }
        if (!values.empty()) prediction.figures.push_back(predictedFrom(name, values));
    }
    return prediction;
}

nlohmann::ordered_json predictionJson(const Prediction& prediction) {
    nlohmann::ordered_json j{{"draws", prediction.draws},
                             {"failed", prediction.failed},
                             {"chance", kPredictionChance},
                             {"figures", nlohmann::ordered_json::array()}};
    for (const PredictedFigure& f : prediction.figures)
        j["figures"].push_back({{"name", f.name},
                                {"draws", f.count},
                                {"mean", jsonNumber(f.mean)},
                                {"deviation", jsonNumber(f.deviation)},
                                {"low", jsonNumber(f.low)},
                                {"high", jsonNumber(f.high)}});
    return j;
}

nlohmann::ordered_json readPrediction(const std::filesystem::path& folder) {
    const auto isWhole = [](const nlohmann::ordered_json& j) {
        const auto& figures = j.at("figures");
        return j.at("draws").is_number() && j.at("failed").is_number() && figures.is_array() &&
               std::all_of(figures.begin(), figures.end(), [](const auto& f) {
                   return f.at("name").is_string() && f.contains("mean") && f.contains("low") && f.contains("high") &&
                          f.at("draws").is_number();
               });
    };
    return readFindingFile(folder / kPredictionName, isWhole, "a prediction", "vkdose run --draws");
}

}  // namespace vkdose
