// From a validated case to its particles: draw sizes up to the mass, stack them on a grid.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "host/core/random.h"
#include "host/model/case.h"
#include "host/model/grid.h"
#include "host/model/powders.h"
#include "host/model/refill.h"
#include "host/model/size_distribution.h"

namespace vkdose {
namespace {

/// Draws radii of a powder, from the draw `first` on, until one more would not bring the mass closer to the target.
/// Adds to `mass` and `redrawn`.
std::vector<double> drawRadii(const Case& c, const PowderOf& powder, double target, std::uint64_t first, double& mass,
                              std::uint64_t& redrawn) {
    const double density = c.world.density(powder.material);
    std::vector<double> radii;
    for (std::uint64_t index = first;; ++index) {
        const double r = drawRadius(powder.filling.size, c.seed, index, redrawn);
        const double next = mass + sphereMass(density, r);
        if (std::abs(next - target) >= std::abs(mass - target)) break;
        radii.push_back(r);
        mass = next;
    }
    return radii;
}

/// Most sites in a row, more than any case can fill. The limit keeps the number of sites of an open or absurd region
/// representable.
constexpr double kMaxSites = 1e9;

/// Adds particles of a powder with these radii on the grid. `first` is the draw of the first of them. With `sites` they
/// take those, from `first` on, else the grid's in their order.
void addOnGrid(const Case& c, const InsertionGrid& grid, const std::vector<double>& radii, std::uint64_t first,
               int material, Particles& particles, const std::vector<std::uint64_t>& sites = {}) {
    if (static_cast<double>(radii.size()) > grid.capacity())
        throw std::logic_error("the grid is too small for the powder");  // loadCase refuses such a case
    for (std::size_t i = 0; i < radii.size(); ++i) {
        const std::uint64_t site = sites.empty() ? i : sites.at(first + i);
        particles.add(grid.site(site) + jitter(c.seed, first + i, grid.jitterAmplitude()), radii[i], Vec3(0), Vec3(0),
                      material);
    }
}

/// The numbers below `count` in an order that the seed sets (Fisher and Yates).
std::vector<std::uint64_t> shuffled(std::uint64_t seed, std::uint64_t count) {
    std::vector<std::uint64_t> order(count);
    std::iota(order.begin(), order.end(), std::uint64_t{0});
    for (std::uint64_t i = count; i > 1; --i) {
        const double u = uniforms(seed, Stream::Shuffle, i)[0];
        std::swap(order[i - 1], order[std::min(i - 1, static_cast<std::uint64_t>(u * static_cast<double>(i)))]);
    }
    return order;
}

/// The radii of a powder of the fill.
struct Drawn {
    PowderOf powder;
    std::uint64_t first = 0;  ///< draw of the first of them
    std::vector<double> radii;
};

/// Draws the radii of all powders, one after the other. The draws are numbered on from powder to powder.
std::vector<Drawn> drawFill(const Case& c, Insertion& result) {
    std::vector<Drawn> all;
    std::uint64_t draws = 0;
    for (const PowderOf& powder : powdersOf(c)) {
        double mass = 0;
        all.push_back({powder, draws, drawRadii(c, powder, powder.filling.mass, draws, mass, result.redrawn)});
        draws += all.back().radii.size();
        result.mass += mass;
        result.targetMass += powder.filling.mass;
        result.powders.push_back({all.back().radii.size(), mass, powder.filling.mass});
    }
    return all;
}

/// Puts each powder on a grid of its own. In a canister it stands on the one before.
void fillApart(const Case& c, const std::vector<Drawn>& all, Insertion& result) {
    double top = c.filling.region.low.y;
    for (const Drawn& d : all) {
        Box region = d.powder.filling.region;
        if (c.canister) region = {Vec3(c.filling.region.low.x, top, c.filling.region.low.z), c.filling.region.high};
        const SizeDistribution& size = d.powder.filling.size;
        const InsertionGrid grid = d.powder.filling.sites
                                       ? gridOfFill(c)
                                       : InsertionGrid(region, largestRadius(size), d.powder.filling.gridGap);
        addOnGrid(c, grid, d.radii, d.first, d.powder.material, result.particles);
        top = grid.top(d.radii.size());
        result.fillHeight = std::max(result.fillHeight, top);
    }
}

/// Puts all powders at random places of one grid, in the region of the first.
void fillMixed(const Case& c, const std::vector<Drawn>& all, Insertion& result) {
    const InsertionGrid grid = gridOfFill(c);
    const std::uint64_t count = all.back().first + all.back().radii.size();
    const std::vector<std::uint64_t> sites = shuffled(c.seed, count);
    for (const Drawn& d : all) addOnGrid(c, grid, d.radii, d.first, d.powder.material, result.particles, sites);
    result.fillHeight = grid.top(count);
}

/// The draws of the refills go on where those of the filling end.
void drawRefills(const Case& c, Insertion& result) {
    std::uint64_t draws = result.particles.size();
    for (const Refill& refill : c.refills) {
        Insertion::Waiting& waiting = result.waiting.emplace_back();
        const PowderOf powder = powdersOf(c)[powderIndex(c, refill.material)];
        const Box region = refillRegion(c, refill);
        const InsertionGrid grid(region, largestRadius(powder.filling.size), powder.filling.gridGap);
        const std::vector<double> radii = drawRadii(c, powder, refill.mass, draws, waiting.mass, result.redrawn);
        addOnGrid(c, grid, radii, draws, refill.material, waiting.particles);
        waiting.particles.status.assign(radii.size(), Status::Waiting);
        waiting.height = c.filling.sites ? 0 : grid.top(radii.size()) - region.low.y;
        draws += radii.size();
    }
}

/// How much of a list is of one powder. What is there is what was asked for.
Insertion::Share shareOf(const Case& c, const Particles& list, int material) {
    Insertion::Share share;
    for (std::size_t i = 0; i < list.size(); ++i) {
        if (list.material[i] != material) continue;
        share.particles += 1;
        share.mass += massOf(c.world, list, i);
    }
    share.targetMass = share.mass;
    return share;
}

}  // namespace

Vec3 jitter(std::uint64_t seed, std::uint64_t draw, double amplitude) {
    const auto [x, y] = uniforms(seed, Stream::Jitter, draw, 0);
    const auto [z, unused] = uniforms(seed, Stream::Jitter, draw, 1);
    (void)unused;
    return amplitude * (2.0 * Vec3(x, y, z) - 1.0);
}

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

InsertionGrid::InsertionGrid(InsertionGrid whole, std::shared_ptr<const std::vector<std::uint64_t>> sites)
    : InsertionGrid(std::move(whole)) {
    sites_ = std::move(sites);
}

std::vector<std::uint64_t> InsertionGrid::beside(std::uint64_t index) const {
    const std::uint64_t column = index % columns_, row = index / columns_ % rows_, layer = index / columns_ / rows_;
    std::vector<std::uint64_t> sites;
    const auto add = [&](std::uint64_t at, std::uint64_t count, std::uint64_t step) {
        if (at > 0) sites.push_back(index - step);
        if (at + 1 < count) sites.push_back(index + step);
    };
    add(column, columns_, 1);
    add(row, rows_, columns_);
    add(layer, static_cast<std::uint64_t>(layers_), columns_ * rows_);
    return sites;
}

Vec3 InsertionGrid::site(std::uint64_t index) const {
    if (sites_) index = sites_->at(index);
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
    if (sites_) return static_cast<double>(sites_->size());
    return static_cast<double>(columns_) * static_cast<double>(rows_) * layers_;
}

double InsertionGrid::jitterAmplitude() const {
    return 0.25 * pitch_ * gap_ / (1 + gap_);
}

double InsertionGrid::top(std::uint64_t count) const {
    return (count == 0 ? low_.y : site(count - 1).y) + 0.5 * pitch_;
}

InsertionGrid gridOfFill(const Case& c) {
    double largest = largestRadius(c.filling.size);
    if (c.mixed)
        for (const PowderOf& powder : powdersOf(c)) largest = std::max(largest, largestRadius(powder.filling.size));
    const InsertionGrid whole(c.filling.region, largest, c.filling.gridGap);
    return c.filling.sites ? InsertionGrid(whole, c.filling.sites) : whole;
}

std::vector<std::size_t> drawnParticles(const Case& c) {
    Insertion drawn;
    std::vector<std::size_t> counts;
    for (const Drawn& d : drawFill(c, drawn)) counts.push_back(d.radii.size());
    return counts;
}

void Particles::append(const Particles& more) {
    const auto behind = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
    behind(position, more.position);
    behind(velocity, more.velocity);
    behind(spin, more.spin);
    behind(radius, more.radius);
    behind(status, more.status);
    behind(material, more.material);
    behind(properties, more.properties);
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

namespace {

/// The properties that a user's law gives each particle: those of its material, unless a list gives its own.
void setProperties(const Case& c, Particles& p) {
    if (!c.dosingLaw.user || c.dosingLaw.user->properties.empty()) return;
    LawProperties unset;
    unset.fill(kNaN);
    p.properties.resize(p.size(), unset);
    for (std::size_t i = 0; i < p.size(); ++i)
        for (std::size_t k = 0; k < unset.size(); ++k)
            if (std::isnan(p.properties[i][k])) p.properties[i][k] = c.world.materials[p.material[i]].properties[k];
}

}  // namespace

Insertion insertParticles(const Case& c) {
    Insertion result;
    result.fillHeight = -std::numeric_limits<double>::infinity();
    if (c.filling.list) {
        result.particles = *c.filling.list;
        result.mass = result.targetMass = fillOf(c).mass;
        for (const PowderOf& p : powdersOf(c)) result.powders.push_back(shareOf(c, result.particles, p.material));
        result.fillHeight = c.world.domain.low.y;
        for (std::size_t i = 0; i < result.particles.size(); ++i)
            result.fillHeight =
                std::max(result.fillHeight, result.particles.position[i].y + result.particles.radius[i]);
        setProperties(c, result.particles);
        return result;
    }
    const SizeDistribution& size = c.filling.size;
    if (size.kind == SizeDistribution::Kind::Quantiles || size.kind == SizeDistribution::Kind::Sieve) {
        result.cutBelow = finerVolume(size, size.radiusMin);
        result.cutAbove = 1 - finerVolume(size, size.radiusMax);
    }
    const std::vector<Drawn> all = drawFill(c, result);
    c.mixed ? fillMixed(c, all, result) : fillApart(c, all, result);
    drawRefills(c, result);
    setProperties(c, result.particles);
    for (Insertion::Waiting& waiting : result.waiting) setProperties(c, waiting.particles);
    return result;
}

}  // namespace vkdose
