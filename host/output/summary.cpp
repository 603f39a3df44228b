#include "host/output/summary.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "host/analysis/closed_form.h"
#include "host/analysis/figures.h"
#include "host/analysis/settled_figures.h"
#include "host/analysis/targets.h"
#include "host/core/file.h"
#include "host/core/json.h"
#include "host/model/powders.h"

namespace vkdose {

namespace {

using Json = nlohmann::ordered_json;

Json inputs(const Case& c, const RunResult& r) {
    Json j;
    j["case"] = c.name;
    j["reason"] = c.reason;
    j["seed"] = c.seed;
    if (const auto& law = c.dosingLaw.user) j["law"] = {{"name", law->name}, {"hash", law->hash}};
    j["particles"] = r.filled.particles.size();
    j["filled_mass_kg"] = jsonNumber(r.filled.mass);
    j["target_mass_kg"] = jsonNumber(r.filled.targetMass);
    j["redrawn"] = r.filled.redrawn;
    j["time_step_s"] = jsonNumber(c.world.timeStep);
    j["settle_time_s"] = jsonNumber(c.schedule.settleTime);
    j["rotate_time_s"] = jsonNumber(c.schedule.rotateTime);
    j["rest_time_s"] = jsonNumber(c.schedule.restTime);
    if (c.schedule.targetMass > 0) j["dose_target_kg"] = jsonNumber(c.schedule.targetMass);
    if (c.schedule.rampTime > 0) j["ramp_time_s"] = jsonNumber(c.schedule.rampTime);
    if (c.schedule.reverseTurns > 0) j["reverse_turns"] = jsonNumber(c.schedule.reverseTurns);
    if (std::isfinite(c.schedule.maxTorque)) j["max_torque_Nm"] = jsonNumber(c.schedule.maxTorque);
    j["coil_speed_rad_s"] = jsonNumber(c.schedule.coilSpeed);
    j["sensor_interval_s"] = jsonNumber(c.sensorInterval);
    return j;
}

/// Doses to a mass have the closed form of the turns that they made. What `derive` gives of them is their target, by
/// which their number is planned.
Json closedFormDose(const Case& c, const RunResult& r) {
    if (c.schedule.targetMass == 0) return jsonPositive(r.derived.massPerDose);
    const TargetFigures f = targetFigures(r.doses);
    return f.doses > 0 ? jsonNumber(f.closedForm) : Json(nullptr);
}

Json closedForms(const Case& c, const RunResult& r) {
    const Derived& d = r.derived;
    Json j;
    if (c.world.coil) {
        const double density = closedFormDensity(d, *c.world.coil);
        j["bulk_density_kg_m3"] = jsonNumber(density);
        j["bulk_density_is"] = !c.bulkDensityMeasured ? "given" : wasMeasured(c, density) ? "measured" : "assumed";
    }
    const bool conveys = c.world.coil || d.conveys();
    j["push_velocity_m_s"] = conveys ? jsonNumber(d.pushVelocity) : Json(nullptr);
    j["tip_velocity_m_s"] = conveys ? jsonNumber(d.tipVelocity) : Json(nullptr);
    if (!c.world.coil) j["bodies"] = d.conveyors;
    j["rate_kg_s"] = jsonPositive(d.rate(c.schedule.coilSpeed));
    j["mass_per_dose_kg"] = closedFormDose(c, r);
    j["doses"] = jsonPositive(d.doses);
    j["stiffest_contact_duration_s"] = jsonNumber(d.stiffest);
    return j;
}

Json doseList(const Case& c, const std::vector<Dose>& doses) {
    Json list = Json::array();
    const std::vector<std::string> names = loadNames(c.world);
    for (const Dose& d : doses) {
        Json& one = list.emplace_back(Json::object());
        putColumns(kDoseColumns, d, one);
        for (std::size_t b = 0; b < d.bodies.size(); ++b)
            putColumns(kDoseBodyColumns, d.bodies[b], one["bodies"][names.at(b)]);
    }
    return list;
}

/// Of the whole run.
Json bodyList(const Case& c, const RunResult& r) {
    Json list = Json::array();
    const std::vector<std::string> names = loadNames(c.world);
    for (std::size_t b = 0; b < r.last.bodies.size(); ++b) {
        Json& one = list.emplace_back(Json::object());
        one["name"] = names.at(b);
        one["work_J"] = jsonNumber(r.last.bodies[b].work);
        if (b < r.bodyPeaks.size()) putColumns(kBodyPeakColumns, r.bodyPeaks[b], one);
        if (b >= r.bodiesMoved.size()) continue;
        const Moved& moved = r.bodiesMoved[b];
        one["moved_s"] = jsonNumber(moved.time);
        if (!c.world.bodies[b].movesFreely()) continue;
        if (c.world.bodies[b].hinge() != nullptr) {
            one["turned_rad"] = jsonNumber(moved.angle);
            continue;
        }
        one["moved_x_m"] = jsonNumber(moved.shift.x);
        one["moved_y_m"] = jsonNumber(moved.shift.y);
        one["moved_z_m"] = jsonNumber(moved.shift.z);
    }
    return list;
}

/// Count and mass of each region in turn.
template <std::size_t... Region>
constexpr auto regionColumns(std::index_sequence<Region...>) {
    return std::tuple_cat(columns(std::get<Region>(kCountColumns), std::get<Region>(kMassColumns))...);
}

Json ledger(const RunResult& r) {
    Json j;
    j["filled_count"] = r.ledger.filledCount();
    j["filled_mass_kg"] = jsonNumber(r.ledger.filledMass());
    putColumns(regionColumns(std::make_index_sequence<kRegions>()), r.last.sensors, j);
    j["worst_relative_mass_error"] = jsonNumber(r.ledger.worstMassError());
    j["closings"] = r.ledger.closings();
    return j;
}

/// When each refill of the case was added; null for one that was not.
Json refills(const Case& c, const RunResult& r) {
    Json list = Json::array();
    for (std::size_t k = 0; k < c.refills.size(); ++k) {
        const auto added = std::find_if(r.added.begin(), r.added.end(), [k](const auto& a) { return a.refill == k; });
        const Insertion::Waiting& powder = r.filled.waiting[k];
        list.push_back({{"name", c.refills[k].name},
                        {"particles", powder.particles.size()},
                        {"mass_kg", jsonNumber(powder.mass)},
                        {"time_s", added == r.added.end() ? Json(nullptr) : jsonNumber(added->time)}});
    }
    return list;
}

/// A run that was ordered about is repeated by its case and these.
Json orders(const std::vector<GivenOrder>& given) {
    Json list = Json::array();
    for (const GivenOrder& o : given)
        list.push_back({{"time_s", jsonNumber(o.time)},
                        {"order", orderWord(o.order)},
                        {"speed_rad_s", o.order.speed ? jsonNumber(*o.order.speed) : Json(nullptr)}});
    return list;
}

Json doseCount(const std::optional<int>& dose) {
    return dose ? Json(*dose) : Json(nullptr);
}

/// Figures that there are none of are null, so that a sweep knows that the run has told them.
Json massRate(const MassRate& rate) {
    Json j;
    j["windows"] = rate.windows.size();
    for (const RateFigure& f : kRateFigures) j[f.name] = jsonNumber(f.of(rate));
    return j;
}

Json cycleMass(const Cycles& cycles) {
    Json j;
    j["is"] = cycles.what.empty() ? Json(nullptr) : Json(cycles.what);
    j["cycles"] = cycles.list.size();
    for (const CycleFigure& f : kCycleFigures) j[f.name] = jsonNumber(f.of(cycles));
    return j;
}

Json analysis(const Case& c, const RunResult& r, const RunHistory& history) {
    const DosingFigures f = figuresOf(r.doses, supplyOf(r), c.schedule.stop);
    Json j;
    j["beta_kg_per_dose"] = jsonNumber(f.beta.beta);
    j["beta_standard_error_kg_per_dose"] = jsonNumber(f.beta.standardError);
    j["beta_doses"] = f.beta.doses;
    j["beta_cumulative_below_kg"] = jsonNumber(f.window.cumulativeBelow);
    j["doses_to_99_percent"] = doseCount(f.dosesTo99);
    j["blocked_at_dose"] = doseCount(f.blocked);
    j[kRateName] = massRate(history.rate);
    j[kCycleName] = cycleMass(history.cycles);
    return j;
}

/// Null without doses to a mass.
Json targets(const std::vector<Dose>& doses) {
    const TargetFigures f = targetFigures(doses);
    if (f.doses == 0) return nullptr;
    Json j;
    j["doses"] = f.doses;
    j["stopped_by_mass"] = f.byMass;
    j["mean_target_kg"] = jsonNumber(f.target);
    j["mean_stop_mass_kg"] = jsonNumber(f.stopMass);
    j["mean_overshoot_kg"] = jsonNumber(f.overshoot);
    j["mean_error_kg"] = jsonNumber(f.error);
    j["mean_rotation_s"] = jsonNumber(f.rotation);
    return j;
}

Json outlet(const OutletFlow& flow) {
    const OutletFlow::Stop& stop = flow.longest;
    Json j;
    j["first_mass_after_rotation_s"] = flow.lead ? jsonNumber(*flow.lead) : Json(nullptr);
    j["longest_stop_s"] = jsonNumber(stop.time);
    j["longest_stop_turns"] = jsonNumber(stop.turns);
    j["longest_stop_from_s"] = stop.dose > 0 ? jsonNumber(stop.start) : Json(nullptr);
    j["longest_stop_from_dose"] = doseCount(stop.dose > 0 ? std::optional(stop.dose) : std::nullopt);
    j["stopped_at_dose"] = doseCount(flow.stoppedAt);
    return j;
}

Json arches(const std::vector<DoseArch>& list) {
    Json j = Json::array();
    for (const DoseArch& a : list) {
        Json one;
        one["dose"] = a.dose;
        one["time_s"] = jsonNumber(a.time);
        one["height_m"] = jsonNumber(a.arch ? a.arch->height : 0);
        one["z_m"] = a.arch ? jsonNumber(a.arch->z) : Json(nullptr);
        one["length_m"] = jsonNumber(a.arch ? a.arch->length : 0);
        j.push_back(std::move(one));
    }
    return j;
}

Json spread(const Spread& s) {
    return {{"p10", jsonNumber(s.low)}, {"median", jsonNumber(s.median)}, {"p90", jsonNumber(s.high)}};
}

Json settled(const Case& c, const std::optional<SettledBed>& bed) {
    if (!bed) return nullptr;
    const SettledFigures f = settledFigures(c, *bed);
    Json j;
    j["time_s"] = jsonNumber(bed->time);
    j["pairs"] = f.pairs;
    j["coordination"] = jsonNumber(f.coordination);
    j["pull_off_over_weight"] = spread(f.pullOff);
    j["overlap_ratio"] = spread(f.overlap);
    j["largest_overlap_ratio"] = spread(f.largestOverlap);
    j["bulk_density_kg_m3"] = f.bulk ? jsonNumber(f.bulk->density) : Json(nullptr);
    return j;
}

Json settling(const Case& c, const std::optional<Settling>& s) {
    if (!s) return nullptr;
    Json j;
    j["until_rest"] = c.schedule.untilRest;
    j["longest_s"] = jsonNumber(c.schedule.settleTime);
    j["time_s"] = jsonNumber(s->time);
    j["at_rest"] = s->atRest;
    j["speed_m_s"] = jsonNumber(s->speed);
    j["fall_speed_m_s"] = jsonNumber(s->fallSpeed);
    j["spilled_kg"] = jsonNumber(s->spilled);
    return j;
}

/// An object for each measure, by its name.
Json measures(const std::vector<MeasureResult>& results) {
    Json j = Json::object();
    for (const MeasureResult& r : results) {
        Json& one = j[r.name];
        one["kind"] = r.kind;
        if (!r.why.empty()) one["none_because"] = r.why;
        for (const MeasuredFigure& f : r.figures) one[f.name] = jsonNumber(f.value);
    }
    return j;
}

Json energy(const EnergyLedger& ledger) {
    Json j;
    putColumns(kLoadedColumns, ledger.sum, j);
    putColumns(kOutsideColumns, ledger.sum, j);
    j["present_J"] = jsonNumber(ledger.present());
    j["elastic_J"] = jsonNumber(ledger.elastic());
    putColumns(kLossColumns, ledger.sum, j);
    putColumns(kResidualColumns, ledger, j);
    j["residual_of_coil_work"] = jsonNumber(ledger.residual() / ledger.sum.coilWork);
    return j;
}

}  // namespace

std::string summaryJson(const Case& c, const RunResult& r, const std::string& backend, const RunHistory& history) {
    const DoseStatistics& s = r.statistics;
    Json j;
    j["inputs"] = inputs(c, r);
    j["backend"] = backend;
    if (!history.origin.empty()) j["from"] = history.origin;
    j["stop_reason"] = stopKeyword(r.reason);
    j["stop_sentence"] = stopSentence(r.reason, c.schedule.stop);
    j["interrupted"] = r.reason == StopReason::Interrupted;
    j["error"] = r.error.empty() ? Json(nullptr) : Json(r.error);
    j["simulated_time_s"] = jsonNumber(r.last.time);
    j["steps"] = r.last.step;
    j["coil_angle_rad"] = jsonNumber(r.last.coilAngle);
    j["doses"] = doseList(c, r.doses);
    j["dose_statistics"] = {{"complete_doses", s.doses},
                            {"mean_kg", s.doses > 0 ? jsonNumber(s.mean) : Json(nullptr)},
                            {"standard_deviation_kg", s.doses > 1 ? jsonNumber(s.deviation) : Json(nullptr)},
                            {"rsd", s.doses > 1 && s.mean > 0 ? jsonNumber(s.relative) : Json(nullptr)}};
    j["targets"] = targets(r.doses);
    j["analysis"] = analysis(c, r, history);
    j["outlet"] = outlet(history.outlet);
    j["arches"] = arches(history.arches);
    if (!history.measures.empty()) j["measures"] = measures(history.measures);
    j["settling"] = settling(c, r.settling);
    if (!r.last.bodies.empty()) j["bodies"] = bodyList(c, r);
    for (std::size_t i = 0; i < r.last.regions.size(); ++i)
        j["regions"].push_back({{"name", c.world.regions.at(i).name},
                                {"mass_kg", jsonNumber(r.last.regions[i].came.mass)},
                                {"particles", r.last.regions[i].came.particles},
                                {"content_kg", jsonNumber(r.last.regions[i].content.mass)},
                                {"largest_content_kg", jsonNumber(r.last.regions[i].most)}});
    for (std::size_t k = 0; k < r.last.powders.size(); ++k) {
        Json powder{{"name", powdersOf(c).at(k).name}};
        putColumns(kPowderColumns, r.last.powders[k], powder);
        j["powders"].push_back(std::move(powder));
    }
    j["settled"] = settled(c, r.settled);
    j["dosed_while_settling_kg"] = jsonNumber(r.dosedWhileSettling);
    j["closed_form"] = closedForms(c, r);
    if (const std::string note = closedFormNote(c, r); !note.empty()) j["closed_form"]["note"] = note;
    if (!c.refills.empty()) j["refills"] = refills(c, r);
    if (!r.orders.empty()) j["orders"] = orders(r.orders);
    j["ledger"] = ledger(r);
    if (r.last.energy) j["energy"] = energy(*r.last.energy);
    j["max_overlap_ratio"] = jsonNumber(r.maxOverlapRatio);
    j["max_overlap_time_s"] = jsonNumber(r.maxOverlapTime);
    j["particle_steps"] = jsonNumber(r.particleSteps);
    j["particle_steps_per_second"] = jsonNumber(r.particleStepsPerSecond());
    j["stepping_wall_time_s"] = jsonNumber(r.wallTime);
    return j.dump(2, ' ', false, Json::error_handler_t::replace);
}

std::optional<Json> readSummary(const std::filesystem::path& folder) {
    const std::optional<std::string> text = fileContent(folder / "summary.json");
    Json summary = text ? Json::parse(*text, nullptr, false) : Json();
    return summary.is_object() ? std::optional(std::move(summary)) : std::nullopt;
}

}  // namespace vkdose
