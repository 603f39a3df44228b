#pragma once
// The folder that a workbench works in. Nothing outside of it is written, and of what lies outside only the cases that
// come with the program are read.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace vkdose::studio {

/// The command that plays a study with this text: "sweep", "calibrate" or "design". Null for a text that is none.
const char* commandOfStudy(const std::string& text);

class Workspace {
  public:
    /// Throws RunError if there is no such folder.
    explicit Workspace(const std::filesystem::path& folder);

    const std::filesystem::path& folder() const { return folder_; }

    /// The file or folder of this name below the folder, which need not be there. Nothing for a name that is absolute,
    /// that leads outside by a link, or that has a part which begins with a dot, a backslash or a control character.
    std::optional<std::filesystem::path> inside(const std::string& name) const;

    /// Files of cases and studies, output folders of runs and studies.
    enum class Kind { Case, Study, Run, Sweep };
    struct Entry {
        std::string name;  ///< relative to the folder, with slashes
        Kind kind = Kind::Case;
    };
    /// What there is below the folder, by its names: at most kMost of it, no deeper than kDepth, nothing in a hidden
    /// folder and nothing within a run or a study.
    std::vector<Entry> entries() const;
    static constexpr std::size_t kMost = 2000;
    static constexpr int kDepth = 4;

  private:
    std::filesystem::path folder_;
};

}  // namespace vkdose::studio
