#include "host/validate/finding.h"

#include <fmt/format.h>

#include <algorithm>

namespace vkdose::validate {

Verdict Finding::verdict() const {
    if (!comparable) return Verdict::NotComparable;
    if (got >= low && got <= high) return Verdict::Agrees;
    const double outside = got < low ? low - got : got - high;
    return outside <= 2 * error ? Verdict::Undecided : Verdict::Differs;
}

void holdAgainst(Finding& finding, const std::map<std::string, double>& others, double share, double spread) {
    if (others.empty()) {
        finding.comparable = false;
        finding.remark = "the published curve is not public, and no other program has run these inputs";
        return;
    }
    finding.low = std::numeric_limits<double>::infinity();
    finding.high = -finding.low;
    finding.source.clear();
    for (const auto& [program, value] : others) {
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
