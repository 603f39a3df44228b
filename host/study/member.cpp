#include "host/study/member.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "host/core/csv_lines.h"
#include "host/core/error.h"
#include "host/core/number.h"
#include "host/model/case.h"
#include "host/sim/timeline.h"
#include "host/study/bed.h"
#include "host/study/readable_case.h"

namespace vkdose {

namespace {

Node treeOf(const std::vector<Setting>& settings) {
    Node tree;
    for (const Setting& s : settings) {
        if (plant(tree, s.key, s.value)) continue;
        throw CaseError(
            {{s.value.file, s.value.line, s.key, s.value.text, "stands inside another key that is set, or holds one",
              "set a table as a whole or its keys, not both"}});
    }
    return tree;
}

/// A value that no line of the study holds.
Node ownNode(const Study& study, Node::Kind kind, std::string text) {
    Node node;
    node.kind = kind;
    node.file = study.file.string();
    if (kind == Node::Kind::String)
        node.string = text;
    else
        node.number = numberOf(text).value();
    node.text = std::move(text);
    return node;
}

Node seedNode(const Study& study, std::uint64_t seed) {
    Node node = ownNode(study, Node::Kind::Integer, fmt::format("{}", seed));
    node.integer = std::int64_t(seed);
    return node;
}

/// "friction = 0.5, turns = 8": the point at which several keys together make a fault.
std::string pointText(const std::vector<Setting>& point) {
    std::string text;
    for (const Setting& s : point) text += (text.empty() ? "" : ", ") + s.key + " = " + valueText(s.value);
    return text;
}

/// Calls `visit` with each combination of the axes, the last fastest.
template <class Visit>
void forEachPoint(const std::vector<Axis>& axes, const Visit& visit) {
    std::vector<std::size_t> at(axes.size(), 0);
    for (;;) {
        std::vector<Setting> point;
        for (std::size_t a = 0; a < axes.size(); ++a)
            for (std::size_t k = 0; k < axes[a].keys.size(); ++k)
                point.push_back({axes[a].keys[k], axes[a].points[at[a]][k]});
        visit(point);
        std::size_t a = axes.size();
        while (a > 0 && ++at[a - 1] == axes[a - 1].points.size()) at[--a] = 0;
        if (a == 0) return;
    }
}

}  // namespace

std::string tableText(const Node& value) {
    if (value.kind == Node::Kind::String) return value.string;
    const std::string text = valueText(value);
    // TOML allows 2_000 and +0.5, which are no numbers for who reads the table.
    return value.isNumber() && std::isnan(numberIn(text)) ? fmt::format("{}", value.number) : text;
}

Setting settingOf(const Study& study, const std::string& key, double value) {
    return {key, ownNode(study, Node::Kind::Float, fmt::format("{:.6g}", value))};
}

std::string caseAt(const Study& study, const std::vector<Setting>& point, const std::string& name,
                   const std::string& reason) {
    std::vector<Setting> own = point;
    if (!study.seeds.empty()) own.push_back({"seed", seedNode(study, study.seeds.front())});
    own.push_back({"name", ownNode(study, Node::Kind::String, name)});
    own.push_back({"reason", ownNode(study, Node::Kind::String, reason)});
    const Case c = loadVariant(study.base, {treeOf(study.set), treeOf(own)});
    return readableText(readTreeText(c.given, study.base.string()));
}

Member memberAt(const Study& study, int number, std::optional<std::uint64_t> seed, const std::vector<Setting>& point,
                const std::filesystem::path& base) {
    std::vector<Setting> own = point;
    if (seed) own.push_back({"seed", seedNode(study, *seed)});
    const Case c = loadVariant(base.empty() ? study.base : base, {treeOf(study.set), treeOf(own)});
    const Timeline timeline(c);
    const Derived derived = derive(c, insertParticles(c));
    Member member;
    member.number = number;
    member.seed = c.seed;
    for (const Setting& s : point) member.values.push_back(tableText(s.value));
    if (study.severalBases()) member.values.push_back((base.empty() ? study.base : base).filename().string());
    member.caseText = c.resolved;
    member.particles = derived.particles;
    member.expectedTime = derived.steps * derived.timeStep;
    member.expectedWork = derived.work;
    member.settlingWork = double(timeline.settleSteps()) * double(derived.particles);
    member.bed = bedText(c);
    return member;
}

std::vector<Member> membersOf(const Study& study) {
    std::vector<std::optional<std::uint64_t>> seeds(study.seeds.begin(), study.seeds.end());
    if (seeds.empty()) seeds.emplace_back();
    std::vector<Member> members;
    std::vector<Diagnostic> faults;
    std::set<std::string> told;
    int number = 0;
    for (const auto& seed : seeds) {
        forEachPoint(study.axes, [&](const std::vector<Setting>& point) {
            try {
                members.push_back(memberAt(study, number, seed, point));
            } catch (const CaseError& error) {
                for (Diagnostic fault : error.faults()) {
                    if (!told.insert(fault.text()).second) continue;
                    if (!point.empty()) fault.remedy += fmt::format(" (member {}: {})", number, pointText(point));
                    faults.push_back(fault);
                }
            }
            ++number;
        });
    }
    if (!faults.empty()) throw CaseError(faults);
    return members;
}

}  // namespace vkdose
