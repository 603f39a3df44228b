#pragma once
// Leaves out entries where a page cannot hold all.

#include <cstddef>
#include <vector>

namespace vkdose::report {

/// Every n-th entry and the last.
template <typename Entry>
std::vector<Entry> thinned(const std::vector<Entry>& all, std::size_t stride) {
    std::vector<Entry> few;
    for (std::size_t i = 0; i < all.size(); i += stride) few.push_back(all[i]);
    if (!all.empty() && (all.size() - 1) % stride != 0) few.push_back(all.back());
    return few;
}

}  // namespace vkdose::report
