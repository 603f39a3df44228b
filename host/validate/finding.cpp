#include "host/validate/finding.h"

#include <cmath>

namespace vkdose::validate {

Verdict Finding::verdict() const {
    if (!comparable) return Verdict::NotComparable;
    if (got >= low && got <= high) return Verdict::Agrees;
    const double outside = got < low ? low - got : got - high;
    return outside <= 2 * error ? Verdict::Undecided : Verdict::Differs;
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
