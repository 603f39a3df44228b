#pragma once
// Files as a whole: read, replaced in one move; and the folders they are in.

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace vkdose {

/// The bytes of a file; nothing if it is not there, is a folder or may not be read.
std::optional<std::string> fileContent(const std::filesystem::path& file);

/// Replaces `file` by `content` in one move: whatever happens, the file holds either the old or the new content, whole.
/// Throws OutputError if it cannot be written; the old content is then still there.
void replaceFile(const std::filesystem::path& file, std::string_view content);

/// Makes a folder, and those it is in, unless they are there. Throws OutputError if that fails.
void createFolder(const std::filesystem::path& folder);

/// "cannot write FILE: No space left on device", from errno.
std::string writeFault(const std::filesystem::path& file);

}  // namespace vkdose
