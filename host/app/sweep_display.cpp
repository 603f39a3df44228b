#include "host/app/sweep_display.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "host/app/tell.h"
#include "host/app/text.h"
#include "host/core/printable.h"

namespace vkdose {

namespace {

constexpr std::chrono::seconds kLine{60};

/// "3 doses, mean 3.70 g, RSD 12.1 %"
std::string dosesText(const MemberResult& result) {
    Table table(kOutputColumns);
    table.add(result.outputs);
    const auto number = [&](const char* column) -> std::optional<double> {
        const double value = numberIn(table.text(0, column));
        return std::isnan(value) ? std::nullopt : std::optional(value);
    };
    const double doses = number("doses").value_or(0);
    std::string text = counted(std::size_t(doses), "dose");
    if (const auto mean = number("mean_dose_kg")) text += fmt::format(", mean {} g", grams(*mean));
    if (const auto rsd = number("rsd")) text += fmt::format(", RSD {:.1f} %", *rsd * 100);
    if (const auto wall = number("wall_time_s")) text += fmt::format(", {}", duration(*wall));
    return text;
}

}  // namespace

std::string memberText(const Study& study, const Member& member) {
    std::string text;
    const std::vector<std::string> keys = study.keys();
    for (std::size_t i = 0; i < keys.size(); ++i) text += fmt::format("{} {}, ", keys[i], printable(member.values[i]));
    return text + fmt::format("seed {}", member.seed);
}

std::string membersText(const Study& study, const std::vector<Member>& members, const LaterMembers& later,
                        const Speed& speed, int atOnce) {
    const std::vector<Bed> beds = bedsOf(members);
    std::map<int, int> bedOf;
    for (const Bed& bed : beds)
        for (const int number : bed.members) bedOf[number] = bed.number;
    std::string text;
    double work = 0, longest = 0;
    for (const Member& m : members) {
        const std::string bed = bedOf.contains(m.number) ? fmt::format(", bed {:04}", bedOf.at(m.number)) : "";
        text += fmt::format("member {:04}  {:>7} particles  {:>9}particle-steps  {:>12}  {}{}\n", m.number, m.particles,
                            large(m.expectedWork), duration(m.expectedWork / speed.rate), memberText(study, m), bed);
        work += m.expectedWork;
        longest = std::max(longest, m.expectedWork);
    }
    const double saved = workSaved(beds, members);
    work -= saved;
    if (later.most > 0)
        text += fmt::format("up to {} {}: at most {}particle-steps\n", counted(later.most, "more member"), later.what,
                            large(later.work));
    const char* most = later.most > 0 ? "at most " : "";
    text += fmt::format("{}: {}{}, {}{}particle-steps by the closed forms\n", printable(study.name), most,
                        counted(members.size() + later.most, "member"), most, large(work + later.work));
    if (!beds.empty())
        text +=
            fmt::format("{} settle{} once, for {}, which saves up to {}particle-steps\n", counted(beds.size(), "bed"),
                        beds.size() == 1 ? "s" : "", counted(bedOf.size(), "member"), large(saved));
    if (members.empty()) return text;
    // Fewer members than places, or one that takes longer than all others together, leave places empty.
    const auto steps = [&](double all, double one, std::size_t runs) {
        return runs == 0 ? 0 : std::max(all / double(std::min(std::size_t(atOnce), runs)), one);
    };
    const double time = steps(work, longest, members.size()) +
                        steps(later.work, later.longest, std::min(later.most, std::size_t(later.atOnce)));
    text += fmt::format("run time {}{} with {} at a time, {}\n", most, duration(time / speed.rate),
                        std::min(atOnce, static_cast<int>(members.size())), speedText(speed));
    return text + caveatText(speed, 9);
}

double SweepPace::secondsLeft(const SweepProgress& p, Clock::time_point now) {
    if (!began_ && p.running > 0) began_ = now;
    if (!began_ || p.fractionHere <= 0) return -1;
    return std::chrono::duration<double>(now - *began_).count() * (1 - p.fraction) / p.fractionHere;
}

SweepDisplay::SweepDisplay(std::string command, const Study& study, bool quiet)
    : command_(std::move(command)), study_(study), quiet_(quiet), terminal_(isatty(fileno(stderr)) == 1) {}

SweepDisplay::~SweepDisplay() {
    close();
}

void SweepDisplay::begin(const std::vector<Member>& members, const std::string& manner) {
    if (quiet_) return;
    tell("{}: {}, {}\n", printable(study_.name), counted(members.size(), "member"), manner);
    sendText(stdout);
}

void SweepDisplay::confirm(const std::string& place, std::size_t runs) {
    if (quiet_) return;
    close();
    tell("confirming {}: {} with new seeds\n", printable(place), counted(runs, "run"));
    sendText(stdout);
}

void SweepDisplay::onMember(const Member& member, const MemberResult& result) {
    const bool failed = result.status == MemberStatus::Failed;
    if (quiet_ && !failed) return;
    close();
    const std::string head = fmt::format("member {:04} ({})", member.number, memberText(study_, member));
    if (failed) {
        tell(stderr, "{} failed: {}\n", head, printable(result.error));
    } else {
        tell("{} {}: {}\n", head, statusText(result.status), dosesText(result));
        sendText(stdout);
    }
}

void SweepDisplay::onProgress(const SweepProgress& p) {
    const auto now = SweepPace::Clock::now();
    const double left = pace_.secondsLeft(p, now);
    if (quiet_ || (!terminal_ && now - last_ < kLine)) return;
    last_ = now;
    std::string text =
        fmt::format("{} of {} done, {} running", p.ok + p.failed, counted(p.members, "member"), p.running);
    if (p.failed > 0) text += fmt::format(", {} failed", p.failed);
    text += fmt::format("; {:.0f} %, ETA {}", 100 * p.fraction, duration(left));
    // \033[K clears what a longer line before left behind.
    say(stderr, terminal_ ? "\r" + text + "\033[K" : text + "\n");
    sendText(stderr);
    open_ = terminal_;
}

void SweepDisplay::onBeds(std::size_t beds, std::size_t members) {
    if (quiet_) return;
    close();
    tell("{} settle{} once, for {}\n", counted(beds, "bed"), beds == 1 ? "s" : "", counted(members, "member"));
    sendText(stdout);
}

void SweepDisplay::onBusy(const std::filesystem::path& folder) {
    close();
    tell(stderr, "vkdose: waiting for the process that writes into {}\n", printable(folder.string()));
}

void SweepDisplay::onAnew(const Member& member, const std::string& why) {
    close();
    tell(stderr, "vkdose: member {:04} starts anew, because {}\n", member.number, why);
}

std::string SweepDisplay::again(const SweepFolder& folder, const SweepOptions& options) const {
    std::string command = options.again;
    if (command.empty()) {
        command = fmt::format("vkdose {} {} --out {}", command_, shellWord(study_.file.string()),
                              shellWord(folder.path().string()));
        for (const std::string& text : study_.overrides) command += " --set " + shellWord(text);
    }
    if (options.backend.backend != BackendChoice().backend) command += " --backend " + options.backend.backend;
    if (!options.backend.device.empty()) command += " --device " + shellWord(options.backend.device);
    if (options.jobs > 0) command += fmt::format(" --jobs {}", options.jobs);
    if (options.ensemble > 0) command += fmt::format(" --ensemble {}", options.ensemble);
    return command;
}

void SweepDisplay::finish(const SweepFolder& folder, const SweepOutcome& outcome, const SweepOptions& options) {
    close();
    const std::string command = again(folder, options);
    const std::string timed = options.limit ? command + " --for " + shellWord(options.limit->text()) : command;
    if (!outcome.whole && outcome.halt == Halt::TimeIsUp)
        tell(stderr, "vkdose: the time is up; {} of {} left, {}particle-steps by the closed forms; go on with `{}`\n",
             outcome.members - outcome.ok - outcome.failed, counted(std::size_t(outcome.members), "member"),
             large(outcome.workLeft), timed);
    else if (!outcome.whole)
        tell(stderr, "vkdose: interrupted; go on with `{}`\n", timed);
    else if (outcome.failed > 0)
        tell(stderr, "vkdose: {} failed; run again with `{} --retry-failed`\n",
             counted(std::size_t(outcome.failed), "member"), command);
    if (quiet_) return;
    tell("{} done, {} failed\noutput   {}\n", outcome.ok, outcome.failed, printable(folder.path().string()));
    if (outcome.ok > 0) tell("next     vkdose report {}\n", shellWord(folder.path().string()));
}

void SweepDisplay::close() {
    if (open_) say(stderr, "\n");
    open_ = false;
}

}  // namespace vkdose
