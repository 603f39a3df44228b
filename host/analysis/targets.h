#pragma once
// How well doses to a mass met their target.

#include <string>
#include <vector>

#include "host/sim/dose.h"

namespace vkdose {

/// Means over the complete doses that had a target.
struct TargetFigures {
    int doses = 0;
    int byMass = 0;        ///< of these, stopped because the target was reached; the others by time or torque
    double target = 0;     ///< [kg]
    double stopMass = 0;   ///< dosed when the coil was told to stop [kg]
    double overshoot = 0;  ///< dosed after that, to the end of the dose's rest [kg]
    double error = 0;      ///< mass of the dose less its target [kg]
    double rotation = 0;   ///< time until the coil was told to stop [s]
    /// Mass by the closed form of the turns that the doses made [kg]. These turns follow from the target, and the first
    /// dose, which fills the throat too, may make twice as many as the others.
    double closedForm = 0;
};
TargetFigures targetFigures(const std::vector<Dose>& doses);

/// "target 1.000 g, 1.004 g at the stop after 0.42 s, overshoot 0.028 g; stopped by mass": of a single dose.
std::string targetText(const Dose& dose);

}  // namespace vkdose
