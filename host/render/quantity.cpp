#include "host/render/quantity.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "host/analysis/overlap.h"
#include "host/model/powders.h"
#include "host/render/colour.h"

namespace vkdose::render {

namespace {

constexpr double kDecades = 3;  // of kinetic energy, 1.5 of speed
constexpr int kLayers = 8;
constexpr double kMostTicks = 7;

/// The least of 1, 2, 5, 10 ... that is not below x.
double roundedUp(double x) {
    const double decade = std::pow(10.0, std::floor(std::log10(x)));
    for (const double step : {1.0, 2.0, 5.0})
        if (x <= step * decade * (1 + 1e-9)) return step * decade;
    return 10 * decade;
}

struct Extremes {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    explicit Extremes(const std::vector<double>& values) {
        for (const double v : values) {
            if (!std::isfinite(v)) continue;
            low = std::min(low, v);
            high = std::max(high, v);
        }
    }
    bool none() const { return low > high; }
};

/// Speed of the coil's wire while it turns; 0 if it never turns.
double wireSpeed(const Case& c) {
    return c.world.coil && c.schedule.rotateTime > 0 ? c.schedule.coilSpeed * c.world.coil->radius : 0.0;
}

/// Mean mass of a sphere, from the radii the case draws from; of a list, its own.
double meanMass(const Case& c) {
    const Insertion filled = insertParticles(c);
    return filled.particles.size() > 0 ? filled.mass / double(filled.particles.size()) : 0.0;
}

std::size_t propertyOf(Quantity quantity) {
    return static_cast<std::size_t>(static_cast<int>(quantity) - static_cast<int>(Quantity::Property));
}

/// Sets the ends apart, so that equal values have a colour too.
void spread(Scale& s, const Extremes& e) {
    s.low = e.none() ? 0 : e.low;
    s.high = e.none() ? 1 : e.high;
    const double least = 1e-3 * std::max(std::abs(s.high), std::abs(s.low));
    if (s.high - s.low <= least) {
        s.low -= std::max(least, 1e-9);
        s.high += std::max(least, 1e-9);
    }
}

Scale energyScale(const Case& c, const Extremes& e) {
    Scale s{"kinetic energy [nJ]", 1e-9};
    s.logarithmic = true;
    const double speed = wireSpeed(c);
    const double most = speed > 0 ? 0.5 * meanMass(c) * speed * speed : e.none() ? 0.0 : e.high;
    s.high = std::pow(10.0, std::ceil(std::log10(std::max(most, 1e-18)) - 1e-9));
    s.low = s.high * std::pow(10.0, -kDecades);
    return s;
}

Scale speedScale(const Case& c, const Extremes& e) {
    Scale s{"speed [mm/s]", 1e-3};
    const double speed = wireSpeed(c);
    s.high = roundedUp(std::max(speed > 0 ? speed : e.none() ? 0.0 : e.high, 1e-9));
    return s;
}

void apply(const Range& range, Scale& s) {
    if (range.from) s.low = *range.from * s.unit;
    if (range.to) s.high = *range.to * s.unit;
    if (!(s.low < s.high) || !std::isfinite(s.low) || !std::isfinite(s.high))
        throw std::invalid_argument(fmt::format("colours from {:.4g} to {:.4g} ({}): the range is empty",
                                                s.low / s.unit, s.high / s.unit, s.title));
    if (s.logarithmic && !(s.low > 0))
        throw std::invalid_argument(
            fmt::format("colours from {:.4g} ({}): the scale is logarithmic; begin above 0", s.low / s.unit, s.title));
}

}  // namespace

std::optional<Quantity> quantityNamed(std::string_view name, const std::vector<std::string>& properties) {
    const auto among = [&](const auto& names, Quantity first) -> std::optional<Quantity> {
        const auto found = std::find(std::begin(names), std::end(names), name);
        if (found == std::end(names)) return {};
        return static_cast<Quantity>(static_cast<int>(first) + int(found - std::begin(names)));
    };
    const std::optional<Quantity> usual = among(kQuantityNames, Quantity::KineticEnergy);
    return usual ? usual : among(properties, Quantity::Property);
}

std::vector<double> valuesOf(Quantity quantity, const Case& c, const Frame& frame, const Particles* fill) {
    const Particles& p = frame.particles;
    if (quantity == Quantity::Overlap) return overlapRatios(p, c.world, frame.coilAngle, frame.time, frame.bodiesMoved);
    if (quantity == Quantity::Radius) return p.radius;
    if (quantity == Quantity::Powder) {
        std::vector<double> numbers;
        for (const std::uint8_t m : p.material) numbers.push_back(static_cast<double>(powderIndex(c, m)));
        return numbers;
    }
    std::vector<double> values(p.size(), std::numeric_limits<double>::quiet_NaN());
    if (quantity >= Quantity::Property) {
        for (std::size_t i = 0; i < p.properties.size(); ++i) values[i] = p.properties[i].at(propertyOf(quantity));
        return values;
    }
    for (std::size_t i = 0; i < p.size(); ++i) {
        const double square = glm::dot(p.velocity[i], p.velocity[i]);
        if (quantity == Quantity::KineticEnergy) values[i] = 0.5 * massOf(c.world, p, i) * square;
        if (quantity == Quantity::Speed) values[i] = std::sqrt(square);
        if (quantity == Quantity::FillLayer && fill != nullptr && i < fill->size()) values[i] = fill->position[i].y;
    }
    return values;
}

double Scale::along(double value) const {
    return logarithmic ? std::log(value / low) / std::log(high / low) : (value - low) / (high - low);
}

double Scale::place(double value) const {
    const double t = along(value);
    if (bands == 0 || !(t >= 0) || !(t <= 1)) return t;
    return (std::min(std::floor(t * bands), bands - 1.0) + 0.5) / bands;
}

Vec3 Scale::colour(double value) const {
    return mapColour(place(value));
}

std::vector<Scale::Tick> Scale::ticks() const {
    std::vector<Tick> ticks;
    const auto add = [&](double shown) {
        const double t = along(shown * unit);
        if (t > -1e-6 && t < 1 + 1e-6)
            ticks.push_back({t, fmt::format("{:.4g}", std::abs(shown) < 1e-12 ? 0.0 : shown)});
    };
    if (!names.empty()) {
        for (std::size_t k = 0; k < names.size(); ++k) ticks.push_back({along(static_cast<double>(k)), names[k]});
    } else if (logarithmic) {
        const int first = int(std::ceil(std::log10(low / unit) - 1e-6)), last = int(std::log10(high / unit) + 1e-6);
        const int stride = std::max(1, int(std::ceil((last - first) / kMostTicks)));
        for (int decade = first; decade <= last; decade += stride) add(std::pow(10.0, decade));
    } else {
        const double step = roundedUp((high - low) / unit / kMostTicks);
        const double first = std::ceil(low / unit / step - 1e-6);
        const int count = int(std::floor(high / unit / step + 1e-6 - first)) + 1;
        for (int k = 0; k < count; ++k) add((first + k) * step);
    }
    return ticks;
}

Scale scaleFor(Quantity quantity, const Case& c, const std::vector<double>& values, const Range& range) {
    const Extremes e(values);
    Scale s;
    switch (quantity) {
        case Quantity::KineticEnergy:
            s = energyScale(c, e);
            break;
        case Quantity::Speed:
            s = speedScale(c, e);
            break;
        case Quantity::Overlap:
            s = {"overlap / radius", 1, 1e-3, 1, true};
            break;
        case Quantity::Radius:
            s = {"radius [mm]", 1e-3};
            spread(s, e);
            break;
        case Quantity::FillLayer:
            s = {"height when settled [mm]", 1e-3};
            s.bands = kLayers;
            spread(s, e);
            break;
        case Quantity::Powder:
            s = {"powder"};
            for (const PowderOf& powder : powdersOf(c)) s.names.push_back(powder.name);
            s.bands = static_cast<int>(s.names.size());
            s.low = -0.5;
            s.high = s.bands - 0.5;
            break;
        default:
            s = {c.world.properties.at(propertyOf(quantity))};
            spread(s, e);
    }
    apply(range, s);
    return s;
}

}  // namespace vkdose::render
