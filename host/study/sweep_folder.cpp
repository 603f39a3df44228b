#include "host/study/sweep_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>
#include <tuple>
#include <utility>

#include "host/core/error.h"
#include "host/core/file.h"
#include "host/core/number.h"
#include "host/model/case.h"
#include "host/output/checkpoint.h"
#include "host/output/run_folder.h"
#include "host/sim/dose.h"
#include "host/study/calibration_file.h"
#include "host/study/design_finding.h"
#include "host/study/figures_table.h"
#include "host/study/prediction.h"
#include "host/study/scale_study.h"

namespace vkdose {

namespace fs = std::filesystem;

namespace {

constexpr const char* kAppendable =
    "what can be added to a sweep are seeds at the end and, with a single seed, values at the end of the first axis";
constexpr const char* kSearchGoesOn = "a search goes on with the same case, seeds, parameters and targets";

Row joined(Row a, const Row& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

Row head(const Member& m) {
    return joined({fmt::format("{}", m.number), fmt::format("{}", m.seed)}, m.values);
}

int memberOf(const Row& row) {
    const auto number = row.empty() ? std::nullopt : wholeNumberOf(row[0]);
    return number && *number < kMostMembers ? int(*number) : -1;
}

std::string content(const Table& table) {
    std::string text = csvLine(table.names()) + "\n";
    for (std::size_t i = 0; i < table.rows(); ++i) text += csvLine(table.row(i)) + "\n";
    return text;
}

void dropRows(Table& table, const std::set<int>& kept) {
    table.removeIf([&](const Row& row) { return !kept.contains(memberOf(row)); });
}

[[noreturn]] void changed(const fs::path& study, const fs::path& folder, const std::string& how) {
    throw FolderError(fmt::format("{} has changed since {} was begun: {}; give another folder with --out",
                                  study.string(), folder.string(), how));
}

/// The first column of `wanted` that a table has not; empty if it has all.
std::string lacking(const Row& wanted, const Row& has) {
    const auto there = [&has](const std::string& name) { return std::find(has.begin(), has.end(), name) != has.end(); };
    const auto missing = std::find_if_not(wanted.begin(), wanted.end(), there);
    return missing == wanted.end() ? "" : fmt::format(": it has no column {}", *missing);
}

/// The case as vkdose writes it, so that a remark or another order of its keys does not make it another one.
std::string today(const fs::path& file) {
    try {
        return loadResolvedCase(fileContent(file).value_or(""), file).resolved;
    } catch (const CaseError&) {
        return "";
    }
}

/// Its reason says why somebody runs a case. Another one does not make it another case.
std::string withoutReason(const std::string& resolved) {
    const std::size_t line = resolved.find("\nreason = ");
    if (line == std::string::npos) return resolved;
    return resolved.substr(0, line) + resolved.substr(resolved.find('\n', line + 1));
}

/// Whether a sweep has begun in the folder. The sign is its table. If that was lost, the sign is members beside the
/// base of this very study, but no other study and nothing that a sweep leaves at its end: without the table such a
/// file, which would be replaced, may be the user's own.
bool isSweep(const fs::path& folder, const Study& study, const Case& base) {
    if (Table::salvage(folder / "members.csv").has("member")) return true;
    if (fs::exists(folder / "study.toml") && fileContent(folder / "study.toml") != study.text) return false;
    constexpr std::array<const char*, 4> kFromTheStart{"study.toml", "base.toml", "doses.csv", "members.csv"};
    for (const fs::path& file : SweepFolder::files(folder))
        if (std::find(kFromTheStart.begin(), kFromTheStart.end(), file.filename()) == kFromTheStart.end()) return false;
    const fs::path file = folder / "base.toml";
    return fs::is_directory(folder / "members") && (fileContent(file) == base.resolved || today(file) == base.resolved);
}

/// Whether the folder holds nothing but halves of files. A sweep that was killed in its first moment leaves them.
bool holdsNothing(const fs::path& folder) {
    const std::vector<fs::path> entries = entriesOf(folder);
    return std::all_of(entries.begin(), entries.end(), [](const fs::path& e) { return e.extension() == ".new"; });
}

/// Refuses a folder that holds something else than a sweep over this base.
void refuseOther(const fs::path& folder, const Study& study, const Case& base) {
    std::error_code error;
    if (fs::exists(folder, error) && !fs::is_directory(folder, error))
        throw FolderError(fmt::format("{} is a file, not a folder; choose another with --out", folder.string()));
    if (!isSweep(folder, study, base) && !holdsNothing(folder))
        throw FolderError(
            fmt::format("{} holds something else than a sweep; choose another folder with --out", folder.string()));
}

/// Refuses to replace a file that the study is read from, unless the content stays the same.
void requireNothingLost(const fs::path& folder, const Study& study, const Case& base) {
    std::vector<fs::path> read = base.files, written = SweepFolder::files(folder);
    read.push_back(study.file);
    if (study.calibration) {
        read.push_back(study.calibration->measured);
        for (const fs::path& other : study.calibration->bases()) read.push_back(other);
    }
    if (fileContent(folder / "study.toml") == study.text) std::erase(written, folder / "study.toml");
    if (fileContent(folder / "base.toml") == base.resolved) std::erase(written, folder / "base.toml");
    if (const auto file = readAndWritten(read, written))
        throw FolderError(
            fmt::format("the study is read from {}, which the sweep would replace; choose another folder "
                        "with --out",
                        file->string()));
}

}  // namespace

SweepFolder::SweepFolder(fs::path folder, const Study& study, const std::vector<Member>& members, Manner manner)
    : folder_(std::move(folder)), study_(study.file.string()), open_(manner == Manner::Open) {
    std::error_code error;
    const Case base = loadCase(study.base);
    refuseOther(folder_, study, base);
    const bool former = isSweep(folder_, study, base);
    const bool made = fs::create_directories(folder_, error);
    if (error) throw FolderError(fmt::format("cannot create {}: {}", folder_.string(), error.message()));
    lock();
    read(study.keys());
    // What decides on its members as it goes gives the first ones here, and calls requireSame when it comes to others.
    for (std::size_t i = 0; i < members_.rows(); ++i)
        if (!open_ && std::size_t(memberOf(members_.row(i))) >= members.size())
            changed(
                study_, folder_,
                fmt::format("member {} of members.csv is no longer in it; {}", memberOf(members_.row(i)), kAppendable));
    for (const Member& m : members) requireSame(m);
    std::set<int> ended;
    for (const auto& [number, status] : status_)
        if (status != MemberStatus::Interrupted) ended.insert(number);
    std::erase_if(status_, [](const auto& entry) { return entry.second == MemberStatus::Interrupted; });
    dropRows(members_, ended);
    gatherResults();
    requireNothingLost(folder_, study, base);
    try {
        formerStudy_ = fileContent(folder_ / "study.toml");
        formerBase_ = fileContent(folder_ / "base.toml");
        rewrite();  // the tables come first, because they tell that a sweep is here
        replaceFile(folder_ / "study.toml", study.text);
        replaceFile(folder_ / "base.toml", base.resolved);
    } catch (const OutputError&) {
        for (const fs::path& file : former ? std::vector<fs::path>() : files(folder_)) fs::remove(file, error);
        if (made) removeEmptyFolder(folder_);
        throw;
    }
}

std::vector<fs::path> SweepFolder::files(const fs::path& folder) {
    std::vector<fs::path> files;
    for (const char* name : {"study.toml", "base.toml", "doses.csv", kFindingName, kDrawsName, kPredictionName,
                             kScaleName, kFiguresName, "calibrated.toml", "members.csv"})
        if (fs::exists(folder / name)) files.push_back(folder / name);
    for (const fs::path& file : designFiles(folder))
        if (fs::exists(file)) files.push_back(file);
    return files;
}

void SweepFolder::lock() {
    lock_ = FolderLock::take(folder_);
    if (!lock_)
        throw FolderError(fmt::format("another vkdose is sweeping in {}; wait for it or stop it", folder_.string()));
}

void SweepFolder::read(const Row& keys) {
    members_ = Table::salvage(folder_ / "members.csv");
    doses_ = Table::salvage(folder_ / "doses.csv");
    const Row membersHeader = joined(joined({"member", "seed"}, keys), kOutputColumns);
    const Row dosesHeader = joined(joined({"member", "seed"}, keys), columnNames(kDoseColumns));
    for (const auto& [name, table, header] :
         {std::tuple("members.csv", &members_, &membersHeader), std::tuple("doses.csv", &doses_, &dosesHeader)})
        if (!table->names().empty() && table->names() != *header)
            changed(study_, folder_,
                    fmt::format("it varies other keys than the columns of {} say, or that file was edited{}", name,
                                lacking(*header, table->names())));
    if (members_.names().empty()) members_ = Table(membersHeader);
    if (doses_.names().empty()) doses_ = Table(dosesHeader);
    for (std::size_t i = 0; i < members_.rows(); ++i)
        for (const MemberStatus s : {MemberStatus::Ok, MemberStatus::Failed, MemberStatus::Interrupted})
            if (members_.text(i, "status") == statusText(s)) status_[memberOf(members_.row(i))] = s;
}

/// Takes results and doses of the members that have ended from their folders, because the tables may have lost some, or
/// been edited.
void SweepFolder::gatherResults() {
    std::map<int, std::vector<Row>> noted;
    for (std::size_t k = 0; k < doses_.rows(); ++k) {
        std::vector<Row>& rows = noted[memberOf(doses_.row(k))];
        if (rows.empty() || rows.back() != doses_.row(k)) rows.push_back(doses_.row(k));  // two equal lines: one dose
    }
    std::map<int, std::size_t> last;  // a member that stands there twice is one, with the status of its last row
    for (std::size_t i = 0; i < members_.rows(); ++i) last[memberOf(members_.row(i))] = i;
    Table members(members_.names()), doses(doses_.names());
    for (std::size_t i = 0; i < members_.rows(); ++i) {
        Row member = members_.row(i);
        const int number = memberOf(member);
        if (last[number] != i) continue;
        const MemberResult found = readResult(memberFolder(number), {number, 0, ""});
        const auto outputs = member.end() - std::ptrdiff_t(kOutputColumns.size());
        const Row head(member.begin(), outputs);
        const std::vector<Row>& table = noted[number];
        const bool lost = found.doses.size() < table.size();  // the folder itself has lost some, or is gone
        // Somebody may have let a failed member go on by himself, to its end. In a search later points may follow from
        // its failure.
        const bool failed = !open_ && status(number) == MemberStatus::Failed;
        const bool finished = failed && isOver(memberFolder(number));
        const bool ok = status(number) == MemberStatus::Ok || finished;
        if (!lost && ok && found.status == MemberStatus::Ok) {
            status_[number] = MemberStatus::Ok;
            for (std::size_t k = 0; k < found.outputs.size(); ++k)
                if (found.told[k]) outputs[std::ptrdiff_t(k)] = found.outputs[k];
        }
        members.add(member);
        if (lost) {
            for (const Row& row : table) doses.add(row);
            continue;
        }
        for (const Row& dose : found.doses) doses.add(joined(head, dose));
    }
    members_ = std::move(members);
    doses_ = std::move(doses);
}

void SweepFolder::requireUsable(const fs::path& folder, const Study& study) {
    refuseOther(folder, study, loadCase(study.base));
}

/// What the member was when it began in the folder as another case; empty if it did not.
std::string SweepFolder::anotherIn(const Member& member) const {
    const Row now = head(member);
    for (std::size_t i = 0; i < members_.rows(); ++i) {
        const Row& row = members_.row(i);
        if (memberOf(row) == member.number && !std::equal(now.begin(), now.end(), row.begin()))
            return "another point in members.csv";
    }
    const fs::path file = memberFolder(member.number) / "case.toml";
    if (fs::exists(file) && fileContent(file).value_or("") != member.caseText &&
        withoutReason(today(file)) != withoutReason(member.caseText))
        return fmt::format("another case ({})", file.string());
    return "";
}

bool SweepFolder::isSame(const Member& member) const {
    return anotherIn(member).empty();
}

void SweepFolder::requireSame(const Member& member) const {
    const std::string other = anotherIn(member);
    if (!other.empty())
        changed(study_, folder_,
                fmt::format("member {} was {}; {}", member.number, other, open_ ? kSearchGoesOn : kAppendable));
}

void SweepFolder::keepFormerStudy() const {
    if (formerStudy_) replaceFile(folder_ / "study.toml", *formerStudy_);
    if (formerBase_) replaceFile(folder_ / "base.toml", *formerBase_);
}

void SweepFolder::rewrite() {
    for (const auto& [table, name] : {std::pair{&members_, "members.csv"}, std::pair{&doses_, "doses.csv"}})
        replaceFile(folder_ / name, content(*table));
    membersFile_.emplace(folder_ / "members.csv", CsvMark{fs::file_size(folder_ / "members.csv")});
    dosesFile_.emplace(folder_ / "doses.csv", CsvMark{fs::file_size(folder_ / "doses.csv")});
}

fs::path SweepFolder::memberFolder(int number) const {
    return folder_ / "members" / fmt::format("{:04}", number);
}

std::optional<MemberStatus> SweepFolder::status(int number) const {
    const auto found = status_.find(number);
    if (found == status_.end()) return std::nullopt;
    return found->second;
}

void SweepFolder::begin(const Member& member) const {
    const fs::path folder = memberFolder(member.number);
    createFolder(folder);
    // A case.toml in other words says the same (requireSame). A run that has begun with it goes on with it.
    const fs::path file = folder / "case.toml";
    if (fs::exists(folder / kCheckpointName) ? !fs::exists(file) : fileContent(file) != member.caseText)
        replaceFile(file, member.caseText);
}

void SweepFolder::forget(int number) {
    for (Table* table : {&members_, &doses_}) table->removeIf([&](const Row& row) { return memberOf(row) == number; });
    status_.erase(number);
    rewrite();
}

void SweepFolder::add(const Member& member, const MemberResult& result) {
    // The doses come first. If the row is missing, its doses are cut out when the sweep goes on.
    for (const Row& dose : result.doses) {
        const Row row = joined(head(member), dose);
        dosesFile_->line(csvLine(row));
        doses_.add(row);
    }
    dosesFile_->store();
    const Row row = joined(head(member), result.outputs);
    membersFile_->line(csvLine(row));
    members_.add(row);
    membersFile_->store();
    status_[member.number] = result.status;
}

void SweepFolder::sort() {
    const auto earlier = [](const Row& a, const Row& b) { return memberOf(a) < memberOf(b); };
    members_.sort(earlier);
    doses_.sort(earlier);
    rewrite();
}

}  // namespace vkdose
