#pragma once
// The picture on the terminal while a run goes on: the bed from the side, the doses as bars, the loads of the bodies,
// how far the run is.

#include <string>
#include <vector>

#include "host/sim/runner.h"
#include "host/terminal/side_view.h"

namespace vkdose::terminal {

struct LiveState {
    Frame frame;
    std::vector<Dose> doses;        ///< that are over
    double underWay = 0;            ///< mass dosed so far in the dose of `frame` [kg]
    double closedForm = 0;          ///< of a dose; 0: there is none [kg]
    std::vector<BodySample> loads;  ///< of Scene::loaded, in its order; empty before the first sample
    std::string progress;           ///< one line of ASCII
};

/// The lines of the screen, none wider than `columns` and no more than `rows`. If there is too little of either, the
/// bed is left out first, then the loads, then doses, never the progress.
std::vector<std::string> screenLines(const Scene& scene, const LiveState& state, int columns, int rows, Style style);

/// A bar of `cells` cells for `value` of `most`, to an eighth of a cell, with a mark at `mark` (none: 0). Each cell is
/// one character.
std::string bar(double value, double mark, double most, int cells);

}  // namespace vkdose::terminal
