#pragma once
// A powder in a file of its own: what a laboratory measured of it, the spheres that stand for it, and what these were
// held against. A case takes it by its key powder_file.

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/core/key.h"
#include "host/model/case.h"
#include "host/model/case_tree.h"

namespace vkdose {

struct PowderFile {
    /// A figure of the powder, as published.
    struct Laboratory {
        std::string figure, unit, method, source;
        double value = 0;
        std::optional<double> error;  ///< as the source states it
        bool fitted = false;          ///< the draws were chosen by it
    };
    /// A figure that the spheres were held against.
    struct Held {
        std::string test;    ///< the case whose run gives it, relative to the file
        std::string figure;  ///< as in summary.json: "heap.angle_deg"
        double measured = 0, simulated = 0;
        std::optional<double> measuredError, simulatedError;
        bool fitted = false;  ///< the parameters were chosen by it; else it was predicted
        std::string note;
    };
    std::filesystem::path file;
    std::string title;   ///< "Glass beads, 1 mm"
    std::string limits;  ///< what it is not known for
    std::vector<Laboratory> laboratory;
    std::vector<Held> held;
    std::optional<std::filesystem::path> draws;  ///< a CSV: a column for each key of a case, a row for each draw
    Node spheres;                                ///< the tables of a case: [particles], [contact]
};

/// Throws CaseError with every fault of the file, but for those of the case's own keys: these the case tells.
PowderFile readPowderFile(const std::filesystem::path& file);

/// The spheres of a powder by themselves, as every case with its file has them.
struct PowderSpheres {
    SizeDistribution size;
    double density = 0;                 ///< [kg/m3]
    std::optional<double> bulkDensity;  ///< of their settled bed, if the file states it as a number [kg/m3]
    bool stressScaled = false;          ///< contact.scaling = "stress": larger spheres have contacts that follow
};

/// Throws CaseError with the faults of the keys that these are read from.
PowderSpheres spheresOf(const PowderFile& powder);

/// Every key of such a file that is not a case's.
std::span<const KeyTable> powderFileKeys();

/// Lays `upper` over `lower`. If it names a powder_file, that powder takes the place of the one in `lower` first: its
/// sizes and its contacts with itself, with the wall and with the coil, how these settle, and the time step that was
/// stated for them. Pairs with further materials and contact.max_overlap_ratio stay. The powder's file is added to
/// `files`.
void layOver(Node& lower, Node upper, std::vector<std::filesystem::path>& files);

}  // namespace vkdose
