#pragma once
// A straight line through points by least squares.

#include <cmath>
#include <limits>

namespace vkdose {

/// Takes points (x, y) one after another. The sums are taken about the first point, so that no digits are lost.
class LineFit {
  public:
    void add(double x, double y) {
        if (count_ == 0) {
            x0_ = x;
            y0_ = y;
        }
        x -= x0_;
        y -= y0_;
        ++count_;
        x_ += x;
        y_ += y;
        xx_ += x * x;
        xy_ += x * y;
    }

    int count() const { return count_; }
    /// dy/dx; NaN if the points have fewer than two different x.
    double slope() const {
        const double spread = xx_ - x_ * x_ / count_;
        if (count_ < 2 || !(spread > 1e-12 * xx_)) return std::numeric_limits<double>::quiet_NaN();
        return (xy_ - x_ * y_ / count_) / spread;
    }
    /// y at this x; NaN likewise.
    double at(double x) const { return y0_ + y_ / count_ + slope() * (x - x0_ - x_ / count_); }

  private:
    int count_ = 0;
    double x0_ = 0, y0_ = 0, x_ = 0, y_ = 0, xx_ = 0, xy_ = 0;
};

}  // namespace vkdose
