// From a validated case to its particles: draw sizes up to the mass, stack them on a grid.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "host/core/random.h"
#include "host/model/case.h"
#include "host/model/grid.h"
#include "host/model/refill.h"
#include "host/model/size_distribution.h"

namespace vkdose {
namespace {

double listedMass(const World& world, const Particles& list) {
    double mass = 0;
    for (std::size_t i = 0; i < list.size(); ++i) mass += massOf(world, list, i);
    return mass;
}

/// Draws radii, from the draw `first` on, until one more would not bring the mass closer to the target. Adds to `mass`
/// and `redrawn`.
std::vector<double> drawRadii(const Case& c, double target, std::uint64_t first, double& mass, std::uint64_t& redrawn) {
    std::vector<double> radii;
    for (std::uint64_t index = first;; ++index) {
        const double r = drawRadius(c.filling.size, c.seed, index, redrawn);
        const double next = mass + sphereMass(c.world.density(), r);
        if (std::abs(next - target) >= std::abs(mass - target)) break;
        radii.push_back(r);
        mass = next;
    }
    return radii;
}

/// Most sites in a row, more than any case can fill. The limit keeps the number of sites of an open or absurd region
/// representable.
constexpr double kMaxSites = 1e9;

/// Shift of site `index`, within the grid's play, so that the bed does not start out as a crystal.
Vec3 jitter(std::uint64_t seed, std::uint64_t index, double amplitude) {
    const auto [x, y] = uniforms(seed, Stream::Jitter, index, 0);
    const auto [z, unused] = uniforms(seed, Stream::Jitter, index, 1);
    (void)unused;
    return amplitude * (2.0 * Vec3(x, y, z) - 1.0);
}

/// Particles with these radii on the grid. `first` is the draw of the first of them.
Particles onGrid(const Case& c, const InsertionGrid& grid, const std::vector<double>& radii, std::uint64_t first) {
    if (static_cast<double>(radii.size()) > grid.capacity())
        throw std::logic_error("the grid is too small for the powder");  // loadCase refuses such a case
    Particles particles;
    for (std::size_t i = 0; i < radii.size(); ++i)
        particles.add(grid.site(i) + jitter(c.seed, first + i, grid.jitterAmplitude()), radii[i]);
    return particles;
}

/// The draws of the refills go on where those of the filling end.
void drawRefills(const Case& c, Insertion& result) {
    std::uint64_t draws = result.particles.size();
    for (const Refill& refill : c.refills) {
        Insertion::Waiting& waiting = result.waiting.emplace_back();
        const InsertionGrid grid(refillRegion(c), largestRadius(c.filling.size), c.filling.gridGap);
        const std::vector<double> radii = drawRadii(c, refill.mass, draws, waiting.mass, result.redrawn);
        waiting.particles = onGrid(c, grid, radii, draws);
        waiting.particles.status.assign(radii.size(), Status::Waiting);
        waiting.height = grid.top(radii.size()) - c.filling.region.low.y;
        draws += radii.size();
    }
}

}  // namespace

InsertionGrid::InsertionGrid(const Box& region, double largestRadius, double gap)
    : gap_(gap),
      pitch_(2 * largestRadius * (1 + gap)),
      low_(region.low + 0.5 * pitch_),
      high_(region.high - 0.5 * pitch_) {
    const Vec3 room = (high_ - low_) / pitch_;
    const auto sites = [](double n) {  // the tolerance lets a region of exactly n pitches hold n
        return n < -1e-9 ? 0.0 : std::min(std::floor(n + 1e-9) + 1, kMaxSites);
    };
    columns_ = static_cast<std::uint64_t>(sites(room.x));
    rows_ = static_cast<std::uint64_t>(sites(room.z));
    layers_ = columns_ * rows_ == 0 ? 0 : sites(room.y);
}

Vec3 InsertionGrid::site(std::uint64_t index) const {
    const std::uint64_t column = index % columns_;
    const std::uint64_t row = index / columns_ % rows_;
    const std::uint64_t layer = index / columns_ / rows_;
    // Sideways the sites spread over the whole region. Upwards they are as close as possible.
    const auto across = [](double low, double high, std::uint64_t i, std::uint64_t n) {
        return n == 1 ? 0.5 * (low + high) : low + (high - low) * static_cast<double>(i) / static_cast<double>(n - 1);
    };
    return {across(low_.x, high_.x, column, columns_), low_.y + pitch_ * static_cast<double>(layer),
            across(low_.z, high_.z, row, rows_)};
}

double InsertionGrid::capacity() const {
    return static_cast<double>(columns_) * static_cast<double>(rows_) * layers_;
}

double InsertionGrid::jitterAmplitude() const {
    return 0.25 * pitch_ * gap_ / (1 + gap_);
}

double InsertionGrid::top(std::uint64_t count) const {
    return (count == 0 ? low_.y : site(count - 1).y) + 0.5 * pitch_;
}

std::size_t drawnParticles(const Case& c) {
    double mass = 0;
    std::uint64_t redrawn = 0;
    return drawRadii(c, c.filling.mass, 0, mass, redrawn).size();
}

void Particles::append(const Particles& more) {
    const auto behind = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
    behind(position, more.position);
    behind(velocity, more.velocity);
    behind(spin, more.spin);
    behind(radius, more.radius);
    behind(status, more.status);
    behind(material, more.material);
}

Particles Insertion::allParticles() const {
    Particles all = particles;
    for (const Waiting& w : waiting) all.append(w.particles);
    return all;
}

std::size_t Insertion::firstOf(std::size_t refill) const {
    std::size_t first = particles.size();
    for (std::size_t k = 0; k < refill; ++k) first += waiting[k].particles.size();
    return first;
}

Insertion insertParticles(const Case& c) {
    Insertion result;
    if (c.filling.list) {
        result.particles = *c.filling.list;
        result.mass = result.targetMass = listedMass(c.world, result.particles);
        result.fillHeight = c.world.domain.low.y;
        for (std::size_t i = 0; i < result.particles.size(); ++i)
            result.fillHeight =
                std::max(result.fillHeight, result.particles.position[i].y + result.particles.radius[i]);
        return result;
    }
    const SizeDistribution& size = c.filling.size;
    result.targetMass = c.filling.mass;
    if (size.kind == SizeDistribution::Kind::Quantiles || size.kind == SizeDistribution::Kind::Sieve) {
        result.cutBelow = finerVolume(size, size.radiusMin);
        result.cutAbove = 1 - finerVolume(size, size.radiusMax);
    }
    const InsertionGrid grid(c.filling.region, largestRadius(size), c.filling.gridGap);
    const std::vector<double> radii = drawRadii(c, c.filling.mass, 0, result.mass, result.redrawn);
    result.particles = onGrid(c, grid, radii, 0);
    result.fillHeight = grid.top(radii.size());
    drawRefills(c, result);
    return result;
}

}  // namespace vkdose
