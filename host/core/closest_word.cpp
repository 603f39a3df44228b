#include "host/core/closest_word.h"

#include <algorithm>
#include <numeric>

namespace vkdose {
namespace {

/// Levenshtein distance: single-character insertions, deletions and substitutions.
std::size_t editDistance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t above = row[j];
            const std::size_t change = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
            row[j] = std::min({above + 1, row[j - 1] + 1, change});
            diagonal = above;
        }
    }
    return row[b.size()];
}

}  // namespace

std::string closestWord(std::string_view word, const std::vector<std::string>& known) {
    std::string best;
    std::size_t bestDistance = std::max<std::size_t>(2, word.size() / 3) + 1;
    for (const std::string& candidate : known) {
        const std::size_t distance = editDistance(word, candidate);
        if (distance < bestDistance) {
            best = candidate;
            bestDistance = distance;
        }
    }
    if (!best.empty()) return best;
    // Finds "radius_mm" for "radius" and "coil_speed" for "speed": a unit or a qualifier was left out or added.
    for (const std::string& candidate : known)
        if (word.size() >= 3 &&
            (candidate.find(word) != std::string::npos || word.find(candidate) != std::string::npos))
            return candidate;
    return "";
}

}  // namespace vkdose
