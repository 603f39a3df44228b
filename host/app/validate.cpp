#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <set>

#include "host/app/exit_code.h"
#include "host/app/find_case.h"
#include "host/app/interrupt.h"
#include "host/app/tell.h"
#include "host/app/text.h"
#include "host/app/validate.h"
#include "host/core/file.h"
#include "host/core/printable.h"
#include "host/report/page.h"
#include "host/study/member.h"
#include "host/study/study.h"
#include "host/validate/comparisons.h"
#include "host/validate/tables.h"
#include "host/verify/suite.h"

namespace vkdose {

namespace fs = std::filesystem;

namespace {

using validate::Comparison;
using validate::Result;

/// The impacts of the verification suite that are published tests. The rest of the family `hertz` is not.
constexpr const char* kImpacts = "chung-ooi";
constexpr const char* kImpactCases[] = {
    "hertz/spheres",          "hertz/wall",          "hertz/restitution",   "hertz/oblique",
    "hertz/oblique-sticking", "hertz/spinning-wall", "hertz/spinning-pair", "hertz/spinning-unequal"};

bool chosen(const ValidateOptions& options, const std::string& name) {
    return options.names.empty() || std::find(options.names.begin(), options.names.end(), name) != options.names.end();
}

/// Tests 1 to 8 as figures: the largest error of each case, in units of what it may be.
Result impacts(const ValidateOptions& options) {
    Result result{kImpacts,
                  "impacts of elastic spheres with each other and with walls, tests 1 to 8",
                  "Y. C. Chung, J. Y. Ooi, Granular Matter 13 (2011) 643",
                  {},
                  "",
                  "",
                  ""};
    const auto start = std::chrono::steady_clock::now();
    const std::unique_ptr<Backend> backend = makeBackend(options.sweep.backend, 1);
    result.backend = backend->description();
    int test = 0;
    for (const char* name : kImpactCases) {
        const verify::Scene scene = verify::scenesNamed(name).front();
        validate::Finding finding{fmt::format("test {}: largest error over what is allowed", ++test), "-", 0};
        const std::vector<verify::Check> checks = verify::play(scene, *backend);
        finding.got = verify::worstShare(checks);
        finding.high = 1;
        finding.source = test <= 2   ? "published figures and closed forms"
                         : test <= 4 ? "closed forms"
                                     : "closed forms, integrated impacts";
        finding.remark = fmt::format("{} figures of vkdose test verify --only {}", checks.size(), name);
        result.evaluation.findings.push_back(finding);
    }
    result.cost =
        fmt::format("{:.1f} s", std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    return result;
}

fs::path outOf(const ValidateOptions& options) {
    if (!options.sweep.out.empty()) return options.sweep.out;
    return fs::path("out") / (options.full ? "validate-full" : "validate");
}

/// The command that goes on with the comparisons, without the options that every sweep has.
std::string againText(const ValidateOptions& options) {
    std::string text = "vkdose test validate";
    for (const std::string& name : options.names) text += " " + name;
    if (options.full) text += " --full";
    return text + " --out " + shellWord(outOf(options).string());
}

/// "4 runs, 61 s of stepping by the clock, 2.4e+08 particle-steps"; "3 of 4 runs, ..." as long as others have to end.
std::string costOf(const std::vector<validate::Run>& runs, std::size_t members) {
    double seconds = 0, steps = 0;
    for (const validate::Run& run : runs) {
        seconds += run.figure("/stepping_wall_time_s");
        steps += run.figure("/particle_steps");
    }
    const std::string count = runs.size() == members ? counted(members, "run")
                                                     : fmt::format("{} of {}", runs.size(), counted(members, "run"));
    return fmt::format("{}, {:.0f} s of stepping by the clock, {:.2g} particle-steps", count, seconds, steps);
}

/// The backends that runs name, each once: those of an earlier call may be of another one.
std::string backendsOf(const std::vector<validate::Run>& runs) {
    std::set<std::string> all;
    for (const validate::Run& run : runs) all.insert(run.summary.at("backend").get<std::string>());
    return all.empty() ? "no backend" : fmt::format("{}", fmt::join(all, " and "));
}

Result judged(const Comparison& c, const SweepOptions& sweep, const std::vector<validate::Run>& runs) {
    const std::size_t members = membersOf(readStudy(sweep.study)).size();
    return {c.name,           c.what, c.source, c.evaluate(runs, sweep.study.parent_path()), costOf(runs, members),
            backendsOf(runs), ""};
}

void tellFindings(const Result& result) {
    if (result.missing.empty())
        tell("\n{}: {} ({}, on {})\n", result.name, result.what, result.cost, result.backend);
    else
        tell("\n{}: not made: {}\n", result.name, result.missing);
    for (const validate::Finding& f : result.evaluation.findings) tell("{}\n", validate::tableLine(f));
    sendText(stdout);
}

void write(const fs::path& out, const std::vector<Result>& results) {
    replaceFile(out / "validate.md", validate::markdownTable(results));
    replaceFile(out / "validate.json", validate::jsonTable(results));
    replaceFile(out / "validate.html", report::page(validate::pageData(results)));
    for (const Result& r : results)
        if (!r.evaluation.charts.empty())
            replaceFile(out / fmt::format("{}.csv", r.name), validate::curvesCsv(r.evaluation));
}

int list() {
    tell("{:<20} impacts of elastic spheres, tests 1 to 8 (Chung and Ooi 2011)\n", kImpacts);
    for (const Comparison& c : validate::comparisons()) tell("{:<20} {} ({})\n", c.name, c.what, c.source);
    for (const validate::Missing& m : validate::missingComparisons())
        tell("{:<20} {}. Not made: {}\n", m.name, m.what, m.why);
    return kOk;
}

}  // namespace

std::vector<std::string> comparisonNames() {
    std::vector<std::string> names{kImpacts};
    for (const Comparison& c : validate::comparisons()) names.emplace_back(c.name);
    return names;
}

int validateCommand(const ValidateOptions& options) {
    if (options.list) return list();
    std::vector<fs::path> studies;
    for (const Comparison& c : validate::comparisons())
        studies.push_back(findCase(fmt::format("validate/{}{}.toml", options.full ? "full/" : "", c.name)));
    const fs::path out = outOf(options);
    if (!options.judge) createFolder(out);

    std::vector<Result> results;
    int failed = kOk;
    if (!options.judge && chosen(options, kImpacts)) results.push_back(impacts(options));
    for (std::size_t i = 0; i < studies.size(); ++i) {
        const Comparison& c = validate::comparisons()[i];
        if (!chosen(options, c.name)) continue;
        SweepOptions sweep = options.sweep;
        sweep.study = studies[i];
        sweep.out = out / c.name;
        sweep.again = againText(options);
        if (!options.judge)
            if (const int code = sweepCommand(sweep); code != kOk) failed = code;
        if (failed == kInterrupted || failed == kTimeIsUp) break;
        if (options.judge && !fs::exists(sweep.out / "members.csv")) continue;
        const std::vector<validate::Run> runs = validate::readRuns(sweep.out);
        if (!options.judge || !runs.empty()) results.push_back(judged(c, sweep, runs));
    }
    if (options.judge && results.empty())
        throw UsageError(fmt::format("{} has no run of a comparison that has ended; run it without --judge first",
                                     printable(out.string())));
    if (options.names.empty() && !options.judge)
        for (const validate::Missing& m : validate::missingComparisons())
            results.push_back({m.name, m.what, "", {}, "", "", m.why});

    if (!results.empty()) write(out, results);
    tell("{}\n", validate::headLine());
    for (const Result& r : results) tellFindings(r);
    tell("\n{}; {} has the curves, validate.md and validate.json the same figures\n", validate::tally(results),
         printable((out / "validate.html").string()));
    if (failed != kOk) return failed;
    return validate::differing(results) == 0 ? kOk : kDisagree;
}

}  // namespace vkdose
