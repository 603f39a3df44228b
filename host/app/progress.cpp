#include "host/app/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <string>

#include "host/analysis/targets.h"
#include "host/app/tell.h"
#include "host/app/text.h"
#include "host/sim/added_series.h"

namespace vkdose {

namespace {

constexpr int kBarWidth = 24;
constexpr std::chrono::milliseconds kRedraw{200};
constexpr std::chrono::seconds kLine{10};

double fraction(const Progress& p) {
    if (p.expectedSteps == 0) return 0;
    return std::min(1.0, static_cast<double>(p.step) / static_cast<double>(p.expectedSteps));
}

std::string bar(const Progress& p) {
    const auto full = static_cast<int>(fraction(p) * kBarWidth);
    return "[" + std::string(full, '#') + std::string(kBarWidth - full, '-') + "]";
}

}  // namespace

std::string progressText(const Progress& p) {
    const std::string phase =
        p.dose > 0 ? fmt::format("dose {} {}", p.dose, phaseName(p.phase)) : std::string(phaseName(p.phase));
    const double rate = p.wallTime > 0 ? p.particleSteps / p.wallTime : 0;
    std::string text = fmt::format("{:<14} t = {:.3f} s", phase, p.time);
    if (p.expectedSteps > 0) {
        const double left = static_cast<double>(p.expectedSteps - p.step);
        const double eta = p.steps > 0 ? left * p.wallTime / static_cast<double>(p.steps) : -1;
        text += fmt::format(", {:.0f} %, {}particle-steps/s, ETA {}", 100 * fraction(p), large(rate), duration(eta));
    } else {
        text += fmt::format(", {}particle-steps/s", large(rate));
    }
    return text;
}

ProgressDisplay::ProgressDisplay(std::FILE* stream)
    : stream_(stream), terminal_(isatty(fileno(stream)) == 1), last_(Clock::now()) {}

ProgressDisplay::~ProgressDisplay() {
    close();
}

void ProgressDisplay::onProgress(const Progress& p) {
    const auto now = Clock::now();
    if (terminal_) {
        if (now - last_ < kRedraw && !p.phaseEnd) return;
        // \033[K clears what a longer line before left behind.
        say(fmt::format("\r{} {}\033[K", bar(p), progressText(p)));
        open_ = true;
    } else {
        if (now - last_ < kLine && !p.phaseEnd) return;
        say(progressText(p) + "\n");
    }
    sendText(stream_);
    last_ = now;
}

void ProgressDisplay::onSettled(const Settling& settling, const Case& c) {
    if (c.schedule.rotateTime == 0) return;  // it is the end of the run, which tells it
    close();
    say(fmt::format("settled: {}\n", settlingSentence(settling, c)));
}

void ProgressDisplay::onDose(const Dose& d) {
    close();
    say(fmt::format("dose {}: {} g{}, cumulative {} g{}\n", d.index, grams(d.mass), d.complete ? "" : " (incomplete)",
                    grams(d.cumulative), d.target > 0 || d.stoppedBy == StopCause::Torque ? "; " + targetText(d) : ""));
}

void ProgressDisplay::onRefill(const AddedPowder& p) {
    const bool one = p.ofTable <= kToldRefills;
    if (!one && !inlets_.insert(p.table).second) return;
    close();
    say(fmt::format("refill {}: {}{}\n", p.name, seriesOf({p}).front().text(),
                    one ? "" : fmt::format("; the end of the run tells all {} together", p.ofTable)));
}

void ProgressDisplay::say(const std::string& text) {
    vkdose::say(stream_, text);
}

void ProgressDisplay::close() {
    if (open_) say("\n");
    open_ = false;
}

}  // namespace vkdose
