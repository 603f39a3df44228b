#pragma once
// The folder that a workbench works in. Nothing outside of it is written, and of what lies outside only the cases that
// come with the program are read.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace vkdose::studio {

class Workspace {
  public:
    /// Throws RunError if there is no such folder.
    explicit Workspace(const std::filesystem::path& folder);

    const std::filesystem::path& folder() const { return folder_; }

    /// The file or folder of this name below the folder, which need not be there. Nothing for a name that is absolute,
    /// that leads outside by a link, or that has a part which begins with a dot, a backslash or a control character.
    std::optional<std::filesystem::path> inside(const std::string& name) const;

    struct Entry {
        std::string name;  ///< relative to the folder, with slashes
        bool run = false;  ///< an output folder of a run; else a case file
    };
    /// Cases and runs below the folder, by their names: at most kMost of them, no deeper than kDepth, none in a hidden
    /// folder.
    std::vector<Entry> entries() const;
    static constexpr std::size_t kMost = 2000;
    static constexpr int kDepth = 4;

  private:
    std::filesystem::path folder_;
};

}  // namespace vkdose::studio
