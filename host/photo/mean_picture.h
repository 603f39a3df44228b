#pragma once
// The mean of several photographs of one scene.

#include <cstdint>
#include <string>
#include <vector>

#include "host/photo/photograph.h"

namespace vkdose::photo {

/// Takes photographs one after another, so that only one of them is in memory.
class MeanPicture {
  public:
    /// Throws PhotoError, which names the picture, if it is not as large as the first.
    void add(const Picture& picture, const std::string& name);

    /// Of each pixel the mean grey, rounded. At least one picture must have been taken; a single one stays as it is, in
    /// grey.
    Picture mean() const;

  private:
    int width_ = 0, height_ = 0;
    std::string first_;
    std::uint32_t count_ = 0;
    std::vector<std::uint32_t> sum_;
};

}  // namespace vkdose::photo
