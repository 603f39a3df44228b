#include "host/report/free_surface_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/analysis/free_surface.h"
#include "host/core/csv_lines.h"
#include "host/core/csv_table.h"
#include "host/core/error.h"
#include "host/core/json.h"
#include "host/sim/density.h"

namespace vkdose::report {

namespace {

constexpr std::size_t kMostColumns = 500;

/// The last frame of each dose, 0 for the settling.
std::vector<FrameEntry> lastOfEachDose(const std::vector<FrameEntry>& entries) {
    std::vector<FrameEntry> last;
    for (const FrameEntry& entry : entries) {
        if (last.empty() || last.back().dose != entry.dose) last.push_back(entry);
        last.back() = entry;
    }
    return last;
}

Json stateJson(const Case& c, const Particles& particles, std::size_t columns, int dose, double time) {
    return {{"dose", dose},
            {"time_s", jsonNumber(time)},
            {"height_m", jsonNumbers(surfaceProfile(particles, *c.canister, columns, Across::Highest).height)}};
}

std::string known(const Json& states) {
    std::string list;
    for (const Json& state : states) list += (list.empty() ? "" : ", ") + std::to_string(state["dose"].get<int>());
    return list;
}

/// A surface that is longer than the canister was measured with a wrong length.
void requireWithin(const std::string& name, const std::vector<double>& z, double length) {
    constexpr double kAllowed = 0.02;  // of the length: the edges of a photograph are not cut to the pixel
    if (z.empty()) return;
    const auto [low, high] = std::minmax_element(z.begin(), z.end());
    if (*low >= -kAllowed * length && *high <= (1 + kAllowed) * length) return;
    throw CaseError({{name, 0, "z_mm", "",
                      fmt::format("runs from {:.4g} to {:.4g} mm, the canister from 0 to {:.4g} mm", *low * 1e3,
                                  *high * 1e3, length * 1e3),
                      "trace it again with the --roi and the --length-mm of the canister"}});
}

Json photographJson(const Photograph& photograph, const Json& states, double length) {
    const std::string name = photograph.file.string();
    const Table table = Table::read(photograph.file, LastLine::Whole);
    std::vector<double> z = table.column("z_mm"), height = table.column("height_mm");
    for (double& x : z) {
        if (!std::isfinite(x)) throw CaseError({{name, 0, "z_mm", "", "is missing in a row", "give a number in each"}});
        x *= 1e-3;
    }
    requireWithin(name, z, length);
    for (double& x : height) x *= 1e-3;
    if (states.empty())
        throw CaseError({{name, 0, "--profile", "", "the run has no surface to stand beside",
                          "give the folder of a run in a canister that has ended or kept frames"}});
    const int dose = photograph.dose.value_or(states.back()["dose"].get<int>());
    if (std::none_of(states.begin(), states.end(), [&](const Json& s) { return s["dose"] == dose; }))
        throw CaseError({{name, 0, "--profile", fmt::format("@{}", dose), "the run kept no state of this dose",
                          fmt::format("give one of {} (0 is the settled bed)", known(states))}});
    return {{"name", photograph.file.filename().string()},
            {"dose", dose},
            {"z_m", jsonNumbers(z)},
            {"height_m", jsonNumbers(height)}};
}

}  // namespace

Photograph photographOf(const std::string& argument) {
    const std::size_t at = argument.rfind('@');
    if (at == std::string::npos || at == 0 || std::filesystem::exists(argument)) return {argument, std::nullopt};
    const std::string dose = argument.substr(at + 1);
    const double value = numberIn(dose);
    if (!(value >= 0) || value != std::floor(value) || value > 1e9)
        throw CaseError({{"", 0, "--profile", argument, "the dose after @ is no whole number from 0 on",
                          "give FILE.csv or FILE.csv@DOSE"}});
    return {argument.substr(0, at), static_cast<int>(value)};
}

std::size_t surfaceColumns(const Case& c, const Particles& particles) {
    const double width = meanActiveRadius(particles);
    if (!c.canister || !(width > 0)) return 0;
    return std::clamp<std::size_t>(static_cast<std::size_t>(c.canister->length / width), 1, kMostColumns);
}

Json surfaceJson(const Case& c, const FrameSource& frames, const std::optional<Particles>& end, int lastDose,
                 const std::vector<Photograph>& photographs) {
    Json states = Json::array();
    std::size_t columns = 0;
    if (c.canister && !frames.entries.empty()) {
        columns = surfaceColumns(c, frames.read(frames.entries.front()).particles);
        for (const FrameEntry& entry : lastOfEachDose(frames.entries))
            if (columns > 0)
                states.push_back(stateJson(c, frames.read(entry).particles, columns, entry.dose, entry.time));
    } else if (c.canister && end) {
        columns = surfaceColumns(c, *end);
        if (columns > 0) states.push_back(stateJson(c, *end, columns, lastDose, NAN));
    }
    Json measured = Json::array();
    for (const Photograph& photograph : photographs)
        measured.push_back(photographJson(photograph, states, c.canister ? c.canister->length : 0));
    if (states.empty()) return nullptr;
    std::vector<double> z;
    for (std::size_t i = 0; i < columns; ++i)
        z.push_back((static_cast<double>(i) + 0.5) * c.canister->length / static_cast<double>(columns));
    return {{"length_m", c.canister->length}, {"z_m", jsonNumbers(z)}, {"states", states}, {"photographs", measured}};
}

}  // namespace vkdose::report
