#pragma once
// What a device answers when a user's law is tried, before any run.

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "host/law/law_program.h"
#include "host/model/case_reader.h"
#include "host/model/checks.h"

namespace vkdose {

/// A contact that is pressed at a constant speed to its deepest overlap and drawn apart again, to the end of its reach.
struct LawLoading {
    std::array<double, kMostLawParameters> own{};
    double radius = 0;   ///< reduced [m]
    double mass = 0;     ///< reduced [kg]
    double deepest = 0;  ///< overlap [m]
    double speed = 0;    ///< of approach, then of parting [m/s]
    LawSides sides;
};

/// What the law answers at a point of a loading.
struct LawPoint {
    double overlap = 0;  ///< [m]
    double speed = 0;    ///< of approach [m/s]
    double force = 0, stiffness = 0, damping = 0, pull = 0, energy = 0;
    double reach = 0;  ///< the same at all points [m]
    LawProperties flows{};
};

/// A law that the compiler refuses.
struct LawError {
    std::vector<LawFault> faults;
};

/// Of each loading its points in their order. Throws LawError, and DeviceError if there is no device to try it on.
using LawTrial =
    std::function<std::vector<std::vector<LawPoint>>(const UserLaw& law, const std::vector<LawLoading>& loadings)>;

/// Sets how laws are tried in this process. Without it a case with a user's law is at fault.
void setLawTrial(LawTrial trial);

/// Tries the law of a case that has one, over its sizes, up to its largest overlap, and at rest and in motion. Notes
/// faults of what it answers; writes stiffness and damping into the case's contact parameters.
void tryUserLaw(CaseReader& reader, Case& c, const PowderSizes& sizes);

}  // namespace vkdose
