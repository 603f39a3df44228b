#pragma once
// Reads whole files, replaces them in one move, and makes the folders they are in. Every path that a user gives is
// opened by one of these functions, so that the program never waits for a pipe and never replaces a device or a link by
// a file.

#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace vkdose {

/// A file or a folder that is there cannot be read. The text names it, the place and what the system says.
class ReadError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// A file that is read from its beginning. No other place of the program opens a file to read.
class InputFile {
  public:
    /// Opens a regular file: a folder cannot be read, and a pipe or a device may have no end. Returns nothing if there
    /// is no file, or something else in its place. Throws ReadError if the system refuses to look at it or to open it.
    static std::optional<InputFile> open(const std::filesystem::path& file);

    /// Reads the next bytes into `to`; fewer than `most` only where the file ends. Throws ReadError.
    std::size_t read(char* to, std::size_t most);
    /// Goes to the last `most` bytes. Throws ReadError.
    void skipToLast(std::uint64_t most);
    /// Everything from here to the end, but no more than `most` bytes. Throws ReadError.
    std::string rest(std::uint64_t most = std::numeric_limits<std::uint64_t>::max());

    InputFile(const InputFile&) = delete;
    InputFile& operator=(const InputFile&) = delete;
    InputFile(InputFile&& other) noexcept;
    InputFile& operator=(InputFile&& other) noexcept;
    ~InputFile();

  private:
    InputFile(std::filesystem::path file, int handle) : file_(std::move(file)), handle_(handle) {}
    std::uint64_t size() const;
    [[noreturn]] void fail() const;

    std::filesystem::path file_;
    int handle_;
    std::uint64_t at_ = 0;  ///< bytes before the next one
};

/// Why `InputFile` does not open what is there: "there is no such file", "cannot be read: it is a pipe, not a file".
std::string readFault(const std::filesystem::path& file);
/// The same with its name: "there is no file NAME", ...
std::string unreadable(const std::filesystem::path& file);

/// The bytes of a file, if it is there and a file. Throws ReadError if it cannot be read to its end.
std::optional<std::string> fileContent(const std::filesystem::path& file);
/// The same of its first bytes, at most `most`, and of its last ones.
std::optional<std::string> fileStart(const std::filesystem::path& file, std::uint64_t most);
std::optional<std::string> fileEnd(const std::filesystem::path& file, std::uint64_t most);

/// What a folder holds, in no order. Absent without the folder. Throws ReadError if it cannot be listed.
std::vector<std::filesystem::path> entriesOf(const std::filesystem::path& folder);

/// Opens a file to write, with the flags of open(2). It never waits: a pipe that no one reads is refused. A disk is
/// refused too. Throws OutputError.
int openOutput(const std::filesystem::path& file, int flags);

/// Replaces `file` by `content` in one move: whatever happens, the file holds either the whole old content or the whole
/// new content. If `file` is a link, the file that it leads to is replaced. A pipe or a device is written into. Throws
/// OutputError if the content cannot be written; the old content is then still there.
void replaceFile(const std::filesystem::path& file, std::string_view content);

/// Throws OutputError if a pipe, a device or a folder stands where a program is to write a file.
void requireReplaceable(const std::filesystem::path& file);

/// The first of `written` that is the same file as one of `read`, even if under another name.
std::optional<std::filesystem::path> readAndWritten(const std::vector<std::filesystem::path>& read,
                                                    const std::vector<std::filesystem::path>& written);

/// Makes a folder and its parents where they are missing. Throws OutputError if that fails.
void createFolder(const std::filesystem::path& folder);

/// Removes a folder if it is empty. Anything else stays: a folder with something in it, and a file that somebody has
/// put in its place. Says nothing of it, as it is for tidying up.
void removeEmptyFolder(const std::filesystem::path& folder);

/// "cannot write FILE: No space left on device; make room", from errno.
std::string writeFault(const std::filesystem::path& file);

}  // namespace vkdose
