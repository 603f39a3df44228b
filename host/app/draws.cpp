// A run with draws from the distribution of its powder's parameters.
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "host/app/commands.h"
#include "host/app/exit_code.h"
#include "host/app/sweep_setup.h"
#include "host/app/tell.h"
#include "host/app/text.h"
#include "host/core/error.h"
#include "host/core/printable.h"
#include "host/model/powder_file.h"
#include "host/study/finding_file.h"
#include "host/study/prediction.h"

namespace vkdose {

namespace {

std::string predictionText(const Prediction& p, const PowderFile& powder) {
    std::size_t widest = 6;
    for (const PredictedFigure& f : p.figures) widest = std::max(widest, f.name.size());
    std::string text =
        fmt::format("{}: {}{}\n{:<{}}  {:>11}  {:>11} {:<14} {}\n", printable(powder.title), counted(p.draws, "draw"),
                    p.failed > 0 ? fmt::format(", of which {} failed", p.failed) : "", "figure", widest, "mean",
                    "95 % from", "to", "draws that have it");
    for (const PredictedFigure& f : p.figures)
        text += fmt::format("{:<{}}  {:>11.4g}  {:>11.4g} {:<14.4g} {}\n", printable(f.name), widest, f.mean, f.low,
                            f.high, f.count);
    return text;
}

/// The command that goes on.
std::string againText(const RunOptions& options, const std::filesystem::path& out) {
    std::string text =
        fmt::format("vkdose run {} --powder {} --draws {} --out {}", shellWord(options.input.file.string()),
                    shellWord(options.input.powder.string()), options.draws, shellWord(out.string()));
    for (std::size_t k = 1; k < options.input.overrides.size(); ++k)  // the first one is the powder
        text += " --set " + shellWord(options.input.overrides[k]);
    return text;
}

}  // namespace

int drawsCommand(const RunOptions& options) {
    if (options.input.file.empty()) throw UsageError("a case is missing: `vkdose run CASE --powder FILE --draws 16`");
    const PowderFile powder = readPowderFile(options.input.powder);
    if (!powder.draws)
        throw CaseError(
            {{powder.file.string(), 0, "draws", "", "is missing: the powder's parameters have no distribution",
              "run the case without --draws, or give the draws that `vkdose calibrate` wrote"}});
    SweepOptions sweep;
    static_cast<MemberOptions&>(sweep) = options.ofDraws;
    sweep.backend = options.backend;
    sweep.quiet = options.quiet;
    const Study study = drawsStudy(options.input.file, options.input.overrides, *powder.draws, options.draws);
    const std::vector<Member> members = drawsMembers(study);
    sweep.out = options.out.empty() ? std::filesystem::path("out") / study.name : options.out;
    sweep.again = againText(options, sweep.out);
    const auto write = [&](const SweepFolder& folder) {
        const Prediction prediction = predictionOf(members, folder);
        writeFindingFile(folder.path() / kPredictionName, predictionJson(prediction));
        if (!options.quiet) tell("{}", predictionText(prediction, powder));
    };
    return playSweep(sweep, study, members, *makeRunner(sweep), {"run", kPredictionName, write});
}

}  // namespace vkdose
