#include "host/analysis/outlet.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace vkdose {

namespace {

/// Gathers stretches without flow.
class Stops {
  public:
    void extend(const FlowSample& from, const FlowSample& to) {
        if (now_.dose == 0) now_ = {to.dose, from.time, 0, 0};
        if (to.dose != within_.first) within_ = {to.dose, 0};
        const double time = to.time - from.time;
        now_.time += time;
        now_.turns += std::abs(to.angle - from.angle) / (2 * std::numbers::pi);
        within_.second += time;
        flow_.longestIn[to.dose] = std::max(flow_.longestIn[to.dose], within_.second);
        if (now_.time > flow_.longest.time) flow_.longest = now_;
        // The angle in the table is rounded. The rounding must not make a stop longer than a turn.
        if (now_.turns > 1 + 1e-6 && !flow_.stoppedAt) flow_.stoppedAt = now_.dose;
    }
    void end() {
        now_ = {};
        within_ = {};
    }
    const OutletFlow& flow() const { return flow_; }

  private:
    OutletFlow flow_;
    OutletFlow::Stop now_;             ///< dose 0: the powder flows
    std::pair<int, double> within_{};  ///< a dose, and the part of the stop that lies in it [s]
};

}  // namespace

std::vector<FlowSample> flowSamples(const Table& series) {
    std::vector<FlowSample> samples;
    // Of three directions those that do not repeat have nothing that goes through.
    const bool repeats = series.has("through_x_kg");
    const auto out = [&](std::size_t i) {
        double mass = series.number(i, "dosed_mass_kg");
        if (repeats)
            for (const char* name : {"through_x_kg", "through_y_kg", "through_z_kg"}) mass += series.number(i, name);
        return mass;
    };
    std::vector<std::string> hinges;
    for (const std::string& name : series.names())
        if (name.ends_with(".angle_rad")) hinges.push_back(name);
    for (std::size_t i = 0; i < series.rows(); ++i) {
        samples.push_back({series.number(i, "time_s"), series.text(i, "phase") == "rotate",
                           static_cast<int>(series.number(i, "dose")), series.number(i, "coil_angle_rad"), out(i),
                           series.number(i, "canister_mass_kg") + series.number(i, "throat_mass_kg")});
        for (const std::string& name : hinges) samples.back().hinges.push_back(series.number(i, name));
    }
    return samples;
}

OutletFlow outletFlow(const std::vector<FlowSample>& samples, double filled, double remaining) {
    Stops lead, stops;
    double turned = 0;  // [s]
    bool begun = false;
    FlowSample before;
    before.inside = filled;
    // A run after another's doses has its powder in the first line, before the coil turns. What was out is not of this
    // run.
    if (!samples.empty() && !samples.front().turning && samples.front().angle != 0) before = samples.front();
    for (const FlowSample& s : samples) {
        const bool flowed = s.dosed > before.dosed;
        if (s.turning && !begun) turned += s.time - before.time;
        if (flowed) {
            begun = true;
            stops.end();
        } else if (s.turning && before.inside > remaining * filled) {
            (begun ? stops : lead).extend(before, s);
        }
        before = s;
    }
    OutletFlow flow = begun ? stops.flow() : lead.flow();
    if (begun) flow.lead = turned;
    return flow;
}

}  // namespace vkdose
