#pragma once
// A device with powder that is not known exactly: runs with draws from the distribution of its parameters, and the
// intervals of their figures.

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "host/study/member.h"
#include "host/study/sweep_folder.h"

namespace vkdose {

inline constexpr const char* kPredictionName = "prediction.json";
inline constexpr double kPredictionChance = 0.95;  ///< with which an interval holds another such run

/// The study of a case with each of the first `count` draws of its powder, the rows of a CSV with a column for each
/// key. Throws CaseError if the table has fewer, or columns that are no keys.
Study drawsStudy(const std::filesystem::path& file, const std::vector<std::string>& overrides,
                 const std::filesystem::path& draws, int count);

/// Its members: every draw with a seed of its own, from that of the case on.
std::vector<Member> drawsMembers(const Study& study);

/// A figure of the device, over the draws that have it.
struct PredictedFigure {
    std::string name;
    std::size_t count = 0;
    double mean = 0, deviation = 0;  ///< of the runs; the deviation is NaN for one
    double low = 0, high = 0;        ///< within which another run, with another draw, is to be expected; NaN for one
};

/// The interval of another value of a normal distribution of which these `values` are known: mean -+ t s sqrt(1 + 1/n),
/// with t of Student's distribution for kPredictionChance.
PredictedFigure predictedFrom(const std::string& name, const std::vector<double>& values);

struct Prediction {
    std::size_t draws = 0, failed = 0;
    std::vector<PredictedFigure> figures;  ///< those that some draw has
};

/// The prediction of a sweep whose `members` have ended.
Prediction predictionOf(const std::vector<Member>& members, const SweepFolder& folder);

/// The content of prediction.json; what is not known is null.
nlohmann::ordered_json predictionJson(const Prediction& prediction);

/// That of a folder; null without the file. Throws CaseError if it is damaged.
nlohmann::ordered_json readPrediction(const std::filesystem::path& folder);

}  // namespace vkdose
