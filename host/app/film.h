#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <vector>

namespace vkdose {

/// A film that the program ffmpeg encodes. ffmpeg gets one picture after the other through a pipe.
class Film {
  public:
    /// Begins a film of pictures with even width and height [pixels], each shown for 1/rate seconds. An existing file
    /// is replaced. Throws UsageError if ffmpeg is not installed.
    Film(std::filesystem::path file, int width, int height, double rate);
    /// Gives the film up if it has not been finished.
    ~Film();
    Film(const Film&) = delete;
    Film& operator=(const Film&) = delete;

    /// Adds a picture: rows from the top, each pixel blue, green, red and an unused byte. Throws OutputError, with the
    /// message of ffmpeg, if ffmpeg does not take the picture.
    void add(const std::vector<std::uint8_t>& picture);

    /// Throws OutputError, with the message of ffmpeg, if ffmpeg could not make the film.
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
