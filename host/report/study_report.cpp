#include "host/report/study_report.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "host/core/csv_table.h"
#include "host/core/json.h"
#include "host/report/study_points.h"
#include "host/study/calibration_file.h"
#include "host/study/design_finding.h"
#include "host/study/prediction.h"
#include "host/study/scale_study.h"

namespace vkdose::report {

namespace fs = std::filesystem;

namespace {

/// The words of the page's style sheet for the verdicts, in the order of Verdict::Kind.
constexpr std::array kVerdictWords{"matches", "within", "holds", "contradicts", "not-run", "not-judged"};
static_assert(kVerdictWords.size() == std::size_t(Verdict::Kind::NotJudged) + 1);

Json valueJson(const Setting& s) {
    return std::isnan(s.number) ? Json(s.text) : Json(s.number);
}

/// NaN unless the point's case says how fast and how long the coil turns, and nothing else ends a dose.
double turnsPerDose(const Point& p) {
    const auto value = [&](const char* key) {
        const auto found = p.keys.find(key);
        return found == p.keys.end() ? NAN : found->second.number;
    };
    if (value("dose.mass_g") > 0 || std::isfinite(value("dose.max_torque_mNm"))) return NAN;
    const double ramp = value("dose.ramp_s");  // up and down: each is as good as half of it at full speed
    return value("coil.speed_rpm") / 60 * (value("dose.rotate_s") - (std::isnan(ramp) ? 0 : ramp));
}

Json pointJson(const StudyPoint& p) {
    Json at = Json::array(), along = Json::array();
    for (const Point::Place& place : p.point.places) {
        const Setting& first = p.point.keys.at(place.keys.front());
        at.push_back(place.keys.size() == 1 ? valueJson(first) : Json(place.label));
        along.push_back(jsonNumber(first.number));
    }
    Json doses = Json::array();
    for (const Estimate& d : p.doses) doses.push_back({jsonNumber(d.mean), jsonNumber(d.standardError), d.count});
    Json outputs;
    for (const auto& [name, output] : p.point.outputs)
        outputs[name] = {jsonNumber(output.mean), jsonNumber(output.standardError)};
    Json j;
    j["at"] = at;
    j["along"] = along;
    j["finished"] = p.finished;
    j["failed"] = p.failed;
    j["errors"] = p.errors;
    j["beta_kg_per_dose"] = jsonNumber(p.beta);
    j["beta_standard_error_kg_per_dose"] = jsonNumber(p.betaError);
    j["error_over_seeds"] = p.errorOverSeeds;
    j["closed_form_kg_per_dose"] = jsonNumber(p.closedForm);
    j["turns_per_dose"] = jsonNumber(turnsPerDose(p.point));
    j["outputs"] = outputs;
    j["dose_mass_kg"] = doses;
    j["cumulative_mass_kg"] = jsonNumbers(p.point.cumulative);
    return j;
}

Json verdictsJson(const fs::path& file, const std::vector<StudyPoint>& studyPoints) {
    std::vector<Point> points;
    for (const StudyPoint& p : studyPoints)
        if (p.finished > 0) points.push_back(p.point);
    Json list = Json::array();
    for (const Expected& e : readExpected(file)) {
        const Verdict v = judge(e, points);
        list.push_back({{"id", e.id},
                        {"what", e.what},
                        {"section", e.section},
                        {"source", e.source},
                        {"found", v.found},
                        {"kind", kVerdictWords.at(std::size_t(v.kind))},
                        {"verdict", v.text}});
    }
    return list;
}

}  // namespace

bool isSweep(const fs::path& folder) {
    return fs::exists(folder / "members.csv");
}

Json studyJson(const fs::path& folder, const std::optional<fs::path>& expected) {
    const Table members = Table::read(folder / "members.csv");
    const StudyHead head = readHead(folder, members);
    const std::vector<StudyPoint> points = readPoints(folder, head, members);
    Json j;
    j["kind"] = "study";
    j["name"] = head.name;
    j["reason"] = head.reason;
    j["axes"] = head.axes;
    j["target_kg_per_dose"] = jsonNumber(head.target);
    j["points"] = Json::array();
    for (const StudyPoint& p : points) j["points"].push_back(pointJson(p));
    j["members"] = members.rows();
    const std::optional<CalibrationFinding> finding = readFinding(folder);
    j["searches"] = head.searches;
    j["designs"] = head.designs;
    j["calibration"] = finding ? findingJson(*finding) : Json(nullptr);
    j["draws"] = Json::array();
    if (finding && finding->fit)
        for (const Parameters& draw : finding->fit->draws) j["draws"].push_back(jsonNumbers(draw));
    j["design"] = readDesign(folder);
    j["prediction"] = readPrediction(folder);
    j["scale"] = readScale(folder);
    j["verdicts"] = expected ? verdictsJson(*expected, points) : Json(nullptr);
    return j;
}

}  // namespace vkdose::report
