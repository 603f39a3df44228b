#pragma once
// Powders by their laboratory figures. A table of element tests over friction, rolling friction, Bond number and
// restitution stands for powders of all kinds. From it follows, without a run, the distribution of the parameters with
// which spheres say in the tests what a laboratory sheet says.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "host/study/calibration_finding.h"
#include "host/study/laboratory_sheet.h"

namespace vkdose {

struct LikePowder {
    CalibrationFinding finding;         ///< its targets are what the sheet says; it has a fit, and no points
    double density = 0;                 ///< of the spheres: given, or such that their bed has the bulk density [kg/m3]
    std::optional<double> bulkDensity;  ///< poured [kg/m3], if it is known
    double load = 0;                    ///< pre-shear stress that the figures of the ring shear tester are at [Pa]
    /// What the table says of figures that the sheet does not have, over the draws.
    struct Foretold {
        std::string name, unit;
        Belief belief;
    };
    std::vector<Foretold> foretold;
    std::vector<std::string> beyond;  ///< sentences that tell where the table ends before the powder
};

/// The powder of a sheet, by the tables in `folder`: the studies bulk, heap, drum and ring-shear, and beside each the
/// figures of its members as a CSV. Throws RunError if the sheet has no figure that tells the parameters, CaseError if
/// a table that it needs is damaged or missing.
LikePowder powderLike(const LaboratorySheet& sheet, const std::filesystem::path& folder);

/// The text of a powder file with this powder. `draws` is the name of the file with its draws.
std::string powderFileText(const LaboratorySheet& sheet, const LikePowder& like, const std::filesystem::path& folder,
                           const std::string& draws);

}  // namespace vkdose
