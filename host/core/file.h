#pragma once
// Reads whole files, replaces them in one move, and makes the folders they are in. Every path that a user gives is
// opened by one of these functions, so that the program never waits for a pipe and never replaces a device or a link by
// a file.

#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace vkdose {

/// Opens a file to read. Only a regular file is opened: a folder cannot be read, and a pipe or a device may have no
/// end. For anything else the stream is in the failed state.
std::ifstream inputFile(const std::filesystem::path& file);

/// Why `inputFile` does not open a file: "there is no such file", "cannot be read: it is a pipe, not a file", ...
std::string readFault(const std::filesystem::path& file);
/// The same with its name: "there is no file NAME", ...
std::string unreadable(const std::filesystem::path& file);

/// The bytes of a file; nothing if `inputFile` does not open it.
std::optional<std::string> fileContent(const std::filesystem::path& file);

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
