#include "host/advice/cells.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/surface.h"

namespace vkdose {

using geometry::Triangle;

namespace {

/// By the signs of the volumes that segment and edges span.
bool passes(const Vec3& a, const Vec3& b, const Triangle& t, double least) {
    const Vec3 n = glm::cross(t[1] - t[0], t[2] - t[0]);
    const double before = glm::dot(a - t[0], n), behind = glm::dot(b - t[0], n);
    if (!(before * behind < 0) || !(std::min(std::abs(before), std::abs(behind)) > least * glm::length(n)))
        return false;
    const auto side = [&](int i, int j) {
        return glm::dot(b - a, glm::cross(t[std::size_t(i)] - a, t[std::size_t(j)] - a));
    };
    const double u = side(0, 1), v = side(1, 2), w = side(2, 0);
    return (u > 0 && v > 0 && w > 0) || (u < 0 && v < 0 && w < 0);
}

}  // namespace

Cells::Cells(const std::vector<Triangle>& mesh) : mesh_(mesh) {
    for (const Triangle& t : mesh)
        for (const Vec3& p : t) {
            low_ = glm::min(low_, p);
            high_ = glm::max(high_, p);
        }
    perLength_ = double(kSide) / glm::max(high_ - low_, Vec3(1e-300));
    cells_.resize(std::size_t(kSide) * kSide * kSide);
    for (std::size_t i = 0; i < mesh.size(); ++i)
        forEachCell(glm::min(mesh[i][0], glm::min(mesh[i][1], mesh[i][2])),
                    glm::max(mesh[i][0], glm::max(mesh[i][1], mesh[i][2])),
                    [&](std::size_t cell) { cells_[cell].push_back(i); });
}

bool Cells::passedBy(const Vec3& a, const Vec3& b, double least) const {
    const Vec3 low = glm::min(a, b), high = glm::max(a, b);
    if (glm::any(glm::lessThan(high, low_)) || glm::any(glm::greaterThan(low, high_))) return false;
    bool passed = false;
    forEachCell(low, high, [&](std::size_t cell) {
        passed = passed || std::any_of(cells_[cell].begin(), cells_[cell].end(),
                                       [&](std::size_t i) { return passes(a, b, mesh_[i], least); });
    });
    return passed;
}

bool Cells::isOpen(const Vec3& a, const Vec3& b, double aside) const {
    const Vec3 along = glm::normalize(b - a), across = aside * geometry::anyNormal(along);
    const Vec3 up = glm::cross(along, across);
    const std::array<Vec3, 5> ways{Vec3(0), across, -across, up, -up};
    return std::none_of(ways.begin(), ways.end(), [&](const Vec3& way) { return passedBy(a + way, b + way); });
}

int Cells::cell(double x, int axis) const {
    return int(std::clamp((x - low_[axis]) * perLength_[axis], 0.0, kSide - 1.0));
}

template <class Visit>
void Cells::forEachCell(const Vec3& low, const Vec3& high, const Visit& visit) const {
    const int lastX = cell(high.x, 0), lastY = cell(high.y, 1), lastZ = cell(high.z, 2);
    for (int x = cell(low.x, 0); x <= lastX; ++x)
        for (int y = cell(low.y, 1); y <= lastY; ++y)
            for (int z = cell(low.z, 2); z <= lastZ; ++z)
                visit((std::size_t(x) * kSide + std::size_t(y)) * kSide + std::size_t(z));
}

}  // namespace vkdose
