#include "host/photo/mean_picture.h"

#include <fmt/format.h>
#include <leptonica/allheaders.h>

namespace vkdose::photo {

void MeanPicture::add(const Picture& picture, const std::string& name) {
    if (count_ == 0) {
        width_ = picture.width();
        height_ = picture.height();
        first_ = name;
        sum_.assign(std::size_t(width_) * std::size_t(height_), 0);
    }
    if (picture.width() != width_ || picture.height() != height_)
        throw PhotoError(fmt::format("{} has {} x {} pixels, {} has {} x {}; give photographs of one size", name,
                                     picture.width(), picture.height(), first_, width_, height_));
    const Picture grey = held(pixConvertTo8(picture.pix(), 0));
    std::size_t i = 0;
    for (int y = 0; y < height_; ++y) {
        const l_uint32* line = pixGetData(grey.pix()) + std::ptrdiff_t(y) * pixGetWpl(grey.pix());
        for (int x = 0; x < width_; ++x) sum_[i++] += GET_DATA_BYTE(line, x);
    }
    ++count_;
}

Picture MeanPicture::mean() const {
    Grey grey(width_, height_);
    for (std::size_t i = 0; i < sum_.size(); ++i) grey.value[i] = std::uint8_t((sum_[i] + count_ / 2) / count_);
    return pictureOf(grey);
}

}  // namespace vkdose::photo
