#pragma once
// A finding of the verification suite: one figure of one small case beside the value it must have.

#include <string>
#include <vector>

namespace vkdose::verify {

/// How far a figure may be off, and the reason for it. `share` is in units of `scale`, a physical scale in the unit of
/// the figure; a scale of 0 stands for the expected value itself.
struct Tolerance {
    double share;
    std::string reason;
    double scale = 0;
};

/// The worth of the expected value. It is derived (in closed form, by geometry, by another program), or merely of the
/// right size: then it tells a wild result from a sane one and no more.
enum class Kind { Known, Plausible };

struct Check {
    std::string where;  ///< the case, "collisions/head-on"
    std::string quantity;
    std::string unit;
    double expected;
    double got;
    Tolerance tolerance;
    Kind kind = Kind::Known;

    /// |got - expected| in units of the scale; NaN if any of the three is not finite or the scale is not positive.
    double error() const;
    /// NaN never passes.
    bool passes() const;
};

/// The largest error of several checks, each in units of what it may be: 1 is just allowed. It is infinite if one of
/// them is not a number.
double worstShare(const std::vector<Check>& checks);

}  // namespace vkdose::verify
