#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "host/advice/figures.h"
#include "host/app/calibration_text.h"
#include "host/app/commands.h"
#include "host/app/exit_code.h"
#include "host/app/measures.h"
#include "host/app/sweep_setup.h"
#include "host/app/tell.h"
#include "host/app/text.h"
#include "host/core/error.h"
#include "host/core/printable.h"
#include "host/study/finding_file.h"
#include "host/study/scale_study.h"

namespace vkdose {

namespace {

/// The widths of the device that spheres have to fit into.
std::vector<ScaleFinding::Gap> gapsOf(const Case& c) {
    std::vector<ScaleFinding::Gap> gaps;
    if (c.canister) gaps.push_back({"outlet", c.canister->outletDiameter});
    gaps.push_back({"gap between turns", figuresOf(c, insertParticles(c)).coilGap});
    const Vec3 room = c.filling.region.high - c.filling.region.low;
    gaps.push_back({"fill", std::min({room.x, room.y, room.z})});
    std::erase_if(gaps, [](const auto& gap) { return !std::isfinite(gap.width); });
    return gaps;
}

std::string sizesText(const ScaleFinding& f) {
    std::string text = "spheres    diameter    particles   time step   particle-steps   widths in diameters\n";
    for (const ScaleFinding::Size& size : f.sizes) {
        text += fmt::format("{:<9}  {:<10}  {:<10}  {:<10}  {:<15}", fmt::format("{:.4g}x", size.factor),
                            lengthText(size.diameter), size.particles, fmt::format("{:.3g} s", size.timeStep),
                            large(size.work));
        for (std::size_t g = 0; g < f.gaps.size(); ++g)
            text += fmt::format("{} {} {:.3g}", g > 0 ? "," : " ", f.gaps[g].name, size.widths[g]);
        text += "\n";
    }
    return text;
}

/// "holds up to 2x: spheres of 2.6 mm, outlet 5.1 of them; at 3x it is not known: give more seeds"
std::string holdsText(const ScaleFinding& f, const ScaleFinding::Figure& figure) {
    const ScaleFinding::Size& size = f.sizes[figure.holds];
    std::string text = fmt::format("holds up to {:.4g}x: spheres of {}", size.factor, lengthText(size.diameter));
    for (std::size_t g = 0; g < f.gaps.size(); ++g)
        text += fmt::format(", {} {:.3g} of them", f.gaps[g].name, size.widths[g]);
    const std::size_t next = figure.holds + 1;
    if (next == f.sizes.size()) return text;
    const bool open = figure.verdicts[next] == ScaleFinding::Verdict::Open;
    return text +
           fmt::format("; at {:.4g}x it {}", f.sizes[next].factor, open ? "is not known: give more seeds" : "differs");
}

std::string figureText(const ScaleFinding& f, const ScaleFinding::Figure& figure) {
    std::string text = printable(figure.name) + "\n";
    const double first = figure.at.front().value;
    for (std::size_t k = 0; k < figure.at.size(); ++k) {
        text += fmt::format("    {:<7} {:<24}", fmt::format("{:.4g}x", f.sizes[k].factor),
                            withError(figure.at[k].value, figure.at[k].error));
        const double off = 100 * (figure.at[k].value - first) / std::abs(first);
        if (k > 0 && first != 0) text += fmt::format(" {:+.1f} %,", off == 0 ? 0 : off);  // no -0.0
        text += k > 0 ? fmt::format(" {}\n", verdictText(figure.verdicts[k])) : "\n";
    }
    return text + "    " + holdsText(f, figure) + "\n";
}

/// Sizes as "0.7,1,1.5": rising.
std::vector<double> readFactors(const std::vector<double>& given) {
    const bool rises = std::is_sorted(given.begin(), given.end(), std::less_equal<>());
    if (given.size() < 2 || !rises || !(given.front() > 0) || !(given.back() <= 1000))
        throw UsageError("--sizes: give two factors or more, each larger than the one before: 1,1.5,2,3");
    return given;
}

}  // namespace

int scaleCommand(const ScaleOptions& o) {
    SweepOptions options = o.sweep;
    const ScaleAim aim{readFactors(o.factors), o.seeds, o.within / 100};
    const Study study = scaleStudy(options.study, options.overrides, aim);
    if (options.out.empty()) options.out = std::filesystem::path("out") / study.name;
    options.again =
        fmt::format("vkdose scale {} --sizes {:g} --seeds {} --within {:g} --out {}", shellWord(options.study.string()),
                    fmt::join(aim.factors, ","), aim.seeds, o.within, shellWord(options.out.string()));
    for (const std::string& text : options.overrides) options.again += " --set " + shellWord(text);
    const std::vector<Member> members = membersOf(study);
    if (options.dryRun) {
        tell("{}", planText(options, study, members));
        return kOk;
    }
    const auto write = [&](const SweepFolder& folder) {
        const Case smallest = loadResolvedCase(members.front().caseText, study.base);
        const ScaleFinding finding = scaleFinding(study, aim, members, folder, gapsOf(smallest));
        writeFindingFile(folder.path() / kScaleName, scaleJson(finding));
        std::string text = sizesText(finding);
        for (const ScaleFinding::Figure& figure : finding.figures) text += figureText(finding, figure);
        tell("{}", text);
    };
    return playSweep(options, study, members, *makeRunner(options), {"scale", kScaleName, write});
}

}  // namespace vkdose
