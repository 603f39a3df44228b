#pragma once
// What a camera sees of the powder from far away, as the mean of many photographs.

#include <cstddef>
#include <optional>
#include <vector>

#include "host/model/particles.h"

namespace vkdose {

/// How many pixels the element tests' views have for a mean diameter.
inline constexpr double kPixelsOfDiameter = 10;

/// The mean of photographs that are taken along the z axis: of each pixel the share of the photographs in which it
/// shows powder. A pixel shows powder if its centre lies within the outline of any sphere that is neither dosed nor
/// lost, however far behind the glass it is: what hides a sphere is powder too. Perspective is left out.
class AveragedView {
  public:
    /// The columns of pixels fill |x| < `halfWidth` [m] exactly; a pixel is a square, about `pixel` [m] wide. There are
    /// rows as far up and down as there is powder.
    AveragedView(double halfWidth, double pixel);

    /// Takes one more photograph.
    void add(const Particles& particles);

    int photographs() const { return photographs_; }
    double pixel() const { return pixel_; }
    int columns() const { return static_cast<int>(columns_.size()); }
    /// Middle of a column [m].
    double x(int column) const { return -halfWidth_ + (column + 0.5) * pixel_; }

    /// The surface, of each column its height [m], from left to right; none where there is no bed. Powder is what shows
    /// powder in at least half of the photographs. Of its patches, whose pixels touch at a side or a corner, the
    /// largest is the bed, so that what lies alone does not count. The surface is where the share falls through one
    /// half above the bed's highest pixel of the column, between the centres of two pixels on a straight line.
    std::vector<std::optional<double>> surface() const;

  private:
    struct Pixel {
        int shown = 0;  ///< number of photographs in which it shows powder
        int last = 0;   ///< number of the last one of these, from 1
    };
    struct Column {
        int lowest = 0;  ///< row of its first pixel
        std::vector<Pixel> pixels;
    };
    struct Patch {
        std::size_t pixels = 0;
        std::vector<int> highest;  ///< row of its highest pixel in each column
    };

    void show(Column& column, int from, int to) const;
    int shown(int column, int row) const;
    bool powder(int column, int row) const { return photographs_ > 0 && 2 * shown(column, row) >= photographs_; }
    double middleOf(int row) const { return (row + 0.5) * pixel_; }
    /// The patch of powder with this pixel; marks its pixels as seen.
    Patch patchAt(int column, int row, std::vector<std::vector<char>>& seen) const;
    Patch bed() const;

    double halfWidth_ = 0, pixel_ = 1;
    int photographs_ = 0;
    std::vector<Column> columns_;
};

}  // namespace vkdose
