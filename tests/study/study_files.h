#pragma once
// A small study in a folder of its own; the tests break one thing of it at a time.

#include <filesystem>
#include <string>

#include "host/core/error.h"
#include "host/study/member.h"
#include "tests/model/case_files.h"

namespace vkdose::test {

inline const std::string kGoodStudy = R"(name = "cohesion and friction"
reason = "a test"
base = "good.toml"
seeds = [4, 9]
[set]
"stop.max_doses" = 2
dose.rotate_s = 0.2
[[axis]]
key = "contact.kc_over_k"
values = [0.2, 0.50]
[[axis]]
keys = ["coil.turns", "coil.speed_rpm"]
values = [[3, 120], [2, 60], [4, 60.5]]
)";

/// A folder with the good case as good.toml, in which studies are read.
class StudyFolder : public Folder {
  public:
    StudyFolder() { write("good.toml", kGoodCase); }
    Study study(const std::string& text = kGoodStudy) const { return readStudy(write("study.toml", text)); }
    std::vector<Member> members(const std::string& text = kGoodStudy) const { return membersOf(study(text)); }
};

/// The faults of a study, its members included.
inline std::vector<Diagnostic> faultsOf(const StudyFolder& folder, const std::string& text) {
    try {
        (void)folder.members(text);
    } catch (const CaseError& error) {
        return error.faults();
    }
    return {};
}

}  // namespace vkdose::test
