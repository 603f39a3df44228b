#include "host/terminal/screen.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "host/core/grams.h"

namespace vkdose::terminal {

namespace {

constexpr int kLeastColumns = 40;
constexpr int kBesideColumns = 90;  ///< with this many columns or more the doses stand beside the bed, else below
constexpr int kPanel = 46;          ///< columns of the doses beside the bed
constexpr int kRowsBelow = 7;       ///< rows of the doses below it
constexpr int kLeastViewRows = 5;
constexpr std::size_t kMostBodies = 4;  ///< whose loads are shown
constexpr int kLoad = 9;                ///< columns of a figure
constexpr int kLongestName = 24;
constexpr int kLabel = 9;
constexpr std::size_t kUnit = 7, kUsualFigure = 6;  ///< " g ..." with a blank before the mass; "12.345"

/// The last doses, including the one under way, in so many rows. Nothing for a run without doses.
std::vector<std::string> doseRows(const LiveState& s, int columns, int rows) {
    if (!(s.closedForm > 0) || rows < 2) return {};
    std::vector<Dose> shown = s.doses;
    const bool open = s.frame.dose > 0 && (s.doses.empty() || s.doses.back().index < s.frame.dose);
    if (open) {
        Dose now;
        now.index = s.frame.dose;
        now.mass = s.underWay;
        shown.push_back(now);
    }
    const auto skipped = std::max<std::ptrdiff_t>(0, std::ptrdiff_t(shown.size()) - (rows - 1));
    shown.erase(shown.begin(), shown.begin() + skipped);

    double most = s.closedForm;
    std::size_t figure = kUsualFigure;
    for (const Dose& d : shown) {
        most = std::max(most, d.mass);
        figure = std::max(figure, grams(d.mass).size());
    }
    const int cells = columns - kLabel - int(kUnit + figure);
    std::vector<std::string> lines{fmt::format("{:<{}}│ closed form {} g", "", kLabel, grams(s.closedForm))};
    for (const Dose& d : shown) {
        const bool now = open && &d == &shown.back();
        lines.push_back(fmt::format("dose {:<3} {} {} g{}", d.index, bar(d.mass, s.closedForm, most, cells),
                                    grams(d.mass), now ? " ..." : ""));
    }
    return lines;
}

/// A load in at most eight characters.
std::string loadText(double x) {
    const std::string text = fmt::format("{:.3g}", x);
    return x == 0 || (text.size() < std::size_t(kLoad) && std::abs(x) >= 1e-3) ? text : fmt::format("{:.0e}", x);
}

int loadRowsOf(const Scene& scene) {
    const std::size_t shown = std::min(scene.loaded.size(), kMostBodies);
    return shown == 0 ? 0 : 1 + int(shown) + (scene.loaded.size() > shown ? 1 : 0);
}

/// Force, torque, power and work of the first bodies. Empty if that does not fit into so many rows.
std::vector<std::string> loadRows(const Scene& scene, const LiveState& s, int columns, int rows) {
    if (rows < loadRowsOf(scene) || scene.loaded.empty()) return {};
    const int width = std::min(columns - 4 * kLoad, kLongestName);
    const auto line = [width](const std::string& name, const std::array<std::string, 4>& figures) {
        std::string text = fmt::format("{:<{}}", name.substr(0, std::size_t(width - 1)), width);
        for (const std::string& figure : figures) text += fmt::format("{:>{}}", figure, kLoad);
        return text;
    };
    std::vector<std::string> lines{line("body", {"N", "mN m", "mW", "mJ"})};
    const std::size_t shown = std::min(scene.loaded.size(), kMostBodies);
    for (std::size_t b = 0; b < shown; ++b) {
        const BodySample load = b < s.loads.size() ? s.loads[b] : BodySample{};
        lines.push_back(line(scene.loaded[b], {loadText(glm::length(load.force)), loadText(load.torque * 1e3),
                                               loadText(load.power * 1e3), loadText(load.work * 1e3)}));
    }
    if (scene.loaded.size() > shown) lines.push_back(fmt::format("and {} more", scene.loaded.size() - shown));
    return lines;
}

/// The meaning of the spheres' colours.
std::string legend(double fast) {
    std::string text = "speed 0 ";
    for (int i = 0; i <= 8; ++i) {
        const Colour c = speedColour(fast * i / 8, fast);
        text += fmt::format("\033[38;2;{};{};{}m█", c.red, c.green, c.blue);
    }
    return text + fmt::format("\033[0m {:.3g} mm/s", fast * 1e3);
}

}  // namespace

std::string bar(double value, double mark, double most, int cells) {
    const double full = most > 0 ? std::clamp(value / most, 0.0, 1.0) * cells : 0;
    const int markCell = mark > 0 && most > 0 ? std::min(int(mark / most * cells), cells - 1) : -1;
    std::string text;
    for (int i = 0; i < cells; ++i) {
        const int eighths = int(std::lround(std::clamp(full - i, 0.0, 1.0) * 8));
        if (i == markCell)
            text += "│";
        else
            text += eighths == 0 ? std::string(" ") : utf8(0x2590U - unsigned(eighths));  // U+2588 full ... U+258F 1/8
    }
    return text;
}

std::vector<std::string> screenLines(const Scene& scene, const LiveState& s, int columns, int rows, Style style) {
    const std::string progress = s.progress.substr(0, std::size_t(std::max(columns, 0)));
    if (columns < kLeastColumns || rows < 3) return {progress};
    const bool beside = columns >= kBesideColumns;
    const int last = style == Style::Colour ? 2 : 1;
    const int doseColumns = beside ? kPanel : columns;
    const int viewColumns = beside ? columns - kPanel - 2 : columns;
    // Below the bed, rows for later doses are kept free from the start, so that the bed keeps its size.
    const int below = s.closedForm > 0 ? kRowsBelow : 0;
    const int viewRows = rows - last - (beside ? 0 : below + loadRowsOf(scene));

    std::vector<std::string> lines;
    if (viewRows >= kLeastViewRows) lines = sideView(scene, s.frame, viewColumns, viewRows, style).lines();
    const int room = beside ? int(lines.size()) : rows - last - int(lines.size());
    const std::vector<std::string> loads = loadRows(scene, s, doseColumns, room - std::min(room, below));
    std::vector<std::string> doses = doseRows(s, doseColumns, room - int(loads.size()));
    doses.insert(doses.end(), loads.begin(), loads.end());
    if (beside)
        for (std::size_t i = 0; i < doses.size(); ++i) lines[i] += "  " + doses[i];
    else
        lines.insert(lines.end(), doses.begin(), doses.end());
    if (style == Style::Colour) lines.push_back(legend(scene.fast));
    lines.push_back(progress);
    return lines;
}

}  // namespace vkdose::terminal
