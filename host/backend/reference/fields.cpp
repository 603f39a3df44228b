#include "host/backend/reference/fields.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace vkdose::reference {

namespace {

/// A point of the grid and a kernel's value there [1/m3].
struct Weight {
    std::size_t point;
    double value;
};

class Smear {
  public:
    Smear(const FieldRequest& request, const World& world)
        : request_(request),
          period_(world.period),
          cell_(request.grid.cell()),
          volume_(request.grid.cellVolume()),
          middle_((request.grid.low + request.grid.high) / 2.0) {}

    /// The kernel around a place, normalised over the grid. It is empty if the place is not in the grid. Valid until
    /// the next call.
    const std::vector<Weight>& around(const Vec3& place) {
        weights_.clear();
        const Vec3 x = middle_ + shortest(place - middle_, period_);
        const FieldGrid& g = request_.grid;
        if (!glm::all(glm::greaterThanEqual(x, g.low)) || !glm::all(glm::lessThanEqual(x, g.high))) return weights_;
        std::size_t first[3], last[3];
        for (int d = 0; d < 3; ++d) {
            const double most = double(g.cells[std::size_t(d)]) - 1, at = (x[d] - g.low[d]) / cell_[d] - 0.5;
            const double span = g.resolved(d) ? request_.reach() / cell_[d] : 1;
            first[d] = std::size_t(std::clamp(std::floor(at - span), 0.0, most));
            last[d] = std::size_t(std::clamp(std::ceil(at + span), 0.0, most));
            if (period_[d] > 0) {  // across an end of the domain the kernel reaches points at the other end
                first[d] = 0;
                last[d] = std::size_t(most);
            }
        }
        double sum = 0;
        for (std::size_t z = first[2]; z <= last[2]; ++z)
            for (std::size_t y = first[1]; y <= last[1]; ++y)
                for (std::size_t xx = first[0]; xx <= last[0]; ++xx) {
                    const std::size_t point = (z * g.cells[1] + y) * g.cells[0] + xx;
                    Vec3 away = shortest(g.point(point) - x, period_);
                    for (int d = 0; d < 3; ++d)
                        if (!g.resolved(d)) away[d] = 0;
                    const double w = request_.shape(glm::length(away));
                    if (w <= 0) continue;
                    sum += w;
                    weights_.push_back({point, w});
                }
        for (Weight& w : weights_) w.value /= sum * volume_;
        return weights_;
    }

  private:
    const FieldRequest& request_;
    Vec3 period_, cell_;
    double volume_;
    Vec3 middle_;  ///< of the grid
    std::vector<Weight> weights_;
};

/// A piece of a branch: it begins at `from` and, like the branch, points back there.
struct Line {
    Vec3 from, along;
};

/// The part of a branch that lies in particles of the wanted material. The branch of a pair is divided by the contact
/// point, half of the overlap inside each of the two.
std::optional<Line> wantedPart(const FieldRequest& request, const Particles& p, const Branch& b) {
    const auto wanted = [&](std::uint32_t i) { return !request.material || p.material[i] == *request.material; };
    const bool first = wanted(b.particle), second = b.pair ? wanted(b.other) : first;
    if (!first && !second) return std::nullopt;
    if (first && second) return Line{b.centre, b.along};
    const double length = glm::length(b.along), ours = p.radius[b.particle], other = p.radius[b.other];
    const double overlap = ours + other - length;
    const double share = std::clamp((ours - overlap / 2) / length, 0.0, 1.0);
    return first ? Line{b.centre, share * b.along} : Line{b.centre - share * b.along, (1 - share) * b.along};
}

std::vector<double> touchesOf(const Particles& particles, const std::vector<Branch>& branches) {
    std::vector<double> touches(particles.size(), 0);
    for (const Branch& b : branches) {
        if (!b.pair) continue;
        touches[b.particle] += 1;
        touches[b.other] += 1;
    }
    return touches;
}

}  // namespace

FieldPoints coarseGrain(const FieldRequest& request, const World& world, const Particles& p,
                        const std::vector<Branch>& branches) {
    FieldPoints points(request.grid.points());
    Smear smear(request, world);
    const std::vector<double> touches = touchesOf(p, branches);
    const auto counts = [&](std::size_t i) {
        return p.status[i] == Status::Active && (!request.material || p.material[i] == *request.material);
    };
    const auto mass = [&](std::size_t i) { return massOf(world, p, i); };
    for (std::size_t i = 0; i < p.size(); ++i) {
        if (!counts(i)) continue;
        for (const Weight& w : smear.around(p.position[i])) {
            FieldPoint& at = points[w.point];
            at.density += mass(i) * w.value;
            at.momentum += mass(i) * w.value * p.velocity[i];
            at.number += w.value;
            at.touches += touches[i] * w.value;
            for (std::size_t k = 0; k < at.properties.size() && !p.properties.empty(); ++k)
                at.properties[k] += mass(i) * w.value * p.properties[i][k];
        }
    }
    for (std::size_t i = 0; i < p.size(); ++i) {  // a second loop, because it needs the velocity field
        if (!counts(i)) continue;
        for (const Weight& w : smear.around(p.position[i])) {
            FieldPoint& at = points[w.point];
            const Vec3 stray = p.velocity[i] - at.velocity();
            const double m = mass(i) * w.value;
            const Vec3 square = m * stray * stray,
                       mixed = m * Vec3(stray.y * stray.z, stray.z * stray.x, stray.x * stray.y);
            for (std::size_t d = 0; d < 3; ++d) {
                at.kineticStress[d] += square[int(d)];
                at.kineticStress[3 + d] += mixed[int(d)];
            }
        }
    }
    if (!request.contactStress) return points;
    for (const Branch& b : branches) {
        if (p.status[b.particle] != Status::Active) continue;
        const std::optional<Line> part = wantedPart(request, p, b);
        if (!part) continue;
        for (std::size_t node = 0; node < kBranchNodes.size(); ++node)
            for (const Weight& w : smear.around(part->from - kBranchNodes[node] * part->along))
                for (int a = 0; a < 3; ++a)
                    points[w.point].contactStress[std::size_t(a)] +=
                        kBranchShares[node] * w.value * b.force[a] * part->along;
    }
    return points;
}

}  // namespace vkdose::reference
