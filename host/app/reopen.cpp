#include "host/app/reopen.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "host/core/error.h"
#include "host/core/file.h"
#include "host/output/summary.h"
#include "host/sim/state_facts.h"
#include "host/sim/stop_rule.h"

namespace vkdose {

namespace {

/// What keys of [stop] alone decide.
constexpr std::array kByRule{StopReason::Experiment, StopReason::Simulation, StopReason::Doses, StopReason::EndTime};

}  // namespace

Checkpoint endToReopen(const std::filesystem::path& folder) {
    const nlohmann::ordered_json summary = readSummary(folder).value_or(nlohmann::ordered_json::object());
    const auto textAt = [&](const char* key) {
        return summary.contains(key) && summary[key].is_string() ? summary[key].get<std::string>() : std::string();
    };
    const std::string reason = textAt("stop_reason"), over = fmt::format("the run in {} is over", folder.string());
    const auto rule =
        std::find_if(kByRule.begin(), kByRule.end(), [&](StopReason r) { return stopKeyword(r) == reason; });
    if (rule == kByRule.end())
        throw CheckpointError(
            fmt::format("{} ({}); no stop rule ended it, so there is nothing to resume", over, reason));
    const std::filesystem::path file = folder / kEndName;
    if (!std::filesystem::exists(file))
        throw CheckpointError(fmt::format(
            "{} and kept no state of its end, as a member of a study does; there is nothing to resume", over));
    Checkpoint end = readCheckpoint(file);
    // A state for others has no wall time, and counts its steps as those of others.
    try {
        const auto numberAt = [&](const char* key) {
            return summary.contains(key) && summary[key].is_number() ? summary[key].get<double>() : 0;
        };
        const double wall = numberAt("stepping_wall_time_s");
        std::vector<double> sums = end.run.run.get<double>("sums");
        if (sums.empty()) throw RecordError("sums are missing");
        sums.back() = wall;
        end.run.run.put("sums", std::move(sums));
        const double own = numberAt("particle_steps_per_second") * wall;
        end.run.run.putOne("steps_of_others", end.origin.empty() ? 0 : std::max(0.0, numberAt("particle_steps") - own));
    } catch (const RecordError& e) {
        throw CheckpointError(fmt::format("{} cannot be used: {}", file.string(), e.what()));
    }
    return end;
}

void requireOpen(const Case& c, const Checkpoint& end) {
    DoseJudge judge(c.schedule.stop);
    std::uint64_t left = 0;
    try {
        judge.restore(end.run.run);
        left = factsOf(end.run.run).active;
    } catch (const RecordError& e) {
        throw CheckpointError(fmt::format("{} cannot be used: {}", kEndName, e.what()));
    }
    if (judge.ends(std::max<std::uint64_t>(left, 1)))
        throw CaseError(
            {{kCommandLine, 0, "stop", "",
              fmt::format("would end the run where it ended: {}", stopSentence(judge.reason(), c.schedule.stop)),
              "give a larger stop.max_doses, stop.rule=none with stop.max_doses, or another threshold"}});
}

}  // namespace vkdose
