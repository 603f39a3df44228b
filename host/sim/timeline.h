#pragma once
// The schedule of a case in whole steps: settle, then doses of rotating and resting, one after the other.

#include <cstdint>
#include <limits>
#include <optional>

#include "host/core/record.h"
#include "host/model/case.h"
#include "host/model/phase.h"

namespace vkdose {

/// The plan of a run, by the longest time of every phase, and what has been decided so far: that the bed rests, how
/// fast the coil turns and that it is to stop. A decision moves everything after it.
class Timeline {
  public:
    /// A change of the coil's speed is made in so many equal parts, in each of which the speed is constant: a backend
    /// advances at a constant rate.
    static constexpr std::uint64_t kRampPieces = 32;

    /// Rounds every duration to the nearest whole number of steps. Throws CaseError if the time step or the sensor
    /// interval is not positive, or if a duration that is not zero is shorter than half a step.
    explicit Timeline(const Case& c);

    /// The part of one phase that starts at a step. Steps `step` ... `end` - 1 are made in it.
    struct Stretch {
        Phase phase = Phase::Settle;
        int dose = 0;                     ///< 1 for the first; 0 while settling
        std::uint64_t end = 0;            ///< first step that is no longer in it
        double rate = 0;                  ///< of the coil about +z [rad/s], up to `pieceEnd`
        const ContactLaw* law = nullptr;  ///< of the contacts; lives as long as the timeline
        Vec3 gravity{0};                  ///< [m/s2]
        std::uint64_t pieceEnd = 0;       ///< first step with another rate, or `end`
        std::uint64_t stop = 0;           ///< while the coil conveys: the step at which it is told to stop
        bool closesDose = false;          ///< the dose is complete at `end`
    };

    /// The part of a phase in which the next step is made, after `step` finished steps. Call only while !over(step),
    /// and for no step before the latest decision.
    Stretch at(std::uint64_t step) const;

    /// Ends the settling after `step` finished steps, before its longest time. Call only while settling.
    void endSettling(std::uint64_t step);

    /// From `step` on the coil changes its speed to this one [rad/s, conveying]. Call only while it conveys and has not
    /// been told to stop.
    void changeSpeed(std::uint64_t step, double speed);

    /// The coil is told to stop after `step` finished steps, before the longest time of the rotation. Call only while
    /// it conveys and has not been told to stop.
    void stopTurning(std::uint64_t step);

    /// The decisions so far.
    void save(Record& record) const;
    void restore(const Record& record);

    /// The next step after `step` at which sensors are read: a multiple of the sensor interval, the end of a
    /// phase or the step at which the coil is told to stop.
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

    /// Steps until dose `doses` is complete by the plan, cut at the end time.
    std::uint64_t stepsUntilDose(double doses) const;

    bool hasDoses() const { return cycle() > 0; }
    double time(std::uint64_t step) const { return static_cast<double>(step) * timeStep_; }
    std::uint64_t settleSteps() const { return settle_; }  ///< once it has ended; before, the longest
    std::uint64_t rotateSteps() const { return rotate_; }
    std::uint64_t restSteps() const { return rest_; }
    std::uint64_t sensorSteps() const { return sensor_; }

    /// +1 or -1: sense in which the drive turns when it conveys, of a coil about +z; 0 if there is nothing to drive.
    double conveyingSense() const { return sense_; }

  private:
    static constexpr std::uint64_t kNever = std::numeric_limits<std::uint64_t>::max();

    /// The coil's speed: `from` before step `since`, `to` once the ramp is over [rad/s, conveying].
    struct Change {
        double from = 0, to = 0;
        std::uint64_t since = 0;
    };
    /// The steps at which the parts of a dose begin, and its end.
    struct DosePlan {
        int dose = 1;
        std::uint64_t start = 0, stop = 0, turned = 0, reversed = 0, end = 0;
        Change speed;  ///< the latest before `stop`
    };
    struct Piece {
        double speed;
        std::uint64_t end;
    };

    std::uint64_t cycle() const { return rotate_ == 0 ? 0 : rotate_ + reverse_ + rest_; }
    DosePlan planned(int dose, std::uint64_t start) const;
    DosePlan stopped(DosePlan dose, std::uint64_t stop) const;
    DosePlan doseAt(std::uint64_t step) const;
    double speedAt(const Change& change, std::uint64_t step) const;
    Piece pieceAt(const Change& change, std::uint64_t step) const;
    double rateOf(double speed) const;

    double timeStep_;
    std::uint64_t settle_, rotate_, rest_, sensor_;
    std::uint64_t ramp_ = 0, reverse_ = 0;
    double firstSpeed_, reverseSpeed_;
    std::optional<geometry::Coil> coil_;
    DosePlan dose_;                   ///< the one that the latest decision is about; later ones follow by the plan
    std::uint64_t frame_ = 0;         ///< steps from one frame to the next, a multiple of sensor_; 0: none
    std::uint64_t endTime_ = kNever;  ///< step of the stop rule's end time
    std::uint64_t end_ = kNever;
    double sense_ = 0;
    ContactLaw settlingLaw_, dosingLaw_;
    Vec3 settlingGravity_, dosingGravity_;
};

}  // namespace vkdose
