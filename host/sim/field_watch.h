#pragma once
// Takes the fields that a case asks for while a run goes on, and averages them over time. Knows no files.

#include <cstdint>
#include <vector>

#include "host/backend/backend.h"
#include "host/core/record.h"
#include "host/model/case.h"
#include "host/sim/timeline.h"

namespace vkdose {

/// One field of Case::fields, to be kept.
struct FieldSample {
    std::size_t field = 0;  ///< index into Case::fields
    int number = 0;         ///< from 0, of this field
    std::uint64_t step = 0;
    double time = 0;  ///< [s]; of an average its end
    Phase phase = Phase::Settle;
    int dose = 0;  ///< 0 while settling
    FieldPoints points;
    /// HeightProfile: h(z, t) = rho(z, t) / rho(z, 0) h_ini at every point [m], NaN where there was no powder at first
    /// (Imole et al., section on homogenisation). Time 0 is the end of settling.
    std::vector<double> heights;
};

class FieldWatch {
  public:
    FieldWatch(const Case& c, const Timeline& timeline);

    /// Must be called at every sample of the run (a multiple of the sensor interval or the end of a phase). Returns the
    /// fields to be kept.
    std::vector<FieldSample> look(Backend& backend, std::uint64_t step, Phase phase, int dose);

    /// The profiles of a bed that had settled before the run's first step. Call it once, before that step. Other fields
    /// need forces, and there are none before a step.
    std::vector<FieldSample> open(Backend& backend, std::uint64_t step);

    /// The averages under way and the profiles at the beginning, for a checkpoint.
    void save(Record& record) const;
    void restore(const Record& record);

  private:
    struct State {
        FieldPoints sum;
        std::uint64_t summed = 0;
        std::uint64_t kept = 0;
        std::vector<double> initialDensity;  ///< of a height profile, once dosing has begun [kg/m3]
        double initialHeight = 0;            ///< [m]
    };
    static bool isProfile(const FieldSensor& sensor);
    FieldSample sampleOf(std::size_t field, FieldPoints points, std::uint64_t step, Phase phase, int dose);
    std::uint64_t every(const FieldSensor& sensor) const;
    static FieldPoints mean(State& state);
    static void begin(const FieldSensor& sensor, State& state, const FieldPoints& now, Backend& backend);

    const std::vector<FieldSensor>& sensors_;
    const Timeline& timeline_;
    double sensorInterval_;
    std::vector<State> states_;
};

/// Height of a bed's surface above the grid's lower face [m], from its density over y. The surface is the place where,
/// coming from above, the density first reaches half of its largest value (interpolated). Zero without powder.
double surfaceHeight(const FieldGrid& grid, const FieldPoints& points);

}  // namespace vkdose
