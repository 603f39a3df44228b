// Runs the element tests of a powder's laboratory with draws of its parameters, and notes what they said in its file.
#include <fmt/format.h>

#include <cmath>

#include "host/app/calibration_text.h"
#include "host/app/commands.h"
#include "host/app/confirm.h"
#include "host/app/exit_code.h"
#include "host/app/find_case.h"
#include "host/app/like.h"
#include "host/app/sweep_setup.h"
#include "host/app/tell.h"
#include "host/app/text.h"
#include "host/core/error.h"
#include "host/core/file.h"
#include "host/core/output_file.h"
#include "host/core/printable.h"
#include "host/study/figures_table.h"
#include "host/study/powder_confirm.h"
#include "host/study/prediction.h"

namespace vkdose {

namespace {

namespace fs = std::filesystem;

std::string lineText(const ConfirmedFigure& f, int draws) {
    const std::string unit = *f.aim.figure->unit == '\0' ? "" : fmt::format(" {}", f.aim.figure->unit);
    const std::string lab = withError(f.aim.goal.target, f.aim.goal.tolerance) + unit;
    const std::string how = f.aim.fitted ? "fitted" : "predicted";
    if (f.values.empty())
        return fmt::format("{:<10} {}: {} by the laboratory; no run has it\n", how, f.aim.figure->title, lab);
    return fmt::format(
        "{:<10} {}: {} by the laboratory, {}{} by {}{}: {}\n", how, f.aim.figure->title, lab,
        std::isfinite(f.standardError) ? withError(f.mean, f.standardError) : fmt::format("{:.4g}", f.mean), unit,
        counted(f.values.size(), "run"), int(f.values.size()) < draws ? fmt::format(" of {}", draws) : "",
        f.met() ? "met" : "not met");
}

/// The path by which a powder's file names a case.
std::string pathFrom(const fs::path& powder, const fs::path& test) {
    const fs::path relative = fs::relative(test, fs::absolute(powder).parent_path());
    return (relative.empty() ? fs::absolute(test) : relative).generic_string();
}

}  // namespace

int confirmCommand(const PowdersOptions& options) {
    const fs::path file = findPowder(options.name);
    const PowderFile powder = readPowderFile(file);
    if (!powder.draws)
        throw CaseError({{file.string(), 0, "draws", "", "is missing: the powder's parameters have no distribution",
                          "take a powder of `vkdose powders --like` or of `vkdose calibrate`"}});
    const LaboratorySheet sheet = sheetOf(powder);
    const std::vector<SheetAim> aims = aimsOf(sheet);
    const std::vector<std::string> tests = testsOf(aims);
    if (tests.empty())
        throw CaseError({{file.string(), 0, "laboratory", "", "has no figure of an element test",
                          "name figures as `vkdose powders --like` does: bulk and density, tapped, hausner, repose, "
                          "drum, ffc, effective, steady"}});
    const fs::path tables = tablesFolder();
    std::string told;
    bool met = true;
    for (const std::string& test : tests) {
        SweepOptions sweep;
        static_cast<MemberOptions&>(sweep) = options.ofConfirm;
        sweep.backend = options.backend;
        sweep.out = fs::path("out") / (file.stem().string() + "-" + test);
        sweep.again = fmt::format("vkdose powders {} --confirm {}", shellWord(options.name.string()), options.confirm);
        const Study study = confirmingStudy(powder, sheet, tables, test, options.confirm);
        const std::vector<Member> members = drawsMembers(study);
        const ExitCode code =
            ExitCode(playSweep(sweep, study, members, *makeRunner(sweep), {"powders", nullptr, nullptr}));
        if (code != kOk && code != kDisagree) return code;
        const auto figures = confirmedFigures(aims, test, Table::read(sweep.out / kFiguresName, LastLine::Whole));
        for (const ConfirmedFigure& f : figures) {
            told += lineText(f, options.confirm);
            met = met && f.met();
        }
        const std::string note = fmt::format("{} of the powder's draws, each with a seed of its own", options.confirm);
        replaceFile(file,
                    withHeld(fileContent(file).value_or(""), pathFrom(file, caseOfTest(tables, test)), figures, note));
    }
    tell("{}wrote      what was held into {}\n", told, printable(file.string()));
    if (!met)
        tell(stderr, "vkdose: not every figure was met; give more figures, or calibrate with tests of your own\n");
    return met ? kOk : kDisagree;
}

}  // namespace vkdose
