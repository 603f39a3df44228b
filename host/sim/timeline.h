#pragma once
// The schedule of a case in whole steps: settle, then doses of rotating and resting, one after the other.

#include <array>
#include <cstdint>
#include <limits>
#include <string_view>

#include "host/core/columns.h"
#include "host/model/case.h"

namespace vkdose {

enum class Phase { Settle, Rotate, Rest };
template <>
struct Words<Phase> {
    static constexpr std::array<const char*, 3> kNames{"settle", "rotate", "rest"};
};
inline std::string_view phaseName(Phase phase) {
    return Words<Phase>::kNames.at(std::size_t(phase));
}

class Timeline {
  public:
    /// Rounds every duration to the nearest whole number of steps. Throws CaseError if the time step or the sensor
    /// interval is not positive, or if a duration that is not zero is shorter than half a step.
    explicit Timeline(const Case& c);

    /// The part of one phase that starts at a step. Steps `step` ... `end` - 1 are made in it.
    struct Stretch {
        Phase phase = Phase::Settle;
        int dose = 0;                     ///< 1 for the first; 0 while settling
        std::uint64_t end = 0;            ///< first step that is no longer in it
        double rate = 0;                  ///< of the coil about +z [rad/s]
        const ContactLaw* law = nullptr;  ///< of the contacts; lives as long as the timeline
    };

    /// The part of a phase in which the next step is made, after `step` finished steps. Call only while !over(step).
    Stretch at(std::uint64_t step) const;

    /// Ends the settling after `step` finished steps, before its longest time. Call only while settling.
    void endSettling(std::uint64_t step);

    /// The next step after `step` at which sensors are read: a multiple of the sensor interval or the end of a phase.
    std::uint64_t nextSample(std::uint64_t step) const;

    /// Whether a frame of the run is to be stored after `step` finished steps: at the start, at multiples of the frame
    /// interval, when the powder has settled and where `over`. All of these are ends of a sample, so that storing
    /// frames cuts no call of the backend. Never if the case asks for none.
    bool frameDue(std::uint64_t step) const;
    bool keepsFrames() const { return frame_ > 0; }

    /// True once the end time is reached, or the settling is done and the case asks for no doses.
    bool over(std::uint64_t step) const { return step >= end_; }

    /// True if the end time of the stop rule is what ends the run at `step`.
    bool cutByEndTime(std::uint64_t step) const { return over(step) && end_ == endTime_; }

    /// Steps until dose `doses` is complete, cut at the end time.
    std::uint64_t stepsUntilDose(double doses) const;

    bool hasDoses() const { return cycle() > 0; }
    double time(std::uint64_t step) const { return static_cast<double>(step) * timeStep_; }
    std::uint64_t settleSteps() const { return settle_; }  ///< once it has ended; before, the longest
    std::uint64_t rotateSteps() const { return rotate_; }
    std::uint64_t restSteps() const { return rest_; }
    std::uint64_t sensorSteps() const { return sensor_; }

    /// +1 or -1: sense of the coil's rotation about +z when it conveys; 0 without a coil.
    double conveyingSense() const { return sense_; }

  private:
    static constexpr std::uint64_t kNever = std::numeric_limits<std::uint64_t>::max();

    std::uint64_t cycle() const { return rotate_ == 0 ? 0 : rotate_ + rest_; }

    double timeStep_;
    std::uint64_t settle_, rotate_, rest_, sensor_;
    std::uint64_t frame_ = 0;         ///< steps from one frame to the next, a multiple of sensor_; 0: none
    std::uint64_t endTime_ = kNever;  ///< step of the stop rule's end time
    std::uint64_t end_ = kNever;
    double sense_ = 0;
    double rate_ = 0;
    ContactLaw settlingLaw_, dosingLaw_;
};

}  // namespace vkdose
