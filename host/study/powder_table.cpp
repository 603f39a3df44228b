#include "host/study/powder_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "host/model/case_tree.h"
#include "host/study/element_tables.h"
#include "host/study/sheet_aims.h"
#include "host/study/study.h"

namespace vkdose {

namespace {

/// The kernel of a process is fitted to so many points, as its cost grows with their cube. All points are then taken.
constexpr std::size_t kKernelPoints = 60;
constexpr SampleSize kSample{8, 64};
constexpr std::size_t kDraws = 200;
constexpr std::string_view kBond = "bond";
/// Part of a parameter's range at its ends: an interval that begins there may go on beyond.
constexpr double kEnd = 0.03;

/// Those of a sheet, by which a powder can be found. Throws RunError if none tells the parameters.
std::vector<SheetAim> tellingAims(const LaboratorySheet& sheet) {
    std::vector<SheetAim> aims = aimsOf(sheet);
    const bool tells = std::any_of(aims.begin(), aims.end(), [](const SheetAim& a) { return a.figure->name != kBond; });
    if (!tells)
        throw RunError(
            "these figures do not tell friction and adhesion: a bulk density does so together with the density of the "
            "grains or with the tapped one; give repose, drum, ffc, effective, steady or hausner");
    return aims;
}

UnitPoint unitOf(const std::vector<FreeParameter>& box, const Parameters& p) {
    UnitPoint u;
    for (std::size_t k = 0; k < p.size(); ++k) u.push_back((p[k] - box[k].low) / (box[k].high - box[k].low));
    return u;
}

/// Processes through the figures of the table, over the parameters of the powder of a sheet.
class Asked {
  public:
    Asked(const LaboratorySheet& sheet, const std::filesystem::path& folder) : sheet_(sheet), tables_(folder) {}

    const GaussianProcess& process(const TableFigure& figure) {
        const auto found = processes_.find(&figure);
        return found != processes_.end() ? found->second : processes_.emplace(&figure, made(figure)).first->second;
    }
    bool has(const TableFigure& figure) const { return tables_.has(figure.test); }
    const ElementTable& of(const TableFigure& figure) { return tables_.of(figure.test); }

