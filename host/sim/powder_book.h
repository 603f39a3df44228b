#pragma once
// Where each of several powders is, and what a dose has of each.

#include <cstdint>
#include <vector>

#include "host/core/columns.h"
#include "host/core/record.h"
#include "host/model/particles.h"
#include "host/model/world.h"

namespace vkdose {

/// Where the particles of one powder are.
struct PowderPlaces {
    double canister = 0, throat = 0, dosed = 0;  ///< mass [kg]
    std::uint64_t canisterCount = 0, throatCount = 0, dosedCount = 0;
};

/// The columns of timeseries.csv for each powder, where there are several. The name of the powder and a dot stand
/// before each.
inline constexpr auto kPowderColumns =
    columns(column<&PowderPlaces::dosed>("dosed_mass_kg", "kg", "Mass of the powder that has been dosed so far."),
            column<&PowderPlaces::canister>("canister_mass_kg", "kg", "Mass of the powder in the canister."),
            column<&PowderPlaces::throat>("throat_mass_kg", "kg", "Mass of the powder in the throat of the outlet."),
            column<&PowderPlaces::dosedCount>("dosed_count", "1", "Number of its particles that have been dosed."),
            column<&PowderPlaces::canisterCount>("canister_count", "1", "Number of its particles in the canister."),
            column<&PowderPlaces::throatCount>("throat_count", "1", "Number of its particles in the throat."));

/// What a dose has of one powder.
struct PowderDose {
    double mass = 0;  ///< [kg]
    std::uint64_t particles = 0;
    double share = 0;  ///< of the dose's mass [-]; NaN in an empty dose
};

/// The columns of doses.csv for each powder, likewise.
inline constexpr auto kPowderDoseColumns =
    columns(column<&PowderDose::mass>("dose_mass_kg", "kg", "Mass of the powder in the dose."),
            column<&PowderDose::particles>("dose_count", "1", "Number of its particles in the dose."),
            column<&PowderDose::share>("dose_share", "1", "Its share of the dose's mass; nan in an empty dose."));

/// Counts the particles of each powder by their place. Of a world with one powder it keeps nothing.
class PowderBook {
  public:
    explicit PowderBook(const World& world);

    bool empty() const { return places_.empty(); }
    /// Counts anew. The places are those of the particles' centres.
    void look(const Particles& particles);
    /// In the order of the case; none with one powder.
    const std::vector<PowderPlaces>& places() const { return places_; }

    void openDose() { before_ = places_; }
    std::vector<PowderDose> sinceDose() const;

    /// For a checkpoint, and back; nothing with one powder. Throws RecordError if the record has other powders.
    void save(Record& record) const;
    void restore(const Record& record);

  private:
    const World& world_;
    std::vector<int> powderOf_;                  ///< of each material; -1: none
    std::vector<PowderPlaces> places_, before_;  ///< now; at the start of the dose
};

}  // namespace vkdose
