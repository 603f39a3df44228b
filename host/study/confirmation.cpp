#include "host/study/confirmation.h"

#include <algorithm>
#include <cmath>

#include "host/analysis/beta.h"

namespace vkdose {

Confirmed confirmedBy(const std::vector<double>& values, std::size_t asked, const SeedScatter& scatter, double target,
                      double tolerance) {
    using Verdict = Confirmed::Verdict;
    Confirmed c;
    const Estimate mean = estimateOf(values);
    c.runs = std::size_t(mean.count);
    c.found = {mean.mean, scatter.errorOfMean(mean.count)};
    if (c.runs < asked || c.runs == 0)
        c.verdict = Verdict::Incomplete;
    else if (!(std::abs(c.found.value - target) <= tolerance))
        c.verdict = Verdict::Missed;
    else
        c.verdict = c.found.error <= tolerance ? Verdict::Met : Verdict::Uncertain;
    return c;
}

bool Confirmation::met() const {
    return std::all_of(figures.begin(), figures.end(),
                       [](const Confirmed& c) { return c.verdict == Confirmed::Verdict::Met; });
}

std::string verdictText(Confirmed::Verdict verdict) {
    switch (verdict) {
        case Confirmed::Verdict::Met:
            return "met";
        case Confirmed::Verdict::Missed:
            return "missed";
        case Confirmed::Verdict::Uncertain:
            return "uncertain";
        default:
            return "incomplete";
    }
}

std::vector<std::uint64_t> newSeeds(const std::vector<std::uint64_t>& used, std::size_t count) {
    std::vector<std::uint64_t> seeds;
    for (std::uint64_t seed = 1; seeds.size() < count; ++seed)
        if (std::find(used.begin(), used.end(), seed) == used.end()) seeds.push_back(seed);
    return seeds;
}

}  // namespace vkdose
