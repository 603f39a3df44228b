#include "host/validate/finding.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace vkdose::validate {

Verdict Finding::verdict() const {
    if (!comparable) return Verdict::NotComparable;
    if (wanted != Wanted::Range) {
        const double right = wanted == Wanted::Positive ? got : -got;
        if (right > 2 * error) return Verdict::Agrees;
        return right >= -2 * error ? Verdict::Undecided : Verdict::Differs;
    }
    if (got >= low && got <= high) return Verdict::Agrees;
    const double outside = got < low ? low - got : got - high;
    return outside <= 2 * error ? Verdict::Undecided : Verdict::Differs;
}

Finding meanOf(const std::string& figure, const std::string& unit, const std::vector<double>& values) {
    Finding finding{figure, unit};
    if (values.empty()) return finding;
    const auto n = static_cast<double>(values.size());
    finding.got = 0;
    for (const double v : values) finding.got += v / n;
    double squares = 0;
    for (const double v : values) squares += (v - finding.got) * (v - finding.got);
    if (values.size() > 1) finding.error = std::sqrt(squares / (n * (n - 1)));
    return finding;
}

void notComparable(Finding& finding, const std::string& why) {
    finding.comparable = false;
    finding.remark = why;
}

void holdAgainst(Finding& finding, const std::map<std::string, double>& others, double share, double spread) {
    std::map<std::string, double> known;
    std::string without;
    for (const auto& [program, value] : others) {
        if (std::isfinite(value))
            known[program] = value;
        else
            without += fmt::format("{}{}", without.empty() ? "" : ", ", program);
    }
    if (!without.empty()) finding.remark += fmt::format("; without {}, whose curve does not have it", without);
    if (known.empty()) {
        notComparable(finding,
                      without.empty()
                          ? "the published curve is not public, and no other program has run these inputs"
                          : fmt::format("the published curve is not public, and that of {} does not have it", without));
        return;
    }
    finding.low = std::numeric_limits<double>::infinity();
    finding.high = -finding.low;
    finding.source.clear();
    for (const auto& [program, value] : known) {
        finding.low = std::min(finding.low, (1 - share) * value - spread);
        finding.high = std::max(finding.high, (1 + share) * value + spread);
        finding.source += fmt::format("{}{} {:.4g}", finding.source.empty() ? "" : ", ", program, value);
        if (finding.unit != "-") finding.source += " " + finding.unit;
    }
}

const char* wordOf(Verdict verdict) {
    switch (verdict) {
        case Verdict::Agrees:
            return "agrees";
        case Verdict::Undecided:
            return "undecided";
        case Verdict::Differs:
            return "differs";
        default:
            return "not comparable";
    }
}

}  // namespace vkdose::validate
