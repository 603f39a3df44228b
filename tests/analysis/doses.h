#pragma once
// Doses that are made up.

#include <vector>

#include "host/sim/dose.h"

namespace vkdose::test {

/// Complete doses of these masses [kg], a second each, on top of what fell out while settling.
inline std::vector<Dose> dosesOf(const std::vector<double>& masses, double settling = 0) {
    std::vector<Dose> doses;
    for (const double m : masses) {
        Dose d;
        d.startTime = double(doses.size());
        d.mass = m;
        d.particles = m > 0 ? 1 : 0;
        d.cumulative = (doses.empty() ? settling : doses.back().cumulative) + m;
        d.complete = true;
        doses.push_back(d);
    }
    return doses;
}

}  // namespace vkdose::test
