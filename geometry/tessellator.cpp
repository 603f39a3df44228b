#include "geometry/tessellator.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace vkdose::geometry {

int Tessellator::pieces(double length, int least) const {
    return std::max(least, int(std::ceil(length / facet_ - 1e-9)));
}

int Tessellator::straightPieces(double length) const {
    return straight_ == StraightLines::Whole ? 1 : pieces(length, 1);
}

void Tessellator::put(const Vec3& a, const Vec3& b, const Vec3& c) {
    if (a != b && b != c && c != a) mesh_.push_back({a, b, c});
}

void Tessellator::putAll(const std::vector<Triangle>& triangles) {
    mesh_.insert(mesh_.end(), triangles.begin(), triangles.end());
}

void Tessellator::strip(const Corners& a, const Corners& b, bool outwards) {
    for (std::size_t i = 0; i < a.size(); ++i) {
        const std::size_t j = (i + 1) % a.size();
        if (outwards) {
            put(a[i], a[j], b[j]);
            put(a[i], b[j], b[i]);
        } else {
            put(a[j], a[i], b[j]);
            put(b[j], a[i], b[i]);
        }
    }
}

void Tessellator::strips(const std::vector<Corners>& rings, bool outwards) {
    for (std::size_t k = 0; k + 1 < rings.size(); ++k) strip(rings[k], rings[k + 1], outwards);
}

void Tessellator::turnOver() {
    for (Triangle& t : mesh_) std::swap(t[0], t[1]);
}

}  // namespace vkdose::geometry
