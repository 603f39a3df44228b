#pragma once
// The data of a run's report: the figures and curves in its output folder.

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <vector>

namespace vkdose::report {

using Json = nlohmann::ordered_json;

struct FrameSource;
struct Photograph;

/// The balance's readings of an experiment, from a CSV with the column `dose` and one of `mass_g`, `cumulative_g`.
/// Returns the columns dose, mass_kg and cumulative_kg. Throws CaseError if the file cannot be read.
Json experimentJson(const std::filesystem::path& file);

/// The data of a run's page, in SI, from the folder of a run that is over or still goes on. The player and the
/// photographs are included only if they are asked for. Arrays carry the names of the CSV columns they come from. A
/// time series of more than 5000 lines is thinned out. Throws CaseError if the folder holds no run, one of its files is
/// damaged, or a photograph does not fit the run.
Json runJson(const std::filesystem::path& folder, const std::optional<std::filesystem::path>& experiment);
Json runJson(const std::filesystem::path& folder, const std::optional<std::filesystem::path>& experiment,
             const FrameSource& frames, const std::vector<Photograph>& photographs);

}  // namespace vkdose::report
