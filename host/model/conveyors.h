#pragma once
// The closed form of bodies that carry powder out: screws, wires and meshes that turn steadily.

#include <optional>
#include <string>
#include <vector>

#include "host/model/case.h"

namespace vkdose {

/// What turns about an axis and carries powder along it, as if the powder filled its circle and did not turn with it:
/// in a turn its pitch times the area of its circle without its shaft, less the volume of its blade in a pitch. A wire
/// has the circle of its centre line and leaves nothing out, as in the paper's form.
/// That is the ideal volumetric throughput of a full enclosed screw (Roberts 1999, Powder Technology 104, 56).
struct Conveyor {
    std::string name;
    Vec3 out{0, 0, 1}, through{0};  ///< direction in which it carries powder (unit), and a point of its axis [m]
    double radius = 0;              ///< of the circle that it sweeps [m]
    double section = 0;             ///< area of this circle that it does not fill itself, mean over its length [m2]
    double end = 0;                 ///< its end on the side of `out`, along `out` from the origin [m]
    double lead = 0;                ///< way along `out` in a turn of its own [m]
    double turns = 0;               ///< of its own: in a turn of the drive, or in a second
};

/// Bodies that carry powder out together.
struct Conveyance {
    std::vector<Conveyor> conveyors;  ///< the one that carries most first
    bool byDrive = false;             ///< they follow the drive
    bool inRests = false;             ///< they turn by themselves for the whole dose, rests too

    /// Carried in a turn of the drive, or in a second [m3]. Where the circles of two overlap, the area counts once,
    /// with the mean of what the two carry through it.
    double volume() const;
    std::vector<std::string> names() const;
};

/// None where no body carries powder out by a steady turn. The one that carries most counts, and with it all that
/// follow the same clock, have a parallel axis and end on the same side to within its pitch: the screws of a twin
/// screw.
std::optional<Conveyance> conveyanceOf(const Case& c);

/// The area that two circles share whose centres are `distance` apart [m2].
double sharedArea(double radiusA, double radiusB, double distance);

}  // namespace vkdose
