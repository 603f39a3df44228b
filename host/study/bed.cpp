#include "host/study/bed.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <system_error>

#include "host/core/error.h"
#include "host/core/file.h"
#include "host/model/case_tree.h"
#include "host/model/stability.h"
#include "host/output/checkpoint.h"
#include "host/output/field_files.h"
#include "host/study/member_result.h"

namespace vkdose {

namespace fs = std::filesystem;

namespace {

/// Keys that say how the doses are, what the case is for, or how it was made, and the ends of a run.
constexpr const char* kLater[] = {"name", "reason", "accepted_warnings", "bulk_density", "dose", "stop"};

constexpr const char* kClasses[][2] = {{"", "kc_over_k"}, {"wall", "wall_kc_over_k"}, {"coil", "coil_kc_over_k"}};

/// The adhesion of the doses makes place for that of the settling, and words about where it comes from go.
void settleAlone(Node& contact, const Node& settle) {
    for (const auto& [name, key] : kClasses) {
        Node* table = *name == '\0' ? &contact : contact.child(name);
        const Node* adhesion = settle.child(key);
        if (table == nullptr || adhesion == nullptr) continue;
        table->drop("derived");
        if (Node* own = table->child("kc_over_k")) {
            Node value = *adhesion;
            value.key = "kc_over_k";
            *own = std::move(value);
        }
    }
}

/// The step is stated by now, so that the number of steps in a contact that led to it does not matter. The least that
/// is allowed takes its place: without any, a step that was taken for few steps would be refused as too long.
void forgetSteps(Node& time) {
    time.drop("steps_per_contact");
    Node fewest;
    fewest.kind = Node::Kind::Float;
    fewest.number = kFewestSteps;
    fewest.text = fmt::format("{}", kFewestSteps);
    plant(time, "steps_per_contact", std::move(fewest));
}

void copyFile(const fs::path& from, const fs::path& to) {
    const std::optional<std::string> content = fileContent(from);
    if (!content) throw CheckpointError(unreadable(from));
    replaceFile(to, *content);
}

}  // namespace

std::string bedText(const Case& c) {
    const Schedule& s = c.schedule;
    if (!(s.settleTime > 0) || !(s.rotateTime > 0) || c.frames.interval > 0 || s.stop.endTime <= s.settleTime)
        return "";
    Node tree = readTreeText(c.resolved, "case.toml");
    const bool driven = tree.child("dose") != nullptr && tree.child("dose")->child("speed_rpm") != nullptr;
    for (const char* key : kLater) tree.drop(key);
    if (Node* time = tree.child("time")) forgetSteps(*time);
    Node* contact = tree.child("contact");
    const Node* settle = tree.child("settle");
    if (contact == nullptr || settle == nullptr) return "";
    settleAlone(*contact, *settle);
    std::vector<std::string> none{"name=bed", "dose.rotate_s=0"};
    if (driven) none.emplace_back("dose.speed_rpm=0");
    if (c.world.coil) none.emplace_back("coil.speed_rpm=0");
    merge(tree, overrideTree(none));
    try {
        return loadResolvedCase(treeText(tree), "case.toml").resolved;
    } catch (const CaseError&) {  // without its doses it is no case
        return "";
    }
}

std::vector<Bed> bedsOf(const std::vector<Member>& members) {
    std::vector<Bed> beds;
    std::map<std::string, std::size_t> known;
    for (const Member& m : members) {
        if (m.bed.empty()) continue;
        const auto [place, fresh] = known.emplace(m.bed, beds.size());
        if (fresh) beds.push_back({m.number, m.bed, {}});
        beds[place->second].members.push_back(m.number);
    }
    std::erase_if(beds, [](const Bed& bed) { return bed.members.size() < 2; });
    return beds;
}

double workSaved(const std::vector<Bed>& beds, const std::vector<Member>& members) {
    double saved = 0;
    for (const Bed& bed : beds)
        for (const Member& m : members)
            if (m.number == bed.number) saved += double(bed.members.size() - 1) * m.settlingWork;
    return saved;
}

fs::path bedFolder(const fs::path& sweep, const Bed& bed) {
    return sweep / "beds" / fmt::format("{:04}", bed.number);
}

bool isSettled(const fs::path& folder, const std::string& caseText) {
    return isOver(folder) && fs::exists(folder / kSettledName) && fileContent(folder / "case.toml") == caseText;
}

void plantBed(const fs::path& bed, const fs::path& run, const Member& member) {
    Checkpoint state = readCheckpoint(bed / kSettledName);
    for (const char* name : {"timeseries.csv", "doses.csv"}) copyFile(bed / name, run / name);
    const fs::path fields = bed / kFieldsFolder;
    if (fs::exists(fields)) {
        createFolder(run / kFieldsFolder);
        for (const auto& entry : fs::directory_iterator(fields))
            copyFile(entry.path(), run / kFieldsFolder / entry.path().filename());
    }
    state.caseText = state.given = member.caseText;
    state.member = std::uint32_t(member.number);
    state.keepsStates = false;
    writeCheckpoint(run / kCheckpointName, state);
}

}  // namespace vkdose
