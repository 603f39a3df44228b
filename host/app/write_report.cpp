#include <fmt/format.h>

#include "host/app/commands.h"
#include "host/app/exit_code.h"
#include "host/app/inputs.h"
#include "host/app/tell.h"
#include "host/core/file.h"
#include "host/core/printable.h"
#include "host/output/run_files.h"
#include "host/report/free_surface_report.h"
#include "host/report/page.h"
#include "host/report/player_data.h"
#include "host/report/run_report.h"
#include "host/report/runs_report.h"
#include "host/report/study_report.h"
#include "host/study/sweep_folder.h"

namespace vkdose {

namespace fs = std::filesystem;

namespace {

/// The folder to report on: the one named, or, for a study's file, the one that `vkdose sweep` writes by default.
fs::path folderOf(const fs::path& source) {
    if (!fs::is_regular_file(source)) return source;
    fs::path folder = fs::path("out") / source.stem();
    if (!fs::is_directory(folder))
        throw UsageError(fmt::format("report {}: there is no folder {}; name the sweep's output folder",
                                     source.string(), folder.string()));
    return folder;
}

void requireFolder(const fs::path& folder) {
    if (!fs::is_directory(folder)) throw UsageError(fmt::format("report: there is no folder {}", folder.string()));
    if (!report::isSweep(folder) && !fs::exists(folder / "case.toml"))
        throw UsageError(
            fmt::format("report: {} holds neither a run (case.toml) nor a sweep (members.csv)", folder.string()));
}

/// One page about several runs.
int compareRuns(const ReportOptions& options) {
    if (options.experiment || options.expected || !options.profiles.empty())
        throw UsageError("report: --experiment, --expected and --profile belong to the report of one run or sweep");
    std::vector<fs::path> read;
    for (std::size_t i = 0; i < options.sources.size(); ++i) {
        const fs::path& folder = options.sources[i];
        requireFolder(folder);
        if (report::isSweep(folder))
            throw UsageError(fmt::format(
                "report: {} is a sweep; it has a report of its own, or name its members' folders", folder.string()));
        for (std::size_t j = 0; j < i; ++j)
            if (fs::equivalent(folder, options.sources[j]))
                throw UsageError(fmt::format("report: {} is named twice", folder.string()));
        for (const fs::path& file : filesOfRun(folder))
            if (file.filename() != "report.html") read.push_back(file);
    }
    const fs::path file = options.out.empty() ? "comparison.html" : options.out;
    keepInputs(read, {file});
    replaceFile(file, report::page(report::runsJson(options.sources)));
    tell("{}\n", printable(file.string()));
    return kOk;
}

}  // namespace

int reportCommand(const ReportOptions& options) {
    if (options.sources.size() > 1) return compareRuns(options);
    const fs::path folder = folderOf(options.sources.front());
    requireFolder(folder);
    const bool sweep = report::isSweep(folder);
    if (sweep && options.experiment)
        throw UsageError("report: --experiment belongs to the report of a run; this is a sweep");
    if (sweep && !options.profiles.empty())
        throw UsageError("report: --profile belongs to the report of a run; this is a sweep");
    if (!sweep && options.expected)
        throw UsageError("report: --expected belongs to the report of a sweep; this is a run");
    std::vector<report::Photograph> photographs;
    for (const std::string& profile : options.profiles) photographs.push_back(report::photographOf(profile));
    const fs::path file = options.out.empty() ? folder / "report.html" : options.out;
    std::vector<fs::path> read = sweep ? SweepFolder::files(folder) : filesOfRun(folder);
    std::erase(read, folder / "report.html");
    read.push_back(options.sources.front());
    if (options.experiment) read.push_back(*options.experiment);
    if (options.expected) read.push_back(*options.expected);
    for (const report::Photograph& p : photographs) read.push_back(p.file);
    keepInputs(read, {file});
    const report::Json data = sweep
                                  ? report::studyJson(folder, options.expected)
                                  : report::runJson(folder, options.experiment, report::framesOf(folder), photographs);
    replaceFile(file, report::page(data));
    tell("{}\n", printable(file.string()));
    return kOk;
}

}  // namespace vkdose
