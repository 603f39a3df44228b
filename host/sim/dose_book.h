#pragma once
// The dose under way: what is summed over it, and what tells the coil to change its speed or to stop.

#include <optional>

#include "host/backend/backend.h"
#include "host/core/record.h"
#include "host/model/case.h"
#include "host/sim/dose.h"
#include "host/sim/sample.h"

namespace vkdose {

class DoseBook {
  public:
    /// `sense`: +1 or -1, that of the conveying coil about +z.
    DoseBook(const Case& c, Derived derived, double sense);

    /// From now on the closed form is that of these figures: the bulk density has been measured.
    void expect(const Derived& derived);

    bool underWay() const { return dose_.index > 0; }
    int index() const { return dose_.index; }
    /// Whether the coil conveys and has not been told to stop.
    bool conveys() const { return underWay() && dose_.stoppedBy == StopCause::None; }

    /// Dosed so far in the dose under way [kg]; 0 while there is none.
    double soFar(const Sensors& now) const { return underWay() ? dosed(now) : 0; }

    /// Begins a dose at `time` [s]; `now` are the latest sensors.
    void open(int index, double time, const Sensors& now);
    /// Adds `steps` of its rotation: the sum of the particles' torque on the coil over them [N m], at this rate of the
    /// coil [rad/s about +z].
    void turn(double torqueSum, std::uint64_t steps, double rate);

    /// What a sample of the rotation decides. `last`: the longest time of the rotation is over.
    struct Order {
        std::optional<StopCause> stop;
        std::optional<double> speed;  ///< conveying, to change to [rad/s]
    };
    Order look(const Sample& sample, bool last);
    /// Adds an order from outside at a sample that decided not to stop. Returns whether it changes anything.
    bool obey(const DriveOrder& given, const Sample& sample, Order& order);

    /// Ends the dose with the latest sensors at `time` [s].
    Dose close(bool complete, const Sensors& now, double time);

    void save(Record& record) const;
    void restore(const Record& record);

  private:
    double dosed(const Sensors& now) const;
    void noteStop(StopCause cause, const Sensors& now, double time);

    const Schedule& schedule_;
    double timeStep_, sense_;
    Derived derived_;           ///< for the closed form
    Dose dose_;                 ///< index 0: none is under way
    Sensors before_;            ///< at its start
    double torqueSum_ = 0;      ///< times steps
    std::uint64_t steps_ = 0;   ///< of its rotation
    double angle_ = 0;          ///< by which the coil conveyed [rad]
    std::uint64_t stages_ = 0;  ///< that are over
    // For orders from outside. A state holds the speed only if there was one.
    double speed_ = 0;      ///< that the drive has, or is on its way to [rad/s]
    bool ordered_ = false;  ///< there was one
};

}  // namespace vkdose
