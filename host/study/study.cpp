#include "host/study/study.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "host/core/file.h"
#include "host/core/number.h"
#include "host/model/case_keys.h"
#include "host/model/case_reader.h"
#include "host/model/named_file.h"
#include "host/study/read_axis.h"
#include "host/study/study_keys.h"

namespace vkdose {

namespace {

/// The settings in a table, with or without quotes around dotted keys.
void readSettings(CaseReader& reader, const Node& table, const std::string& prefix, const std::string& path,
                  std::vector<Setting>& into, std::set<std::string>& used) {
    for (const Node& value : table.children) {
        const std::string key = prefix.empty() ? value.key : prefix + "." + value.key;
        if (value.kind == Node::Kind::Table) {
            readSettings(reader, value, key, path, into, used);
        } else if (checkKey(reader, path, key, used)) {
            into.push_back({key, value});
        }
    }
}

void readSeeds(CaseReader& reader, Section& root, Study& study) {
    constexpr const char* kRemedy = "give a list of different whole numbers >= 0, or how many: seeds = 3";
    const Node* node = root.node("seeds");
    if (node == nullptr) return;
    if (node->kind == Node::Kind::Integer) {
        if (node->integer < 1 || node->integer > std::int64_t(kMostMembers))
            reader.fault("seeds", "is not a number of seeds", kRemedy);
        else
            for (std::int64_t seed = 1; seed <= node->integer; ++seed) study.seeds.push_back(std::uint64_t(seed));
        return;
    }
    std::set<std::int64_t> seen;
    bool good = node->kind == Node::Kind::Array && !node->children.empty();
    for (const Node& seed : node->children) {
        good = good && seed.kind == Node::Kind::Integer && seed.integer >= 0 && seen.insert(seed.integer).second;
        study.seeds.push_back(std::uint64_t(seed.integer));
    }
    if (!good) reader.fault("seeds", "are not seeds", kRemedy);
}

void checkCount(CaseReader& reader, const Study& study) {
    double members = double(std::max<std::size_t>(1, study.seeds.size()));
    for (const Axis& axis : study.axes) members *= double(axis.points.size());
    if (members > double(kMostMembers))
        reader.fault("axis", fmt::format("{:.0f} members are more than {}", members, kMostMembers),
                     "leave out points, or make several studies of it");
}

/// A search finds its points itself, so it has no axes. A grid interpolates along an axis of numbers.
void checkCalibration(CaseReader& reader, const Study& study) {
    const CalibrationAim& aim = *study.calibration;
    if (aim.searches()) {
        if (!study.axes.empty())
            reader.fault(aim.method == CalibrationAim::Method::Design ? "axis" : "calibrate.method",
                         "a search has no axes", fmt::format("give it [[{}.parameter]] instead", aim.table()));
        return;
    }
    const auto axis = std::find_if(study.axes.begin(), study.axes.end(), [&](const Axis& a) {
        return a.keys == std::vector<std::string>{aim.along} && a.points.size() > 1 &&
               std::all_of(a.points.begin(), a.points.end(), [](const auto& p) { return p.front().isNumber(); });
    });
    if (axis == study.axes.end())
        reader.fault("calibrate.along", fmt::format("no axis has {} alone, at two numbers or more", aim.along),
                     "name the key of the axis to interpolate along");
}

/// Refuses a case: it has none of a study's tables, and all its keys would be reported as unknown.
void refuseCase(const std::filesystem::path& file, const Node& tree) {
    for (const char* name : {"axis", "seeds", "set", "calibrate", "design"})
        if (tree.child(name) != nullptr) return;
    for (const KeyTable& table : caseKeys()) {
        const Node* node = table.paths.empty() ? nullptr : tree.child(wordsOf(table.paths).front());
        if (node == nullptr || node->kind != Node::Kind::Table) continue;
        throw CaseError({{file.string(), node->line, "", "", "this is a case, not a study",
                          "give it to `vkdose run`, or write a study with it as base"}});
    }
}

/// The keys of a tree with their values, without the tables around them.
void gatherSettings(const Node& node, const std::string& path, std::vector<Setting>& into) {
    for (const Node& child : node.children) {
        const std::string key = path.empty() ? child.key : path + "." + child.key;
        if (child.kind == Node::Kind::Table)
            gatherSettings(child, key, into);
        else
            into.push_back({key, child});
    }
}

}  // namespace

void applyOverrides(Study& study, const std::vector<std::string>& overrides) {
    std::vector<Setting> settings;
    gatherSettings(overrideTree(overrides), "", settings);
    const std::vector<std::string> varied = study.keys();
    std::vector<Diagnostic> faults;
    for (const Setting& s : settings) {
        const auto refuse = [&](const char* problem, const char* remedy) {
            faults.push_back({kCommandLine, 0, s.key, valueText(s.value), problem, remedy});
        };
        if (std::find(varied.begin(), varied.end(), s.key) != varied.end())
            refuse("is a key that the study varies", "change its values in the study");
        else if (s.key == "seed")
            refuse("is not one for all members", "give seeds in the study");
        else if (s.key == "base" || s.key == "name" || s.key == "reason")
            refuse("is not a value of the members", "change it in the study");
        std::erase_if(study.set, [&](const Setting& old) { return old.key == s.key; });
        study.set.push_back(s);
    }
    if (!faults.empty()) throw CaseError(faults);
    study.overrides = overrides;
    if (!overrides.empty() && !study.text.ends_with('\n')) study.text += '\n';
    for (const std::string& text : overrides) study.text += fmt::format("# --set {}\n", text);
}

std::vector<std::string> Study::keys() const {
    std::vector<std::string> all;
    for (const Axis& axis : axes) all.insert(all.end(), axis.keys.begin(), axis.keys.end());
    if (calibration)
        for (const FreeParameter& p : calibration->parameters) all.push_back(p.key);
    if (severalBases()) all.emplace_back("base");
    return all;
}

bool Study::severalBases() const {
    return calibration && calibration->bases().size() > 1;
}

Study readStudy(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
    Node tree = readTreeAlone(file);
    refuseCase(file, tree);
    CaseReader reader(file.string(), std::move(tree), studyKeys());
    Section& root = reader.root();
    Study study;
    study.file = file;
    study.text = fileContent(file).value_or("");
    study.name = root.string("name", file.stem().string());
    study.reason = root.string("reason");
    const std::string base = root.string("base");
    study.base = file.parent_path() / base;
    if (!base.empty())
        requireFile(reader, "base", study.base, "give the path of a case file, relative to the study's folder");
    readSeeds(reader, root, study);
    std::set<std::string> used;
    if (const Node* set = root.node("set")) {
        if (set->kind == Node::Kind::Table)
            readSettings(reader, *set, "", "set", study.set, used);
        else
            reader.fault("set", "is not a table", "write [set]");
    }
    const std::vector<Section*> axes = root.tables("axis");
    for (std::size_t i = 0; i < axes.size(); ++i)
        study.axes.push_back(readAxis(reader, *axes[i], fmt::format("axis[{}]", i), file.parent_path(), used));
    if (root.has("calibrate")) {
        study.calibration = readCalibrationAim(reader, root.table("calibrate"), file.parent_path(), study.base);
        if (root.has("design")) reader.fault("design", "stands beside [calibrate]", "keep one of the two in a study");
    } else if (root.has("design")) {
        study.calibration = readDesignAim(reader, root.table("design"), file.parent_path(), study.base);
    }
    for (const char* table : {"calibrate", "design"}) root.know(table);
    if (study.calibration)
        for (std::size_t i = 0; i < study.calibration->parameters.size(); ++i)
            checkKey(reader, fmt::format("{}.parameter[{}].key", study.calibration->table(), i),
                     study.calibration->parameters[i].key, used);
    if (study.calibration) checkCalibration(reader, study);
    checkCount(reader, study);
    reader.finish();
    reader.throwIfFaulty();
    applyOverrides(study, overrides);
    return study;
}

}  // namespace vkdose
