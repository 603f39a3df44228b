#include <fmt/format.h>
#include <unistd.h>

#include "host/advice/advice.h"
#include "host/app/commands.h"
#include "host/app/end_table.h"
#include "host/app/events_display.h"
#include "host/app/exit_code.h"
#include "host/app/from.h"
#include "host/app/interrupt.h"
#include "host/app/live_display.h"
#include "host/app/play.h"
#include "host/app/progress.h"
#include "host/app/tell.h"
#include "host/app/text.h"
#include "host/core/printable.h"
#include "host/output/measured.h"
#include "host/output/run_history.h"
#include "host/sim/run_record.h"

namespace vkdose {

namespace {

/// How a command plays a run, and whether it says more than what went wrong.
struct Manner {
    const BackendChoice& choice;
    bool quiet = false;
    bool live = false;    ///< the bed on the terminal
    bool events = false;  ///< JSON on stdout, and no text
    bool orders = false;  ///< taken from the standard input
    int parent = 0;
};

/// The display that was asked for. Where a live display is not possible, the plain one; for a quiet run, none.
std::unique_ptr<RunDisplay> makeDisplay(const Manner& manner, const ReadyRun& run, const Backend& backend) {
    if (manner.quiet) return nullptr;
    std::string why;
    if (manner.live && LiveDisplay::possible(stdout, why)) {
        std::vector<Dose> before;
        if (run.from) get(run.from->run.run, "doses", before);
        return std::make_unique<LiveDisplay>(run.c, derive(run.c, run.filled), backend, std::move(before));
    }
    if (manner.live) tell(stderr, "vkdose: no --live, because {}; going on with plain progress\n", why);
    return std::make_unique<ProgressDisplay>();
}

/// The case, its warnings and every event of the run as JSON, in place of all text.
int playAsEvents(ReadyRun run, Backend& backend, RunFolder& folder, const Manner& manner) {
    const std::atomic<bool>& stop = watchInterrupts();
    if (manner.parent != 0) endWithParent(manner.parent);
    const Case c = run.c;
    EventsDisplay events(c, manner.orders ? std::make_unique<Orders>(c, STDIN_FILENO) : nullptr);
    events.begin(run.filled, folder.path(), backend.description(), run.from ? run.from->time : 0);
    for (const Warning& w : warningsOf(run.c, run.filled)) events.warn(w);
    const Played played = play(std::move(run), backend, folder, &events, stop);
    const bool clean = validationClean(manner.choice, backend);
    const ExitCode code = played.error.empty() && !clean ? kDeviceError : played.code;
    events.end(played.result, code, played.error, folder.path());
    if (!played.error.empty()) tell(stderr, "vkdose: {}\n", printable(played.error));
    return code;
}

/// Tells once what was probably not meant. It stops no run.
void tellWarnings(const ReadyRun& run) {
    for (const Warning& w : warningsOf(run.c, run.filled))
        if (!w.accepted) tell(stderr, "vkdose: warning: {}\n", w.line());
}

/// The commands that go on from a run that is over.
std::string nextText(const std::filesystem::path& folder) {
    const std::string word = shellWord(folder.string());
    return fmt::format(
        "next     vkdose report {0}   (charts, tables, a player)\n"
        "         vkdose render {0}   (a picture of its end)\n",
        word);
}

/// Runs, from the start or from a checkpoint, and tells how it ended.
int playAloud(ReadyRun run, Backend& backend, RunFolder& folder, const Manner& manner) {
    if (manner.events) return playAsEvents(std::move(run), backend, folder, manner);
    const std::atomic<bool>& stop = watchInterrupts();
    if (manner.parent != 0) endWithParent(manner.parent);
    const Case c = run.c;
    if (!manner.quiet) {
        tell("{}: {} particles, {} g, on {}\n", c.name, run.filled.particles.size(), grams(run.filled.mass),
             backend.description());
        if (run.state) tell("from     {}\n", printable(run.role.origin));
        sendText(stdout);
    }
    const std::unique_ptr<RunDisplay> display = makeDisplay(manner, run, backend);
    const Played played = play(std::move(run), backend, folder, display.get(), stop);
    if (display) display->close();
    if (!played.error.empty()) tell(stderr, "vkdose: {}\n", printable(played.error));
    if (played.code == kOutputError) return kOutputError;
    if (!manner.quiet) {
        const std::vector<FlowSample> flow = flowIn(folder.path());
        tell("{}{}{}{}output   {}\n", reportText(c, played.result, backend.description()),
             rateLine(played.result, massRate(flow, windowRuleOf(c))),
             cycleLine(played.result, cyclesOf(flow, cycleRuleOf(c))),
             measureText(measuresOf(folder.path(), c, played.result)), printable(folder.path().string()));
        if (played.code == kInterrupted) tell("resume   {}\n", wayOn(folder));
        if (played.code == kOk) tell("{}", nextText(folder.path()));
    }
    const bool clean = validationClean(manner.choice, backend);
    return played.error.empty() && !clean ? kDeviceError : played.code;
}

}  // namespace

int runCommand(const RunOptions& options) {
    // Everything that can be refused is refused before the folder is touched.
    const bool anew = options.from.folder.empty();
    if (anew && options.input.file.empty())
        throw UsageError("a case is missing: `vkdose run CASE`, or `vkdose run --from DIR` for that of another run");
    ReadyRun run = anew ? readyRun(options.input) : readyFrom(options.input, options.from);
    const std::filesystem::path out = options.out.empty() ? std::filesystem::path("out") / run.c.name : options.out;
    std::error_code none;
    if (!anew && std::filesystem::equivalent(out, options.from.folder, none))
        throw UsageError(fmt::format("{} is the run to begin with; choose another folder with --out", out.string()));
    if (options.member) {
        run.role.member = *options.member;
        run.role.keepsStates = false;  // a study of thousands would fill the disk
    }
    const BackendChoice choice = anew ? options.backend : sameBackend(run.state->backend, options.backend);
    const std::unique_ptr<Backend> backend = makeBackend(choice, run.filled.particles.size());
    if (!options.quiet && !options.events) tellWarnings(run);
    RunFolder folder = folderOf(run, out, options.force, *backend);
    return playAloud(std::move(run), *backend, folder,
                     {choice, options.quiet, options.live, options.events, options.orders, options.parent});
}

int resumeCommand(const ResumeOptions& options) {
    ReadyRun run = readyToResume(options.folder, options.overrides);
    const BackendChoice choice = sameBackend(run.from->backend, options.backend);
    const std::unique_ptr<Backend> backend = makeBackend(choice, run.filled.particles.size());
    if (backend->description() != run.from->backend || run.from->program != VKDOSE_VERSION)
        tell(stderr,
             "vkdose: the checkpoint was written by vkdose {} on {}; going on with {} on {} is not bound to give "
             "the same bits\n",
             run.from->program, run.from->backend, VKDOSE_VERSION, backend->description());
    RunFolder folder = folderOf(run, options.folder, true, *backend);
    return playAloud(std::move(run), *backend, folder,
                     {choice, options.quiet, options.live, options.events, options.orders, options.parent});
}

}  // namespace vkdose
