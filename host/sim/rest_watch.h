#pragma once
// When a bed rests: judged by the speed of its spheres against the speed of a fall over the height of the fill.

#include <cstdint>
#include <limits>
#include <optional>
#include <string>

#include "host/backend/backend.h"
#include "host/core/record.h"
#include "host/model/case.h"

namespace vkdose {

/// A fall from the top of a fill to its bottom.
struct FillFall {
    double height = 0;  ///< of the fill along gravity, from the lowest point of a sphere to the highest [m]
    double time = 0;    ///< [s]; 0 without gravity
    double speed = 0;   ///< at its end [m/s]; 0 without gravity
};
FillFall fillFall(const Case& c, const Particles& filled);

/// Root mean square speed, by mass, of the particles that are not dosed [m/s]; 0 if all of them are.
double meanSpeed(const Sensors& sensors);

/// Decides from the sensors whether a bed rests. A low speed has to last for the time of the fall, because a sphere
/// that has just been released, or that turns back in the trough, is slow for a moment.
class RestWatch {
  public:
    RestWatch(const Case& c, const Particles& filled);

    /// Tells the watch about the next sample. True if the bed rests.
    bool rests(const Sensors& sensors, std::uint64_t step);

    const FillFall& fall() const { return fall_; }

    void save(Record& record) const;
    void restore(const Record& record);

  private:
    static constexpr std::uint64_t kNever = std::numeric_limits<std::uint64_t>::max();

    FillFall fall_;
    double limit_;        ///< [m/s]
    std::uint64_t hold_;  ///< steps for which the speed has to stay below the limit
    std::uint64_t slowSince_ = kNever;
};

/// How the settling of a run ended.
struct Settling {
    std::uint64_t step = 0;  ///< steps made by its end
    bool atRest = false;     ///< by RestWatch
    double time = 0;         ///< its end [s]
    double speed = 0;        ///< root mean square of the particles at its end [m/s]
    double fallSpeed = 0;    ///< of FillFall [m/s]
    double spilled = 0;      ///< mass that had left the throat by then; it is in no dose [kg]
};

/// What the case itself moves when the settling ends, so that no powder can rest: "body \"belt\" moves", "powder comes
/// in". Empty: nothing. A body that the powder moves is none of that.
std::string moverOf(const Case& c, const Settling& settling);

/// "at rest at t = 0.31 s; 0.083 g had left by then, in no dose of this run": for people.
std::string settlingSentence(const Settling& settling, const Case& c);

/// For a checkpoint. Nothing is read if the settling had not ended.
void put(Record& record, const std::optional<Settling>& settling);
void get(const Record& record, std::optional<Settling>& settling);

}  // namespace vkdose
