#include "host/report/runs_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "host/model/case_tree.h"

namespace vkdose::report {

namespace fs = std::filesystem;

namespace {

/// Every key below `table` with its value, in the order of the file.
void collect(const Node& table, const std::string& prefix, std::vector<std::pair<std::string, std::string>>& values) {
    for (const Node& node : table.children) {
        if (node.kind == Node::Kind::Table)
            collect(node, prefix + node.key + ".", values);
        else
            values.emplace_back(prefix + node.key, valueText(node));
    }
}

/// What a page of one run shows and this one does not.
constexpr std::array kLeftOut{"kind", "reason", "name", "surface", "fields", "player", "case", "experiment"};

}  // namespace

std::vector<std::string> runLabels(const std::vector<fs::path>& folders) {
    std::vector<std::string> labels;
    std::set<std::string> once;
    for (const fs::path& folder : folders) {
        const fs::path plain = folder.has_filename() ? folder : folder.parent_path();  // "out/a/"
        labels.push_back(plain.filename().string());
        once.insert(labels.back());
    }
    if (once.size() == folders.size() && once.count(".") + once.count("..") == 0) return labels;
    for (std::size_t i = 0; i < folders.size(); ++i) labels[i] = folders[i].string();
    return labels;
}

Json comparedCases(const std::vector<std::string>& cases) {
    std::vector<std::string> order;
    std::map<std::string, std::vector<std::string>> values;
    for (std::size_t i = 0; i < cases.size(); ++i) {
        std::vector<std::pair<std::string, std::string>> own;
        collect(readTreeText(cases[i], "case.toml"), "", own);
        for (const auto& [key, value] : own) {
            if (key == "name" || key == "reason") continue;
            std::vector<std::string>& all = values[key];
            if (all.empty()) {
                order.push_back(key);
                all.resize(cases.size());
            }
            all[i] = value;
        }
    }
    const auto same = [&](const std::string& key) {
        const std::vector<std::string>& all = values[key];
        return std::all_of(all.begin(), all.end(), [&](const std::string& v) { return v == all.front(); });
    };
    std::stable_partition(order.begin(), order.end(), [&](const std::string& key) { return !same(key); });
    Json list = Json::array();
    for (const std::string& key : order) list.push_back({{"key", key}, {"values", values[key]}, {"same", same(key)}});
    return list;
}

Json runsJson(const std::vector<fs::path>& folders) {
    const std::vector<std::string> labels = runLabels(folders);
    std::vector<std::string> cases;
    Json runs = Json::array();
    std::string names;
    for (std::size_t i = 0; i < folders.size(); ++i) {
        Json run = runJson(folders[i], {});
        cases.push_back(run["case"].get<std::string>());
        Json kept{{"label", labels[i]}, {"case_name", run["name"]}, {"why", run["reason"]}};
        for (const auto& [key, value] : run.items())
            if (std::find(kLeftOut.begin(), kLeftOut.end(), key) == kLeftOut.end()) kept[key] = value;
        runs.push_back(std::move(kept));
        names += (names.empty() ? "" : ", ") + labels[i];
    }
    return {{"kind", "runs"}, {"name", names}, {"reason", ""}, {"runs", runs}, {"keys", comparedCases(cases)}};
}

}  // namespace vkdose::report
