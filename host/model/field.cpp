#include "host/model/field.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace vkdose {

Vec3 FieldGrid::point(std::size_t index) const {
    const std::size_t x = index % cells[0], y = index / cells[0] % cells[1], z = index / cells[0] / cells[1];
    return low + cell() * (Vec3(double(x), double(y), double(z)) + 0.5);
}

double FieldRequest::shape(double distance) const {
    if (distance >= reach()) return 0;
    const double q = distance / width;
    return kernel == Kernel::Gaussian ? std::exp(-0.5 * q * q) : (1 + 3 * q) * (1 - q) * (1 - q) * (1 - q);
}

double FieldRequest::pointsInReach() const {
    double points = 1;
    for (int d = 0; d < 3; ++d) {
        if (grid.resolved(d)) points *= std::min(double(grid.cells[std::size_t(d)]), 2 * reach() / grid.cell()[d] + 3);
    }
    return points;
}

std::optional<std::string> faultOf(const FieldRequest& r) {
    const Vec3 cell = r.grid.cell();
    double widest = 0;
    for (int d = 0; d < 3; ++d) {
        if (!(cell[d] > 0) || !std::isfinite(cell[d])) return "the grid has no volume: give corners low < high";
        if (r.grid.resolved(d)) widest = std::max(widest, cell[d]);
    }
    if (!(r.width > 0)) return "the kernel has no width";
    if (double(r.grid.cells[0]) * r.grid.cells[1] * r.grid.cells[2] > double(kMostFieldPoints))
        return fmt::format("the grid has more than {} points: use fewer cells", kMostFieldPoints);
    // A point must be in reach of every particle in its cell. The furthest is half a diagonal away.
    if (r.reach() < 0.87 * widest)
        return fmt::format("the kernel falls between the points of the grid: use cells of at most {:.6g} m",
                           r.reach() / 0.87);
    if (r.pointsInReach() > kMostPointsInReach)
        return fmt::format("the kernel reaches {:.0f} points, at most {:.0f} can be: use larger cells",
                           r.pointsInReach(), kMostPointsInReach);
    return std::nullopt;
}

Vec3 FieldPoint::velocity() const {
    return density > 0 ? momentum / density : Vec3(kNaN);
}

double FieldPoint::temperature() const {
    return density > 0 ? (kineticStress[0] + kineticStress[1] + kineticStress[2]) / (3 * density) : kNaN;
}

double FieldPoint::coordination() const {
    return number > 0 ? touches / number : kNaN;
}

double FieldPoint::property(std::size_t k) const {
    return density > 0 ? properties[k] / density : kNaN;
}

std::array<double, FieldPoint::kNumbers> FieldPoint::numbers() const {
    const std::array<Vec3, 3>& c = contactStress;
    const std::array<double, 6>& k = kineticStress;
    std::array<double, kNumbers> all{density, momentum.x, momentum.y, momentum.z, number, touches, k[0],
                                     k[1],    k[2],       k[3],       k[4],       k[5],   c[0].x,  c[0].y,
                                     c[0].z,  c[1].x,     c[1].y,     c[1].z,     c[2].x, c[2].y,  c[2].z};
    std::copy(properties.begin(), properties.end(), all.end() - std::ptrdiff_t(properties.size()));
    return all;
}

FieldPoint FieldPoint::of(const double* n) {
    FieldPoint p;
    p.density = n[0];
    p.momentum = Vec3(n[1], n[2], n[3]);
    p.number = n[4];
    p.touches = n[5];
    std::copy_n(n + 6, 6, p.kineticStress.begin());
    for (std::size_t row = 0; row < 3; ++row)
        p.contactStress[row] = Vec3(n[12 + 3 * row], n[13 + 3 * row], n[14 + 3 * row]);
    std::copy_n(n + kNumbers - kMostLawProperties, kMostLawProperties, p.properties.begin());
    return p;
}

}  // namespace vkdose
