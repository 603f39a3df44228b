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

std::string membersText(const Study& study, const std::vector<Member>& members, const Speed& speed, int atOnce) {
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
    text += fmt::format("{}: {}, {}particle-steps by the closed forms\n", printable(study.name),
                        counted(members.size(), "member"), large(work));
    if (!beds.empty())
        text +=
            fmt::format("{} settle{} once, for {}, which saves up to {}particle-steps\n", counted(beds.size(), "bed"),
                        beds.size() == 1 ? "s" : "", counted(bedOf.size(), "member"), large(saved));
    if (members.empty()) return text;
    // Fewer members than places, or one that takes longer than all others together, leave places empty.
    const int places = std::min(atOnce, static_cast<int>(members.size()));
    text += fmt::format("run time {} with {} at a time, {}\n", duration(std::max(work / places, longest) / speed.rate),
                        places, speedText(speed));
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
    std::fflush(stdout);
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
        std::fflush(stdout);
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
    // \033[K clears what a longer line before left behind. A failed write is ignored. A lost terminal needs no error
    // here, because its closing interrupts the sweep.
    (void)std::fputs((terminal_ ? "\r" + text + "\033[K" : text + "\n").c_str(), stderr);
    std::fflush(stderr);
    open_ = terminal_;
}

void SweepDisplay::onBeds(std::size_t beds, std::size_t members) {
    if (quiet_) return;
    close();
    tell("{} settle{} once, for {}\n", counted(beds, "bed"), beds == 1 ? "s" : "", counted(members, "member"));
    std::fflush(stdout);
}

void SweepDisplay::onBusy(const std::filesystem::path& folder) {
    close();
    tell(stderr, "vkdose: waiting for the process that writes into {}\n", printable(folder.string()));
}

void SweepDisplay::onAnew(const Member& member, const std::string& why) {
    close();
    tell(stderr, "vkdose: member {:04} starts anew, because {}\n", member.number, why);
}

void SweepDisplay::finish(const SweepFolder& folder, const SweepOutcome& outcome) {
    close();
    std::string again = fmt::format("vkdose {} {} --out {}", command_, shellWord(study_.file.string()),
                                    shellWord(folder.path().string()));
    for (const std::string& text : study_.overrides) again += " --set " + shellWord(text);
    if (!outcome.whole)
        tell(stderr, "vkdose: interrupted; go on with `{}`\n", again);
    else if (outcome.failed > 0)
        tell(stderr, "vkdose: {} failed; run again with `{} --retry-failed`\n", counted(outcome.failed, "member"),
             again);
    if (quiet_) return;
    tell("{} done, {} failed\noutput   {}\n", outcome.ok, outcome.failed, printable(folder.path().string()));
    if (outcome.ok > 0) tell("next     vkdose report {}\n", shellWord(folder.path().string()));
}

void SweepDisplay::close() {
    if (open_) (void)std::fputs("\n", stderr);
    open_ = false;
}

}  // namespace vkdose
