#pragma once
// What comes out while the drive turns forward, line by line of the time series, in parts of equal time or angle.

#include <optional>
#include <vector>

#include "host/analysis/outlet.h"
#include "host/model/case.h"

namespace vkdose {

/// Of a case without doses: from when on its time counts, which is when the first of its bodies begins to move [s]. 0
/// if none moves, and if forces move one. None of a case with doses.
std::optional<double> countedFrom(const Case& c);

/// The lines in which the drive turns forward, one behind the other. Rests and turning back are no part of it, nor is
/// what comes out in them. Within a line the mass is taken to come out evenly, and the drive to turn evenly.
class TurningFlow {
  public:
    /// What parts are measured by: time [s], or the angle of the drive [rad].
    enum class By { Time, Angle };

    /// With `from` the run has no doses, and all its lines from that time on count [s]. Of such a run from which
    /// nothing came out no line does. No line counts that begins with an empty device.
    TurningFlow(const std::vector<FlowSample>& samples, By by, std::optional<double> from);

    /// All of it, in that measure.
    double length() const { return lines_.empty() ? 0 : lines_.back().turned; }

    /// A stretch of it. Rests between its ends do not count.
    struct Part {
        double from = 0, to = 0;  ///< simulated time [s]
        double length = 0;        ///< in the measure
        double mass = 0;          ///< that came out in it [kg]
        double left = 0;          ///< in the device at its start [kg]
    };
    /// Parts of this length, in order. A part that begins where a rest ends begins behind the rest. The last one lacks
    /// a hundredth at most.
    std::vector<Part> parts(double length) const;

  private:
    /// The sums are those at its end.
    struct Line {
        double from = 0, to = 0;  ///< simulated time [s]
        double turned = 0;        ///< in the measure
        double own = 0;           ///< of this what the line has
        double mass = 0;          ///< that came out [kg]
        double ownMass = 0;       ///< of this mass what came out in the line [kg]
        double left = 0;          ///< in the device [kg]
    };
    struct Place {
        double time = 0, mass = 0, left = 0;
    };

    void add(const FlowSample& before, const FlowSample& s, By by);
    Place within(std::size_t line, double turned) const;
    Place at(std::size_t line, double share) const;

    std::vector<Line> lines_;
};

}  // namespace vkdose
