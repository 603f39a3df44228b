#pragma once
// The table of figures at the head of a run's report.

#include "host/analysis/figures.h"
#include "host/core/csv_table.h"
#include "host/model/case.h"
#include "host/report/run_report.h"

namespace vkdose::report {

struct RunSources {
    const Case& c;
    const Table& series;
    std::vector<Dose> doses;
    Json summary;                        ///< null while the run goes on
    std::optional<Particles> particles;  ///< the end state
    BodyPoses bodies = {};               ///< there
};

/// The particles of a run's particles.csv; dosed and lost ones with their status.
Particles endParticles(const std::filesystem::path& file, const Case& c);

/// Whether the figures of the flow come before those of the doses: of a feeder, which doses once or not at all and has
/// a steady mass rate of more than three times its standard error.
bool rateLeads(const RunSources& run);

/// What the canister was given until the last line of the time series [kg]; before the first line, the fill.
double filledMass(const RunSources& run);
/// The same with the refills that the summary tells.
Supply supplyOf(const RunSources& run);

/// [{"name", "value", "note"}, ...]. The value has its unit; the note gives the rule where a rule decides. Figures are
/// left out for which the run is too short.
Json runFacts(const RunSources& run);

}  // namespace vkdose::report
