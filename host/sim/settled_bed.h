#pragma once
// The bed at the end of settling, before the coil turns.

#include <cstddef>
#include <optional>
#include <vector>

#include "host/backend/backend.h"
#include "host/core/record.h"
#include "host/model/case.h"

namespace vkdose {

struct SettledBed {
    double time = 0;      ///< [s]
    Particles particles;  ///< of the fill, dosed ones included
    // Of each pair of particles in contact:
    std::vector<double> pullOff;           ///< strongest pull with the adhesion of the doses, over the lighter's weight
    std::vector<double> overlap;           ///< over the smaller radius
    std::vector<double> largestOverlap;    ///< the contact's largest so far, over the smaller radius
    std::vector<geometry::Pose> bodies{};  ///< of World::bodies
};

SettledBed settledBed(const Case& c, double time, const Particles& particles, const std::vector<Contact>& contacts,
                      std::vector<geometry::Pose> bodies = {});

/// For a checkpoint; radii are not stored.
void put(Record& record, const std::optional<SettledBed>& bed);
/// Nothing if the run had not settled. `filled` gives the radii.
/// Throws RecordError if the arrays do not fit it.
void get(const Record& record, const Particles& filled, std::optional<SettledBed>& bed);

}  // namespace vkdose
