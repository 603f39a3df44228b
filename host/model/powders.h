#pragma once
// The powders of a case, one or several: their names, sizes and amounts.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "host/model/case.h"
#include "host/model/grid.h"

namespace vkdose {

/// A powder of a case as its fill has it. It refers to the case.
struct PowderOf {
    const std::string& name;
    int material;            ///< World::materials
    const Filling& filling;  ///< its list, if the case has one, holds the particles of all powders
    std::string path;        ///< of its table: "particles", "powder[0]"
};

/// In the order of the file: that of [particles], then each [[powder]].
std::vector<PowderOf> powdersOf(const Case& c);

/// Index of the powder of this material among `powdersOf`.
std::size_t powderIndex(const Case& c, int material);

/// The fill: its mass [kg], and the volume of its particles without voids [m3]. Refills are not in it.
struct Fill {
    double mass = 0, volume = 0;
};
Fill fillOf(const Case& c);

/// The grid that the first powder starts from, or all that are mixed: the part of it that is in the vessel, once
/// findVessel has found that.
InsertionGrid gridOfFill(const Case& c);

/// Density of the particles of a powder [kg/m3]; of all the mean over the volume of the fill.
double solidDensity(const Case& c, std::optional<int> material = {});

}  // namespace vkdose
