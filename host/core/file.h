#pragma once
// Files as a whole: read, replaced in one move; and the folders they are in. Every path that a user gives is opened by
// one of these, so that no pipe is waited for and no device or link is replaced by a file.

#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace vkdose {

/// Opens a file to read. What is no regular file (a folder, a pipe, a device) may have no end and is not opened: the
/// stream has then failed.
std::ifstream inputFile(const std::filesystem::path& file);

/// Why `inputFile` does not open a file: "there is no such file", "cannot be read: it is a pipe, not a file", ...
std::string readFault(const std::filesystem::path& file);
/// The same with its name: "there is no file NAME", ...
std::string unreadable(const std::filesystem::path& file);

/// The bytes of a file; nothing if `inputFile` does not open it.
std::optional<std::string> fileContent(const std::filesystem::path& file);

/// Opens a file to write, by the flags of open(2). Waits for nobody: a pipe that no one reads is refused, and so is a
/// disk. Throws OutputError.
int openOutput(const std::filesystem::path& file, int flags);

/// Replaces `file` by `content` in one move: whatever happens, the file holds either the old or the new content, whole.
/// Of a link the file it leads to is replaced; a pipe or a device is written into. Throws OutputError if it cannot be
/// written; the old content is then still there.
void replaceFile(const std::filesystem::path& file, std::string_view content);

/// Throws OutputError if a pipe, a device or a folder stands where a program is to write a file.
void requireReplaceable(const std::filesystem::path& file);

/// The first of `written` that is, by whatever name, one of the files `read`.
std::optional<std::filesystem::path> readAndWritten(const std::vector<std::filesystem::path>& read,
                                                    const std::vector<std::filesystem::path>& written);

/// Makes a folder, and those it is in, unless they are there. Throws OutputError if that fails.
void createFolder(const std::filesystem::path& folder);

/// "cannot write FILE: No space left on device; make room", from errno.
std::string writeFault(const std::filesystem::path& file);

}  // namespace vkdose
