#pragma once
// The surface of a run's powder, dose by dose, beside what was measured on photographs.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "host/report/player_data.h"

namespace vkdose::report {

/// A measured profile: a CSV with the columns z_mm (from the rear wall) and height_mm (above the floor's lowest point).
struct Photograph {
    std::filesystem::path file;
    std::optional<int> dose;  ///< after which it was taken, 0: before the first; none: the last dose there is
};

/// "FILE" or "FILE@DOSE".
Photograph photographOf(const std::string& argument);

/// Columns of the surface: about a mean radius wide.
std::size_t surfaceColumns(const Case& c, const Particles& particles);

/// `surface` of runJson: the profile of the settled bed and the profile at the last frame of each dose, together with
/// the photographs. Without frames there is one profile, that of the end state, which is dose `lastDose`. Null without
/// a canister or without anything to show. Throws CaseError if a photograph cannot be read or there is no state of its
/// dose.
Json surfaceJson(const Case& c, const FrameSource& frames, const std::optional<Particles>& end, int lastDose,
                 const std::vector<Photograph>& photographs);

}  // namespace vkdose::report
