#include "host/analysis/surface_map.h"

#include <algorithm>
#include <cmath>

namespace vkdose {

SurfaceMap::SurfaceMap(const Particles& particles, double step) {
    constexpr double kMostSpots = 1e6;
    double lowX = kInfinity, lowZ = kInfinity, highX = -kInfinity, highZ = -kInfinity;
    for (std::size_t i = 0; i < particles.size(); ++i) {
        if (particles.status[i] != Status::Active) continue;
        const Vec3& x = particles.position[i];
        const double r = particles.radius[i];
        lowX = std::min(lowX, x.x - r);
        lowZ = std::min(lowZ, x.z - r);
        highX = std::max(highX, x.x + r);
        highZ = std::max(highZ, x.z + r);
    }
    if (!(lowX < highX)) return;
    lowX_ = lowX;
    lowZ_ = lowZ;
    step_ = std::max(step, std::sqrt((highX - lowX) * (highZ - lowZ) / kMostSpots));
    const auto columns = static_cast<std::size_t>(std::ceil((highX - lowX) / step_));
    rows_ = static_cast<std::size_t>(std::ceil((highZ - lowZ) / step_));
    top_.assign(columns * rows_, -kInfinity);
    const auto first = [&](double from) { return static_cast<std::size_t>(std::max(0.0, std::ceil(from - 0.5))); };
    for (std::size_t i = 0; i < particles.size(); ++i) {
        if (particles.status[i] != Status::Active) continue;
        const Vec3& at = particles.position[i];
        const double r = particles.radius[i];
        for (std::size_t c = first((at.x - r - lowX_) / step_); c < columns; ++c) {
            const double dx = lowX_ + (static_cast<double>(c) + 0.5) * step_ - at.x;
            if (dx > r) break;
            for (std::size_t k = first((at.z - r - lowZ_) / step_); k < rows_; ++k) {
                const double dz = lowZ_ + (static_cast<double>(k) + 0.5) * step_ - at.z;
                if (dz > r) break;
                const double rest = r * r - dx * dx - dz * dz;
                double& top = top_[c * rows_ + k];
                if (rest >= 0) top = std::max(top, at.y + std::sqrt(rest));
            }
        }
    }
}

}  // namespace vkdose
