#include "host/sim/dose.h"

#include <cmath>

namespace vkdose {

DoseStatistics statistics(const std::vector<Dose>& doses) {
    DoseStatistics s;
    double sum = 0, squares = 0;
    for (const Dose& d : doses) {
        if (!d.complete) continue;
        ++s.doses;
        sum += d.mass;
    }
    if (s.doses == 0) return s;
    s.mean = sum / s.doses;
    for (const Dose& d : doses) {
        if (d.complete) squares += (d.mass - s.mean) * (d.mass - s.mean);
    }
    if (s.doses > 1) s.deviation = std::sqrt(squares / (s.doses - 1));
    if (s.mean > 0) s.relative = s.deviation / s.mean;
    return s;
}

}  // namespace vkdose
