#pragma once
// What a case asks to be measured on its powder: an element test, a table [[measure]].

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "host/core/vec.h"

namespace vkdose {

struct ElementTest {
    enum class Kind { AngleOfRepose, DrumAngle, Compression, Shear, BulkDensity, Discharge, Content };
    /// The words for the kinds in files, in their order.
    static constexpr const char* kKinds = "angle_of_repose drum_angle compression shear bulk_density discharge content";

    /// How the surface of the powder is looked at.
    enum class View {
        Bulk,   ///< all of it, as seen from above
        Front,  ///< DrumAngle: as averaged photographs through the front glass show it
        Side,   ///< AngleOfRepose: as photographs from the side show it
    };
    static constexpr const char* kViews = "bulk front side";

    /// A time over which a figure is taken [s].
    struct Window {
        double from = 0, to = 0;
    };

    std::string name;
    Kind kind = Kind::AngleOfRepose;
    View view = View::Bulk;
    double halfWidth = 0;  ///< DrumAngle, Front: the line is fitted where |x| is less [m]
    /// The bodies that bear the load, or the drum: places in World::bodies.
    std::vector<std::size_t> bodies;
    std::size_t region = 0;      ///< Discharge, Content: place in World::regions
    double hole = 0;             ///< Discharge: diameter of the round hole [m]; 0: not given
    Vec3 at{0};                  ///< AngleOfRepose, BulkDensity: a point of the upright axis at the foot [m]
    double radius = 0;           ///< BulkDensity: of the container; Shear: outer [m]
    double innerRadius = 0;      ///< Shear [m]
    double area = 0;             ///< Compression: cross-section of the bed [m2]
    double height = 0;           ///< Compression: from the floor to the piston's place at the start [m]
    Vec3 axis{0, 1, 0};          ///< Compression: from the floor to the piston, a unit vector
    std::optional<double> time;  ///< AngleOfRepose, BulkDensity: of the frame that is looked at [s]; none: the end
    /// DrumAngle: one, over whose frames the angle is taken. Discharge: one, over which the rate is taken. Content:
    /// one, over which the mean is taken. Shear: one for each point of the yield locus.
    std::vector<Window> windows;
    std::vector<Window> preShears;  ///< Shear: of each point, the steady flow before it; empty without
};

}  // namespace vkdose
