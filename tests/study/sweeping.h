#pragma once
// A sweep over runs that are made up, in a folder of its own.

#include <string>

#include "host/study/sweep.h"
#include "tests/study/made_up_runs.h"
#include "tests/study/study_files.h"

namespace vkdose::test {

inline const HaltRule kNoHalt = [] { return Halt::None; };

struct Sweeping {
    StudyFolder place;
    std::filesystem::path out = place.path() / "out";

    SweepOutcome run(MadeUpRuns& runs, const std::string& text = kGoodStudy, bool retry = false,
                     const HaltRule& halt = kNoHalt, SweepObserver* observer = nullptr) const {
        const Study study = place.study(text);
        const std::vector<Member> members = membersOf(study);
        SweepFolder folder(out, study, members);
        SweepObserver nobody;
        const SweepOutcome outcome = runMembers(folder, members, runs, observer ? *observer : nobody, halt, retry);
        if (outcome.whole) folder.sort();
        return outcome;
    }
    Table members() const { return Table::salvage(out / "members.csv"); }
    Table doses() const { return Table::salvage(out / "doses.csv"); }
};

}  // namespace vkdose::test
