#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <vector>

namespace vkdose {

/// A film being encoded by the program ffmpeg, which gets one picture after the other through a pipe.
class Film {
  public:
    /// Of pictures of even width and height [pixels], each shown for 1/rate seconds. What is in the file is replaced.
    /// Throws UsageError if ffmpeg is not installed.
    Film(std::filesystem::path file, int width, int height, double rate);
    /// Gives the film up if it has not been finished.
    ~Film();
    Film(const Film&) = delete;
    Film& operator=(const Film&) = delete;

    /// Rows from the top, each pixel blue, green, red and a byte of no meaning. Throws OutputError, with what ffmpeg
    /// says, if it does not take the picture.
    void add(const std::vector<std::uint8_t>& picture);

    /// Throws OutputError, with what ffmpeg says, if the film has not come about.
    void finish();

  private:
    [[noreturn]] void fail();
    int close();

    std::filesystem::path file_;
    pid_t process_ = -1;
    int pictures_ = -1;  ///< end of the pipe
    int said_ = -1;      ///< a file without a name for what goes wrong
};

}  // namespace vkdose
