#pragma once
// The folder of a sweep. It holds study.toml and base.toml for the record, members.csv and doses.csv, which grow as
// members end, and the members' own run folders. A sweep that was interrupted for any reason goes on in it.

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "host/core/folder_lock.h"
#include "host/output/csv.h"
#include "host/study/member.h"
#include "host/study/member_result.h"

namespace vkdose {

class SweepFolder {
  public:
    enum class Manner {
        Whole,  ///< its members are known from the beginning
        Open    ///< its members are decided on as it goes: those of a search, and confirming runs
    };

    /// Creates the folder, or goes on in it. Going on, it cuts out of the tables rows that were torn, doses of members
    /// without a row, and the rows of interrupted members, who are yet to end. It takes doses from the folders of their
    /// members, even if the table has lost some or holds others. Throws FolderError if another process is writing into
    /// the folder, if it holds something else, if a file of the study is among those to be replaced, or if a member
    /// that has begun in it is another case in `members`. Throws OutputError if it cannot be written; everything made
    /// until then is removed again.
    SweepFolder(std::filesystem::path folder, const Study& study, const std::vector<Member>& members,
                Manner manner = Manner::Whole);

    /// Throws FolderError if the folder of this study holds something else, as the constructor would.
    static void requireUsable(const std::filesystem::path& folder, const Study& study);

    /// The files of a sweep that are in a folder, without those of its members' folders.
    static std::vector<std::filesystem::path> files(const std::filesystem::path& folder);

    const std::filesystem::path& path() const { return folder_; }
    std::filesystem::path memberFolder(int number) const;

    /// How a member ended, if it has.
    std::optional<MemberStatus> status(int number) const;

    /// The rows so far, in the order in which the members ended.
    const Table& members() const { return members_; }

    /// Whether this member has not begun in the folder as another case.
    bool isSame(const Member& member) const;
    /// Throws FolderError if it has.
    void requireSame(const Member& member) const;

    /// Puts study.toml and base.toml back as they were before this object: a search has found that it is another one.
    void keepFormerStudy() const;

    /// Makes the member's folder, with its case. Throws OutputError if it cannot.
    void begin(const Member& member) const;

    /// Takes the row and the doses of a member out of the tables, so that it can end anew.
    void forget(int number);

    /// Notes how a member ended. Throws OutputError if it cannot be written.
    void add(const Member& member, const MemberResult& result);

    /// Puts the tables into the order of the members.
    void sort();

  private:
    std::string anotherIn(const Member& member) const;
    void lock();
    void read(const Row& keys);
    void gatherResults();
    void rewrite();

    std::filesystem::path folder_;
    std::string study_;                                    ///< its file, for messages
    bool open_ = false;                                    ///< Manner::Open
    std::optional<std::string> formerStudy_, formerBase_;  ///< study.toml and base.toml that were there
    std::optional<FolderLock> lock_;
    Table members_;
    Table doses_;
    std::map<int, MemberStatus> status_;
    std::optional<CsvFile> membersFile_;
    std::optional<CsvFile> dosesFile_;
};

}  // namespace vkdose
