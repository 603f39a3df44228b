#include "host/sim/dose_book.h"

#include <cmath>
#include <utility>

#include "host/sim/run_record.h"

namespace vkdose {

namespace {

constexpr std::size_t kDosed = static_cast<std::size_t>(Region::Dosed);
/// The array of a state whose dose has had an order from outside.
constexpr const char* kOrderedSpeed = "dose_ordered_speed";

}  // namespace

DoseBook::DoseBook(const Case& c, Derived derived, double sense)
    : schedule_(c.schedule), timeStep_(c.world.timeStep), sense_(sense), derived_(std::move(derived)) {}

void DoseBook::expect(const Derived& derived) {
    derived_ = derived;
}

void DoseBook::open(int index, double time, const Sensors& now) {
    dose_ = Dose{};
    dose_.index = index;
    dose_.startTime = time;
    dose_.target = schedule_.targetMass;
    before_ = now;
    torqueSum_ = angle_ = 0;
    steps_ = stages_ = 0;
    speed_ = schedule_.stages.empty() ? schedule_.coilSpeed : schedule_.stages.front().speed;
    ordered_ = false;
}

void DoseBook::turn(double torqueSum, std::uint64_t steps, double rate) {
    torqueSum_ += torqueSum;
    steps_ += steps;
    angle_ += std::abs(rate) * timeStep_ * static_cast<double>(steps);
}

double DoseBook::dosed(const Sensors& now) const {
    return now.mass[kDosed] - before_.mass[kDosed];
}

void DoseBook::noteStop(StopCause cause, const Sensors& now, double time) {
    dose_.stoppedBy = cause;
    dose_.stopMass = dosed(now);
    dose_.rotation = time - dose_.startTime;
}

DoseBook::Order DoseBook::look(const Sample& sample, bool last) {
    const double mass = dosed(sample.sensors), target = schedule_.targetMass;
    Order order;
    if (std::abs(sample.coilTorque) > schedule_.maxTorque)
        order.stop = StopCause::Torque;
    else if (target > 0 && mass >= target)
        order.stop = StopCause::Mass;
    else if (last)
        order.stop = StopCause::Time;
    if (order.stop) {
        noteStop(*order.stop, sample.sensors, sample.time);
        return order;
    }
    const std::uint64_t before = stages_;
    while (stages_ < schedule_.stages.size() && mass >= schedule_.stages[stages_].until * target) ++stages_;
    if (stages_ != before)
        order.speed = speed_ =
            stages_ < schedule_.stages.size() ? schedule_.stages[stages_].speed : schedule_.coilSpeed;
    return order;
}

bool DoseBook::obey(const DriveOrder& given, const Sample& sample, Order& order) {
    if (given.stop) {
        order.stop = StopCause::Order;
        noteStop(StopCause::Order, sample.sensors, sample.time);
    } else if (given.speed && *given.speed != speed_) {  // said again, it begins no second ramp
        order.speed = speed_ = *given.speed;
    } else {
        return false;
    }
    ordered_ = true;
    return true;
}

Dose DoseBook::close(bool complete, const Sensors& now, double time) {
    if (dose_.stoppedBy == StopCause::None) noteStop(StopCause::None, now, time);
    dose_.complete = complete;
    dose_.cumulative = now.mass[kDosed];
    dose_.mass = dosed(now);
    dose_.particles = now.count[kDosed] - before_.count[kDosed];
    // The torque that the drive must supply to convey against the powder's on the coil.
    dose_.coilTorque = steps_ > 0 ? -torqueSum_ / static_cast<double>(steps_) * sense_ + 0.0 : 0;
    const double turning = derived_.turnsInRests ? time - dose_.startTime : timeStep_ * static_cast<double>(steps_);
    const double closedForm = schedule_.isPlain() && !ordered_
                                  ? derived_.massPerDose
                                  : derived_.massPerTurn * angle_ / (2 * kPi) + derived_.massPerSecond * turning;
    if (closedForm > 0) dose_.closedForm = closedForm;
    dose_.endTime = time;
    return std::exchange(dose_, Dose{});
}

void DoseBook::save(Record& record) const {
    put(record, "dose", std::vector<Dose>{dose_});
    put(record, "dosed_before", before_);
    record.put("dose_turning", std::vector<double>{torqueSum_, angle_});
    record.put("dose_steps", std::vector<std::uint64_t>{steps_, stages_});
    if (ordered_) record.putOne(kOrderedSpeed, speed_);
}

void DoseBook::restore(const Record& record) {
    std::vector<Dose> underWay;
    get(record, "dose", underWay);
    dose_ = underWay.at(0);
    get(record, "dosed_before", before_);
    const auto& sums = record.get<double>("dose_turning", 2);
    const auto& counts = record.get<std::uint64_t>("dose_steps", 2);
    torqueSum_ = sums[0];
    angle_ = sums[1];
    steps_ = counts[0];
    stages_ = counts[1];
    ordered_ = record.arrays().contains(kOrderedSpeed);
    if (ordered_) speed_ = record.one<double>(kOrderedSpeed);
}

}  // namespace vkdose
