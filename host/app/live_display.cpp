#include "host/app/live_display.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdlib>
#include <string_view>
#include <utility>

#include "host/app/tell.h"

namespace vkdose {

namespace {

/// The largest fraction of the wall time that reading back and drawing may take. It is a quarter of the promised
/// fraction, because drawing was measured to slow the run by more than twice its own time.
constexpr double kShare = 0.005;
constexpr double kInterval = 0.2;  ///< [s]

std::string_view environment(const char* name) {
    const char* value = std::getenv(name);
    return value == nullptr ? std::string_view() : std::string_view(value);
}

terminal::Style styleOfTerminal() {
    const std::string_view colours = environment("COLORTERM");
    const bool all = colours == "truecolor" || colours == "24bit";
    return all && environment("NO_COLOR").empty() ? terminal::Style::Colour : terminal::Style::Plain;
}

}  // namespace

LiveDisplay::LiveDisplay(const Case& c, const Derived& derived, const Backend& backend, std::vector<Dose> before,
                         std::FILE* stream)
    : backend_(backend),
      scene_(terminal::sceneOf(c, derived.tipVelocity)),
      style_(styleOfTerminal()),
      stream_(stream),
      pace_(kShare, kInterval),
      start_(std::chrono::steady_clock::now()) {
    state_.doses = std::move(before);
    state_.closedForm = derived.massPerDose;
}

bool LiveDisplay::possible(std::FILE* stream, std::string& why) {
    if (isatty(fileno(stream)) != 1)
        why = "the output is not a terminal";
    else if (environment("TERM").empty() || environment("TERM") == "dumb")
        why = "TERM says that the terminal cannot move its cursor";
    else
        return true;
    return false;
}

double LiveDisplay::now() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

void LiveDisplay::onProgress(const Progress& p) {
    progress_ = p;
    const double begin = now();
    if (!pace_.due(begin)) return;
    read(p);
    draw();
    pace_.drew(begin, now());
}

void LiveDisplay::onSample(const Sample& sample) {
    state_.loads = sample.bodies;
}

void LiveDisplay::onDose(const Dose& dose) {
    state_.doses.push_back(dose);
}

void LiveDisplay::read(const Progress& p) {
    state_.frame = {p.step, p.time, p.phase, p.dose, backend_.coilAngle(), backend_.particles(), {}, p.bodiesMoved};
    state_.underWay = p.doseMass;
}

void LiveDisplay::draw() {
    winsize size{};
    if (ioctl(fileno(stream_), TIOCGWINSZ, &size) != 0 || size.ws_col == 0 || size.ws_row == 0) {
        size.ws_col = 80;
        size.ws_row = 24;
    }
    // The cursor is hidden only while it moves over the picture, so that the terminal is as it was whenever the program
    // ends.
    std::string text = "\033[?25l";
    if (columns_ != 0 && (size.ws_col != columns_ || size.ws_row != rows_))
        text += "\033[H\033[2J";  // the terminal has wrapped lines anew, so the place of the picture is unknown
    else if (lines_ > 0)
        text += fmt::format("\033[{}A", lines_);
    state_.progress = progressText(progress_);
    columns_ = size.ws_col;
    rows_ = size.ws_row;
    // One column and row short: a full line would wrap, a full screen scroll.
    const auto lines = terminal::screenLines(scene_, state_, columns_ - 1, rows_ - 1, style_);
    for (const std::string& line : lines) text += line + "\033[K\n";
    text += "\033[J\033[?25h";
    lines_ = lines.size();
    say(stream_, text);
    sendText(stream_);
}

void LiveDisplay::close() {
    if (lines_ > 0) draw();
    lines_ = 0;
}

}  // namespace vkdose
