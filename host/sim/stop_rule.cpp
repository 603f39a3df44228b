#include "host/sim/stop_rule.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <numeric>

namespace vkdose {

std::string stopKeyword(StopReason reason) {
    switch (reason) {
        case StopReason::Settled:
            return "settled";
        case StopReason::Experiment:
            return "experiment_rule";
        case StopReason::Simulation:
            return "simulation_rule";
        case StopReason::Empty:
            return "empty";
        case StopReason::Doses:
            return "dose_count";
        case StopReason::EndTime:
            return "end_time";
        case StopReason::Torque:
            return "torque";
        case StopReason::Interrupted:
            return "interrupted";
        case StopReason::RunError:
            return "run_error";
        case StopReason::DeviceError:
            return "device_error";
        case StopReason::OutputError:
            return "output_error";
    }
    return "unknown";
}

std::string stopSentence(StopReason reason, const StopRule& rule) {
    switch (reason) {
        case StopReason::Settled:
            return "settled; the case asks for no doses";
        case StopReason::Experiment:
            return fmt::format("the last {} doses together gave no more than {:.3g} g (experiment rule)", rule.doses,
                               rule.threshold * 1e3);
        case StopReason::Simulation:
            return fmt::format("the last {} doses gave nothing (simulation rule)", rule.doses);
        case StopReason::Empty:
            return "the canister is empty";
        case StopReason::Doses:
            return rule.maxDoses == 1 ? std::string("the dose asked for is done")
                                      : fmt::format("the {} doses asked for are done", rule.maxDoses);
        case StopReason::EndTime:
            return fmt::format("the end time {:.6g} s is reached", rule.endTime);
        case StopReason::Torque:
            return "the drive needed more than dose.max_torque_mNm";
        case StopReason::Interrupted:
            return "interrupted; everything computed until then is kept";
        case StopReason::RunError:
            return "stopped by an error; everything computed until then is kept";
        case StopReason::DeviceError:
            return "stopped by the device; everything computed until then is kept";
        case StopReason::OutputError:
            return "stopped because a result could not be written";
    }
    return "unknown";
}

void DoseJudge::save(Record& record) const {
    record.put("judge_recent", std::vector<double>(recent_.begin(), recent_.end()));
    record.putOne("judge_doses", static_cast<std::uint64_t>(doses_));
}

void DoseJudge::restore(const Record& record) {
    const auto& recent = record.get<double>("judge_recent");
    recent_.assign(recent.begin(), recent.end());
    doses_ = static_cast<int>(record.one<std::uint64_t>("judge_doses"));
}

bool DoseJudge::over(double mass, std::uint64_t particles, std::uint64_t left) {
    ++doses_;
    if (particles > 0 || !recent_.empty()) recent_.push_back(particles == 0 ? 0.0 : mass);
    return ends(left);
}

/// Whether the doses so far are as empty as the rule asks for.
bool DoseJudge::empty() const {
    if (rule_.kind == StopRule::Kind::None || rule_.doses <= 0) return false;
    const bool patient = rule_.maxDoses < std::numeric_limits<int>::max() || std::isfinite(rule_.endTime);
    if (recent_.empty()) return !patient && doses_ / kPatience >= rule_.doses;
    if (static_cast<int>(recent_.size()) < rule_.doses) return false;
    const double change = std::accumulate(recent_.begin(), recent_.end(), 0.0);
    return change <= (rule_.kind == StopRule::Kind::Experiment ? rule_.threshold : 0.0);
}

bool DoseJudge::ends(std::uint64_t left) {
    while (static_cast<int>(recent_.size()) > rule_.doses) recent_.pop_front();  // a resumed run may look at fewer
    if (left == 0) {
        reason_ = StopReason::Empty;
        return true;
    }
    if (empty()) {
        reason_ = rule_.kind == StopRule::Kind::Experiment ? StopReason::Experiment : StopReason::Simulation;
        return true;
    }
    reason_ = StopReason::Doses;
    return doses_ >= rule_.maxDoses;
}

}  // namespace vkdose
