#include "host/study/element_tables.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "host/core/error.h"
#include "host/core/vec.h"
#include "host/model/case.h"
#include "host/study/study.h"

namespace vkdose {

namespace {

constexpr double kDegrees = 180 / kPi;

double poured(const ElementTable& t, std::size_t row) {
    return t.figures.number(row, "poured.solid_fraction");
}

double tapped(const ElementTable& t, std::size_t row) {
    return t.figures.number(row, "tapped.solid_fraction");
}

double hausner(const ElementTable& t, std::size_t row) {
    return tapped(t, row) / poured(t, row);
}

double repose(const ElementTable& t, std::size_t row) {
    return t.figures.number(row, "outline.angle_deg");
}

double drum(const ElementTable& t, std::size_t row) {
    return t.figures.number(row, "front.angle_deg");
}

/// Powder without cohesion has no strength, and its test tells no ffc.
double strength(const ElementTable& t, std::size_t row) {
    const double ffc = t.figures.number(row, "ring-shear.ffc");
    if (std::isfinite(ffc)) return 1 / ffc;
    return t.figures.number(row, "ring-shear.cohesion_Pa") <= 0 ? 0 : ffc;
}

double effective(const ElementTable& t, std::size_t row) {
    return t.figures.number(row, "ring-shear.effective_friction_angle_deg");
}

double load(const ElementTable& t, std::size_t row) {
    return t.figures.number(row, "ring-shear.pre_shear_normal_stress_Pa");
}

double steady(const ElementTable& t, std::size_t row) {
    return std::atan(t.figures.number(row, "ring-shear.pre_shear_stress_Pa") / load(t, row)) * kDegrees;
}

/// A parameter that is known as if it had been measured.
double bond(const ElementTable& t, std::size_t row) {
    for (std::size_t k = 0; k < t.box.size(); ++k)
        if (t.box[k].key == kBondNumber) return t.points[row][k];
    return std::numeric_limits<double>::quiet_NaN();
}

constexpr TableFigure kFigures[] = {
    {"poured", "poured volume fraction", "", "bulk", poured},
    {"tapped", "tapped volume fraction", "", "bulk", tapped},
    {"hausner", "Hausner ratio", "", "bulk", hausner},
    {"repose", "angle of repose", "degrees", "heap", repose},
    {"drum", "angle in the drum", "degrees", "drum", drum},
    {"strength", "1/ffc", "", "ring-shear", strength},
    {"effective", "effective angle of internal friction", "degrees", "ring-shear", effective},
    {"steady", "angle of steady flow", "degrees", "ring-shear", steady},
    {"bond", "Bond number", "", "bulk", bond},
};

ElementTable read(const std::filesystem::path& folder, const std::string& test) {
    const std::filesystem::path file = folder / (test + ".csv");
    if (!std::filesystem::exists(file))
        throw CaseError({{file.string(), 0, "", "", "is not there: this table has not been computed",
                          "leave out the figures of this test, or take the figures.csv of the study beside it"}});
    const Study study = readStudy(folder / (test + ".toml"));
    ElementTable t;
    t.box = study.axes.empty() ? std::vector<FreeParameter>() : study.axes.front().box;
    if (t.box.empty())
        throw CaseError({{study.file.string(), 0, "axis", "", "has no points that fill a box", "give low and high"}});
    t.figures = Table::read(file, LastLine::Whole);
    t.density = loadCase(study.base).world.density();
    if (t.figures.rows() < 2)
        throw CaseError({{file.string(), 0, "", "", "has fewer than two points",
                          "take the figures.csv of the sweep of the study beside it"}});
    t.points.resize(t.figures.rows());
    for (const FreeParameter& p : t.box) {
        const std::vector<double> values = t.figures.column(p.key);
        for (std::size_t row = 0; row < values.size(); ++row) t.points[row].push_back(values[row]);
    }
    return t;
}

}  // namespace

std::span<const TableFigure> tableFigures() {
    return kFigures;
}

const TableFigure& tableFigure(std::string_view name) {
    for (const TableFigure& f : kFigures)
        if (f.name == name) return f;
    throw std::logic_error("no figure of a table: " + std::string(name));
}

double preShearStress(const ElementTable& ringShear) {
    double sum = 0;
    for (std::size_t row = 0; row < ringShear.points.size(); ++row) sum += load(ringShear, row);
    return sum / double(ringShear.points.size());
}

const ElementTable& ElementTables::of(const std::string& test) {
    const auto found = read_.find(test);
    return found != read_.end() ? found->second : read_.emplace(test, read(folder_, test)).first->second;
}

bool ElementTables::has(const std::string& test) const {
    return std::filesystem::exists(folder_ / (test + ".csv"));
}

}  // namespace vkdose
