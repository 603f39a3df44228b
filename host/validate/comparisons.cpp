#include "host/validate/comparisons.h"

namespace vkdose::validate {

const std::vector<Comparison>& comparisons() {
    static const std::vector<Comparison> kAll{
        {"beverloo", "rate of discharge through holes in a flat floor",
         "W. A. Beverloo, H. A. Leniger, J. van de Velde, Chem. Eng. Sci. 15 (1961) 260", beverloo},
        {"anand", "mass that leaves a rectangular hopper over time, in a slice that repeats",
         "A. Anand, J. S. Curtis, C. R. Wassgren, B. C. Hancock, W. R. Ketterhagen, Chem. Eng. Sci. 63 (2008) 5821",
         anand},
        {"heap", "angle of repose over friction, rolling friction and size",
         "Y. C. Zhou, B. H. Xu, A. B. Yu, P. Zulli, Powder Technol. 125 (2002) 45", heap},
        {"plane-shear", "stresses and volume of a layer that is sheared steadily under a load",
         "S. Chialvo, J. Sun, S. Sundaresan, Phys. Rev. E 85 (2012) 021305; "
         "P. Jop, Y. Forterre, O. Pouliquen, Nature 441 (2006) 727; LAMMPS with the same spheres",
         planeShear},
        {"ring-shear", "angles of beads in a ring shear cell",
         "table of a Bulk Solids Centre, measured with a ring shear tester RST-01", ringShear},
        {"screw", "mass rate of a turn of an endless screw over speed, fill and slope",
         "P. J. Owen, P. W. Cleary, Powder Technol. 193 (2009) 274; A. W. Roberts, Powder Technol. 104 (1999) 56",
         screw},
        {"long-screw", "mass rate of a long screw beside that of one turn whose domain repeats",
         "none: both are vkdose", longScrew},
        {"dosta-silo", "spheres left in a silo over time, two materials and two holes",
         "M. Dosta and others, Comput. Phys. Commun. 296 (2024) 109066", dostaSilo},
        {"dosta-drum", "two powders in a drum: the spheres of each in two quadrants over time",
         "M. Dosta and others, Comput. Phys. Commun. 296 (2024) 109066", dostaDrum},
        {"dosta-ball", "depth of a steel ball of 20 mm that falls into spheres of 2 mm",
         "M. Dosta and others, Comput. Phys. Commun. 296 (2024) 109066", dostaBall},
    };
    return kAll;
}

const std::vector<Missing>& missingComparisons() {
    static const std::vector<Missing> kAll{
        {"published curves", "the curves of Chung and Ooi (2011) and of Dosta and others (2024)",
         "they are figures in the papers and not public as numbers; other programs stand in for them"},
    };
    return kAll;
}

}  // namespace vkdose::validate
