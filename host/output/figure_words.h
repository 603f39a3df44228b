#pragma once
// The figures of the element tests: their names in files, and how people read them.

#include <span>
#include <string>
#include <vector>

#include "host/model/element_test.h"

namespace vkdose {

/// A figure: its name in files, and how people read it.
struct Wording {
    const char *name, *words, *unit;
    double scale = 1;
};

inline constexpr Wording kAngle{"angle_deg", "angle of the surface", "°"};
inline constexpr Wording kTime{"time_s", "at", "s"};

// The figures of each kind of test, in the order of summary.json.
inline constexpr Wording kHeap[] = {
    kAngle,
    {"angle_error_deg", "standard error of the angle", "°"},
    {"height_m", "height", "mm", 1e3},
    {"flank_from_m", "flank from", "mm", 1e3},
    {"flank_to_m", "flank to", "mm", 1e3},
    kTime,
};
inline constexpr Wording kDrum[] = {
    kAngle,
    {"angle_deviation_deg", "deviation from frame to frame", "°"},
    {"frames", "frames", ""},
};
/// With a view through the glass, in their place.
inline constexpr Wording kDrumFront[] = {
    kAngle,
    {"angle_error_deg", "standard error of the angle", "°"},
    {"frames", "frames", ""},
};
inline constexpr Wording kCompression[] = {
    {"max_stress_Pa", "largest stress", "kPa", 1e-3},
    {"loose_density_kg_m3", "loose density", "kg/m³"},
    {"loaded_density_kg_m3", "density under load", "kg/m³"},
    {"released_density_kg_m3", "density after release", "kg/m³"},
    {"elastic_recovery", "elastic recovery", "%", 100},
    {"work_J", "work", "mJ", 1e3},
    {"returned_work_J", "returned work", "mJ", 1e3},
    {"work_J_kg", "work for a mass", "J/kg"},
};
inline constexpr Wording kShear[] = {
    {"friction_angle_deg", "friction angle", "°"},
    {"cohesion_Pa", "cohesion", "kPa", 1e-3},
    {"effective_friction_angle_deg", "friction angle without cohesion", "°"},
};
/// With pre-shear, behind them.
inline constexpr Wording kPreShear[] = {
    {"pre_shear_normal_stress_Pa", "normal stress of the pre-shears", "kPa", 1e-3},
    {"pre_shear_stress_Pa", "shear stress of the pre-shears", "kPa", 1e-3},
    {"consolidation_stress_Pa", "consolidation stress", "kPa", 1e-3},
    {"unconfined_strength_Pa", "unconfined strength", "kPa", 1e-3},
    {"ffc", "ffc", ""},
};
inline constexpr Wording kBulk[] = {
    {"density_kg_m3", "bulk density", "kg/m³"},
    {"solid_fraction", "solid fraction", ""},
    {"volume_m3", "over", "cm³", 1e6},
    kTime,
};
inline constexpr Wording kDischarge[] = {
    {"rate_kg_s", "rate of discharge", "g/s", 1e3},
    {"rate_error_kg_s", "standard error of the rate", "g/s", 1e3},
    {"beverloo_constant", "Beverloo's constant", ""},
};
inline constexpr Wording kContent[] = {
    {"mass_kg", "mass", "g", 1e3},
    {"mass_deviation_kg", "standard deviation of the mass in that time", "g", 1e3},
    {"lines", "lines of the time series", ""},
};
/// Of each point of the yield locus, which are counted from 1. They are told by their names.
inline constexpr const char* kShearPoint[] = {"normal_stress_{}_Pa", "shear_stress_{}_Pa",
                                              "shear_stress_deviation_{}_Pa"};

/// The names of the figures that a measure has, all of which a run may give.
std::vector<std::string> figureNames(const ElementTest& measure);

/// A figure as people read it: "angle of the flank" and "31.2 °". A name that is not known stands for itself.
struct FigureText {
    std::string words, value;
};
FigureText figureText(const std::string& name, double value);

}  // namespace vkdose
