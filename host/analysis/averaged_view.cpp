#include "host/analysis/averaged_view.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace vkdose {

namespace {

constexpr int kNoBed = std::numeric_limits<int>::min();

}  // namespace

AveragedView::AveragedView(double halfWidth, double pixel) : halfWidth_(halfWidth) {
    const double columns = std::max(1.0, std::round(2 * halfWidth / pixel));
    columns_.resize(static_cast<std::size_t>(columns));
    pixel_ = 2 * halfWidth / columns;
}

void AveragedView::show(Column& column, int from, int to) const {
    if (from > to) return;
    if (column.pixels.empty()) column.lowest = from;
    if (from < column.lowest) {
        column.pixels.insert(column.pixels.begin(), static_cast<std::size_t>(column.lowest - from), Pixel());
        column.lowest = from;
    }
    const auto rows = static_cast<std::size_t>(to - column.lowest) + 1;
    if (column.pixels.size() < rows) column.pixels.resize(rows);
    for (int row = from; row <= to; ++row) {
        Pixel& pixel = column.pixels[static_cast<std::size_t>(row - column.lowest)];
        if (pixel.last == photographs_) continue;  // another sphere shows there already
        pixel.last = photographs_;
        ++pixel.shown;
    }
}

void AveragedView::add(const Particles& particles) {
    ++photographs_;
    for (std::size_t i = 0; i < particles.size(); ++i) {
        if (particles.status[i] != Status::Active) continue;
        const Vec3& at = particles.position[i];
        const double r = particles.radius[i];
        const double first = std::max(0.0, std::ceil((at.x - r + halfWidth_) / pixel_ - 0.5));
        for (int c = static_cast<int>(std::min(first, double(columns()))); c < columns() && x(c) <= at.x + r; ++c) {
            const double half = std::sqrt(std::max(0.0, r * r - (x(c) - at.x) * (x(c) - at.x)));
            show(columns_[static_cast<std::size_t>(c)], static_cast<int>(std::ceil((at.y - half) / pixel_ - 0.5)),
                 static_cast<int>(std::floor((at.y + half) / pixel_ - 0.5)));
        }
    }
}

int AveragedView::shown(int column, int row) const {
    if (column < 0 || column >= columns()) return 0;
    const Column& c = columns_[static_cast<std::size_t>(column)];
    const int place = row - c.lowest;
    return place < 0 || place >= static_cast<int>(c.pixels.size()) ? 0
                                                                   : c.pixels[static_cast<std::size_t>(place)].shown;
}

AveragedView::Patch AveragedView::patchAt(int column, int row, std::vector<std::vector<char>>& seen) const {
    Patch patch{0, std::vector<int>(columns_.size(), kNoBed)};
    std::vector<std::pair<int, int>> open;
    const auto visit = [&](int c, int r) {
        if (!powder(c, r)) return;
        const auto place = static_cast<std::size_t>(c);
        char& known = seen[place][static_cast<std::size_t>(r - columns_[place].lowest)];
        if (known == 0) open.emplace_back(c, r);
        known = 1;
    };
    for (visit(column, row); !open.empty(); ++patch.pixels) {
        const auto [c, r] = open.back();
        open.pop_back();
        int& highest = patch.highest[static_cast<std::size_t>(c)];
        highest = std::max(highest, r);
        for (int beside = -1; beside <= 1; ++beside)
            for (int over = -1; over <= 1; ++over) visit(c + beside, r + over);
    }
    return patch;
}

AveragedView::Patch AveragedView::bed() const {
    std::vector<std::vector<char>> seen;
    for (const Column& c : columns_) seen.emplace_back(c.pixels.size(), char(0));
    Patch largest{0, std::vector<int>(columns_.size(), kNoBed)};
    for (std::size_t c = 0; c < columns_.size(); ++c) {
        for (std::size_t place = 0; place < columns_[c].pixels.size(); ++place) {
            const int row = columns_[c].lowest + static_cast<int>(place);
            if (seen[c][place] != 0 || !powder(static_cast<int>(c), row)) continue;
            Patch patch = patchAt(static_cast<int>(c), row, seen);
            if (patch.pixels > largest.pixels) largest = std::move(patch);
        }
    }
    return largest;
}

std::vector<std::optional<double>> AveragedView::surface() const {
    std::vector<std::optional<double>> heights;
    const std::vector<int> highest = bed().highest;
    for (int column = 0; column < columns(); ++column) {
        const int row = highest[static_cast<std::size_t>(column)];
        if (row == kNoBed) {
            heights.emplace_back();
            continue;
        }
        const double below = shown(column, row), above = shown(column, row + 1), half = photographs_ / 2.0;
        heights.emplace_back(middleOf(row) + pixel_ * (below - half) / (below - above));
    }
    return heights;
}

}  // namespace vkdose
