#include "host/study/seed_scatter.h"

#include <cmath>
#include <limits>

#include "host/analysis/beta.h"

namespace vkdose {

double scatterOfSeeds(const std::vector<std::vector<double>>& points) {
    double squares = 0;
    int freedom = 0;
    for (const std::vector<double>& values : points) {
        const Estimate mean = estimateOf(values);
        for (const double x : values)
            if (std::isfinite(x)) squares += (x - mean.mean) * (x - mean.mean);
        freedom += mean.count > 1 ? mean.count - 1 : 0;
    }
    return freedom > 0 ? std::sqrt(squares / freedom) : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace vkdose
