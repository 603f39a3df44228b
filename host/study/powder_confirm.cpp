#include "host/study/powder_confirm.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "host/analysis/beta.h"
#include "host/core/error.h"
#include "host/model/case_tree.h"
#include "host/study/member.h"
#include "host/study/prediction.h"

namespace vkdose {

namespace {

constexpr double kAgreement = 2;  // standard errors

/// Whether the line of a TOML text is the head of a table.
bool isHead(const std::string& line) {
    return line.starts_with("[");
}

}  // namespace

LaboratorySheet sheetOf(const PowderFile& powder) {
    LaboratorySheet sheet;
    std::vector<Diagnostic> faults;
    for (std::size_t k = 0; k < powder.laboratory.size(); ++k) {
        const PowderFile::Laboratory& l = powder.laboratory[k];
        const auto named = std::find_if(std::begin(kSheetFigures), std::end(kSheetFigures),
                                        [&](const SheetFigure& f) { return l.figure == f.name; });
        if (named == std::end(kSheetFigures)) continue;
        const bool zero = l.value == 0 && l.figure == "bond";
        const char* problem = !(l.value > 0) && !zero           ? "is no value of this figure"
                              : sheet.find(l.figure) != nullptr ? "is there twice"
                                                                : nullptr;
        if (problem != nullptr)
            faults.push_back({powder.file.string(), 0, fmt::format("laboratory[{}].value", k),
                              fmt::format("{:.6g}", l.value), fmt::format("{} {}", l.figure, problem),
                              "give one value above 0"});
        sheet.values.push_back({&*named, l.value, l.error.value_or(named->usualError(l.value)), l.fitted});
    }
    if (!faults.empty()) throw CaseError(faults);
    return sheet;
}

std::vector<std::string> testsOf(const std::vector<SheetAim>& aims) {
    std::vector<std::string> tests;
    for (const char* test : {"bulk", "heap", "drum", "ring-shear"})
        if (std::any_of(aims.begin(), aims.end(), [&](const SheetAim& a) {
                return std::string_view(a.figure->test) == test && std::string_view(a.figure->name) != "bond";
            }))
            tests.emplace_back(test);
    return tests;
}

std::filesystem::path caseOfTest(const std::filesystem::path& tables, const std::string& test) {
    return readStudy(tables / (test + ".toml")).base;
}

Study confirmingStudy(const PowderFile& powder, const LaboratorySheet& sheet, const std::filesystem::path& tables,
                      const std::string& test, int count) {
    const std::filesystem::path file = caseOfTest(tables, test);
    const Case base = loadCase(file);
    Study study = drawsStudy(file,
                             {"powder_file=" + std::filesystem::absolute(powder.file).string(),
                              fmt::format("particles.density={:.9g}", base.world.density())},
                             *powder.draws, count);
    study.name = powder.file.stem().string() + "-" + test;
    study.reason = fmt::format("What does the element test {} say of {}?", test, powder.file.filename().string());
    if (test != "ring-shear") return study;
    const double scale = bondScale(sheet, ElementTables(tables).of(test));
    Axis& axis = study.axes.front();
    for (std::size_t k = 0; k < axis.keys.size(); ++k)
        if (axis.keys[k] == kBondNumber)
            for (std::vector<Node>& point : axis.points)
                point[k] = settingOf(study, kBondNumber, point[k].number / scale).value;
    return study;
}

bool ConfirmedFigure::met() const {
    const double error = std::isfinite(standardError) ? standardError : 0;
    return std::abs(mean - aim.goal.target) <= kAgreement * std::hypot(aim.goal.tolerance, error);
}

std::vector<ConfirmedFigure> confirmedFigures(const std::vector<SheetAim>& aims, const std::string& test,
                                              const Table& figures) {
    ElementTable runs;
    runs.figures = figures;
    std::vector<ConfirmedFigure> all;
    for (const SheetAim& aim : aims) {
        if (aim.figure->test != test || std::string_view(aim.figure->name) == "bond") continue;
        ConfirmedFigure f{aim, {}, 0, 0};
        try {
            for (std::size_t row = 0; row < figures.rows(); ++row)
                if (const double value = aim.figure->read(runs, row); std::isfinite(value)) f.values.push_back(value);
        } catch (const CaseError&) {  // a figure that no run has has no column
        }
        const Estimate e = estimateOf(f.values);
        f.mean = e.mean;
        f.standardError = e.standardError;
        all.push_back(f);
    }
    return all;
}

std::string withHeld(const std::string& text, const std::string& test, const std::vector<ConfirmedFigure>& figures,
                     const std::string& note) {
    // Tables of this test go; what stands before the first head and in all other tables stays as it is.
    std::string kept, block;
    bool held = false;
    const auto close = [&] {
        if (!held || block.find("\ntest = " + tomlString(test) + "\n") == std::string::npos) kept += block;
        block.clear();
    };
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        if (isHead(line)) {
            close();
            held = line.starts_with("[[held]]");
        }
        block += line + "\n";
    }
    close();
    while (kept.ends_with("\n\n")) kept.pop_back();
    for (const ConfirmedFigure& f : figures) {
        if (f.values.empty()) continue;
        kept += fmt::format(
            "\n[[held]]\ntest = {}\nfigure = {}\nmeasured = {:.6g}\nmeasured_error = {:.3g}\nsimulated = {:.6g}\n",
            tomlString(test), tomlString(f.aim.figure->title), f.aim.goal.target, f.aim.goal.tolerance, f.mean);
        if (std::isfinite(f.standardError)) kept += fmt::format("simulated_error = {:.3g}\n", f.standardError);
        kept += fmt::format("fitted = {}\nnote = {}\n", f.aim.fitted, tomlString(note));
    }
    return kept;
}

}  // namespace vkdose
