#pragma once
// The studies that `vkdose new` writes over a case: commented, and ready to run.

#include <array>
#include <filesystem>

namespace vkdose {

struct StudyTemplate {
    const char* command;  ///< that runs it; also the option, without its dashes
    const char* about;
};

inline constexpr std::array<StudyTemplate, 3> kStudyTemplates{{
    {"sweep", "a study that runs this case with other values of a key"},
    {"calibrate", "a study that looks for the powder of this case by a dose that was weighed"},
    {"design", "a study that looks for the device of this case by what is wished of its doses"},
}};

/// Writes a study over the case `base` to a file that is not there yet. Throws UsageError if it is there, and CaseError
/// if the case cannot be read.
void writeStudy(const StudyTemplate& study, const std::filesystem::path& base, const std::filesystem::path& file);

}  // namespace vkdose