  private:
    GaussianProcess made(const TableFigure& figure) {
        const ElementTable& table = of(figure);
        const double bonds = figure.test == std::string("ring-shear") ? bondScale(sheet_, table) : 1;
        std::vector<UnitPoint> points;
        std::vector<Measured> values;
        for (std::size_t row = 0; row < table.points.size(); ++row) {
            const double value = figure.read(table, row);
            if (!std::isfinite(value)) continue;
            Parameters p = table.points[row];
            for (std::size_t k = 0; k < p.size(); ++k)
                if (table.box[k].key == kBondNumber) p[k] *= bonds;
            points.push_back(unitOf(table.box, p));
            values.push_back({value, 0});
        }
        if (points.size() < 2) throw RunError(fmt::format("the table has no two points with the {}", figure.title));
        // The rows fill the box in any stretch of their order.
        const auto count = std::ptrdiff_t(std::min(points.size(), kKernelPoints));
        const GaussianProcess some({points.begin(), points.begin() + count}, {values.begin(), values.begin() + count});
        return {std::move(points), values, some.kernel()};
    }
    const LaboratorySheet& sheet_;
    ElementTables tables_;
    std::map<const TableFigure*, GaussianProcess> processes_;
};

double misfitAt(const UnitPoint& u, const std::vector<SheetAim>& aims, const Processes& processes) {
    double sum = 0;
    for (std::size_t g = 0; g < aims.size(); ++g)
        sum += std::pow((processes[g].at(u).mean - aims[g].goal.target) / aims[g].goal.tolerance, 2);
    return sum;
}

CalibrationFinding findingOf(const std::vector<FreeParameter>& box, const std::vector<SheetAim>& aims,
                             const Processes& processes, const Posterior& p, const std::vector<UnitPoint>& draws) {
    CalibrationFinding f;
    std::vector<double> misfits;
    for (const UnitPoint& u : draws) misfits.push_back(misfitAt(u, aims, processes));
    const auto best = std::size_t(std::min_element(misfits.begin(), misfits.end()) - misfits.begin());
    f.misfit = misfits[best];
    for (std::size_t g = 0; g < aims.size(); ++g) {
        const Belief b = processes[g].at(draws[best]);
        f.targets.push_back({aims[g].figure->title, aims[g].figure->unit, aims[g].figure->test, aims[g].goal.target,
                             aims[g].goal.tolerance, 1, b.mean, b.deviation, leaveOneOut(processes[g].leftOut())});
    }
    for (std::size_t k = 0; k < box.size(); ++k) {
        const FreeParameter& free = box[k];
        CalibrationFinding::Parameter of{free.key, free.low, free.high, p.draws[best][k], {}, 0, p.parameters[k]};
        for (std::size_t g = 0; g < aims.size(); ++g)
            of.change.push_back(processes[g].slope(draws[best], k) / aims[g].goal.tolerance);
        const auto weaker = [](double a, double b) { return std::abs(a) < std::abs(b); };
        of.mostlyBy = std::size_t(std::max_element(of.change.begin(), of.change.end(), weaker) - of.change.begin());
        f.parameters.push_back(of);
    }
    f.fit = {p.correlation, p.figures, p.draws, p.sampled, p.steps, p.acceptance, p.rHat, p.effective};
    return f;
}

/// Where the table ends before the powder.
std::vector<std::string> beyondOf(const CalibrationFinding& f, const std::vector<SheetAim>& aims, Asked& asked) {
    std::vector<std::string> all;
    for (const SheetAim& aim : aims) {
        if (aim.figure->name == kBond) continue;
        const ElementTable& table = asked.of(*aim.figure);
        double low = std::numeric_limits<double>::infinity(), high = -low;
        for (std::size_t row = 0; row < table.points.size(); ++row) {
            const double value = aim.figure->read(table, row);
            if (!std::isfinite(value)) continue;
            low = std::min(low, value);
            high = std::max(high, value);
        }
        if (aim.goal.target < low || aim.goal.target > high)
            all.push_back(fmt::format("{} {:.4g}: the table has {:.4g} to {:.4g}", aim.figure->title, aim.goal.target,
                                      low, high));
    }
    for (const CalibrationFinding::Parameter& p : f.parameters) {
        if (!p.constrained()) continue;
        const double end = kEnd * (p.high - p.low);
        // At 0 a parameter ends, not the table.
        if (p.fits.low < p.low + end && p.low > 0)
            all.push_back(fmt::format("{}: the table ends at {:.4g}, and smaller ones may fit too", p.key, p.low));
        if (p.fits.high > p.high - end)
            all.push_back(fmt::format("{}: the table ends at {:.4g}, and larger ones may fit too", p.key, p.high));
    }
    return all;
}

/// A table of a case as people write it: its values, then each table in it under a heading of its own.
std::string sectionText(const Node& table, const std::string& path) {
    Node values;
    std::string further;
    for (const Node& child : table.children) {
        const std::string below = path.empty() ? child.key : path + "." + child.key;
        if (child.kind == Node::Kind::Table)
            further += fmt::format("\n[{}]\n{}", below, sectionText(child, below));
        else
            values.children.push_back(child);
    }
    return treeText(std::move(values)) + further;
}

}  // namespace

LikePowder powderLike(const LaboratorySheet& sheet, const std::filesystem::path& folder) {
    const std::vector<SheetAim> aims = tellingAims(sheet);
    Asked asked(sheet, folder);
    Processes processes;
    std::vector<Goal> goals;
    for (const SheetAim& aim : aims) {
        processes.push_back(asked.process(*aim.figure));
        goals.push_back(aim.goal);
    }
    const std::vector<FreeParameter>& box = asked.of(*aims.front().figure).box;
    CalibrationAim aim;
    aim.parameters = box;
    const Posterior posterior = posteriorOf(aim, goals, processes, kDraws, kSample);
    std::vector<UnitPoint> draws;
    for (const Parameters& p : posterior.draws) draws.push_back(unitOf(box, p));

    LikePowder like;
    like.finding = findingOf(box, aims, processes, posterior, draws);
    like.beyond = beyondOf(like.finding, aims, asked);
    for (const TableFigure& figure : tableFigures()) {
        const bool given =
            std::any_of(aims.begin(), aims.end(), [&](const SheetAim& a) { return a.figure == &figure; });
        if (!given && asked.has(figure) && figure.name != kBond)
            like.foretold.push_back({figure.title, figure.unit, figureOver(draws, asked.process(figure))});
    }
    const TableFigure& strength = tableFigure("strength");
    if (asked.has(strength)) like.load = preShearLoad(sheet, asked.of(strength));

    const SheetValue *density = sheet.find("density"), *bulk = sheet.find("bulk");
    std::optional<double> fraction;
    if (asked.has(tableFigure("poured"))) fraction = figureOver(draws, asked.process(tableFigure("poured"))).mean;
    const bool byBulk = density == nullptr && bulk != nullptr && fraction;
    like.density = byBulk ? bulk->value / *fraction : sphereDensity(sheet, asked.of(*aims.front().figure));
    if (bulk != nullptr) like.bulkDensity = bulk->value;
    if (bulk == nullptr && density != nullptr && fraction) like.bulkDensity = density->value * *fraction;
    return like;
}

std::string powderFileText(const LaboratorySheet& sheet, const LikePowder& like, const std::filesystem::path& folder,
                           const std::string& draws) {
    const Study study = readStudy(folder / "bulk.toml");
    std::vector<std::filesystem::path> files;
    const Node base = readTree(study.base, files);
    Node spheres;
    for (const char* name : {"particles", "contact"}) spheres.children.push_back(*base.child(name));
    for (const char* key : {"mass_g", "grid_gap", "region"}) spheres.child("particles")->drop(key);
    std::vector<std::string> changes{fmt::format("particles.density={:.4g}", like.density), "contact.scaling=stress"};
    for (const CalibrationFinding::Parameter& p : like.finding.parameters)
        changes.push_back(fmt::format("{}={:.4g}", p.key, p.chosen));
    merge(spheres, overrideTree(changes));
    std::string given, laboratory;
    for (const SheetValue& v : sheet.values) {
        given += fmt::format("{}{} {:.6g}", given.empty() ? "" : ", ", v.figure->name, v.value);
        laboratory += fmt::format(
            "\n[[laboratory]]\nfigure = {}\nvalue = {:.9g}\nerror = {:.4g}\nunit = {}\nmethod = "
            "{}\nsource = \"given\"\nfitted = true\n",
            tomlString(v.figure->name), v.value, v.error, tomlString(v.figure->unit), tomlString(v.figure->meaning));
    }
    std::string limits =
        "Found in a table of element tests, not calibrated: each of its points is one run with spheres of 1.8 to 2.6 "
        "mm. Friction at walls and bodies is that of the tests.";
    for (const std::string& sentence : like.beyond) limits += " " + sentence + ".";
    return fmt::format("title = {}\nlimits = {}\ndraws = {}\n{}{}{}", tomlString("A powder with " + given),
                       tomlString(limits), tomlString(draws),
                       like.bulkDensity ? fmt::format("bulk_density = {:.4g}\n", *like.bulkDensity) : "",
                       sectionText(spheres, ""), laboratory);
}

}  // namespace vkdose
