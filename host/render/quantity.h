#pragma once
// The quantities that the colour of a particle may show, and the scale beside the picture.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host/model/case.h"
#include "host/sim/frame.h"

namespace vkdose::render {

/// The last one is the first property that a user's law gives each particle; further ones follow it.
enum class Quantity { KineticEnergy, Speed, Overlap, Radius, FillLayer, Powder, Property };

/// As on the command line, in the order of Quantity.
inline constexpr const char* kQuantityNames[] = {"kinetic-energy", "speed",      "overlap",
                                                 "radius",         "fill-layer", "powder"};
/// `properties` are those of World.
std::optional<Quantity> quantityNamed(std::string_view name, const std::vector<std::string>& properties = {});

/// The values of every particle, in SI: m v^2/2 of the centre, |v|, the largest overlap over the smaller radius, the
/// radius, the height (y) in `fill`, the state when the powder had settled, or the number of the powder, from 0.
/// Without `fill` the height is NaN, and so is a property that the frame does not have.
std::vector<double> valuesOf(Quantity quantity, const Case& c, const Frame& frame, const Particles* fill);

/// Values to places on the colour map.
struct Scale {
    std::string title;         ///< what is told, with the unit of the ticks
    double unit = 1;           ///< of the ticks, in SI
    double low = 0, high = 1;  ///< in SI, low < high
    bool logarithmic = false;
    int bands = 0;                     ///< equal bands of one colour each; 0: no bands
    std::vector<std::string> names{};  ///< of the bands, in place of ticks

    /// The place on the scale: 0 at `low`, 1 at `high`, less than 0 or more than 1 beyond.
    double along(double value) const;
    /// As `along`, but with bands it is the place of the middle of the value's band.
    double place(double value) const;
    /// The colour of a value (sRGB).
    Vec3 colour(double value) const;

    struct Tick {
        double place;
        std::string text;
    };
    std::vector<Tick> ticks() const;
};

/// The range that a user asks for, in the unit of the ticks.
struct Range {
    std::optional<double> from, to;
};

/// A scale that all pictures of a run share wherever possible. Speed reaches up to the speed of the turning coil's
/// wire. Kinetic energy reaches up to that of a sphere of mean mass at this speed, and three decades down. Overlap goes
/// from 0.001 to 1. Radius and layer go from the least to the largest value. Each powder has a
/// band. A property goes from the least to the largest value. Without a coil that turns, speed and
/// kinetic energy reach up to the largest of `values`. Throws std::invalid_argument, saying why, if the range asked for
/// is empty or, on a logarithmic scale, not positive.
Scale scaleFor(Quantity quantity, const Case& c, const std::vector<double>& values, const Range& range = {});

}  // namespace vkdose::render
