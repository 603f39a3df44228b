#pragma once
// A file that is being written, and the calls of the system that a signal may interrupt.

#include <cerrno>
#include <filesystem>
#include <string_view>

namespace vkdose {

/// Calls again what a signal has interrupted. A close is not called again: Linux has closed the file by then.
template <class Call>
auto retried(Call call) {
    auto result = call();
    while (result < 0 && errno == EINTR) result = call();
    return result;
}

/// Writes all of `content`, in as many pieces as the system takes. Returns false, with errno set, if that fails.
bool writeAll(int handle, std::string_view content);

/// Makes a file or a folder survive a crash of the machine. A file system that knows no such thing (some network and
/// FUSE ones answer EINVAL) counts as good. Returns false, with errno set, if it fails.
bool syncAll(int handle);

/// Closes it. Returns false, with errno set, if what was written is lost.
bool closeAll(int handle);

/// An open file to write, with its name for messages. It is closed at the end, without a look at how that goes.
class OutputFile {
  public:
    /// `flags` are those of open(2), as openOutput takes them. Throws OutputError.
    OutputFile(std::filesystem::path file, int flags);

    /// Each throws OutputError.
    void write(std::string_view content);
    void sync();
    void cutAt(std::uint64_t size);
    void goTo(std::uint64_t place);

    /// Whether it is still the file of that name.
    bool isWhereItWas() const;

    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;
    OutputFile(OutputFile&& other) noexcept;
    OutputFile& operator=(OutputFile&& other) noexcept;
    ~OutputFile();

  private:
    [[noreturn]] void fail() const;

    std::filesystem::path file_;
    int handle_;
};

}  // namespace vkdose
