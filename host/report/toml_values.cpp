#include "host/report/toml_values.h"

#include <fmt/format.h>

#include <cmath>

#include "host/core/csv_table.h"

namespace vkdose::report {

namespace {

void collect(const Node& table, const std::string& prefix, std::map<std::string, Setting>& settings) {
    for (const Node& node : table.children) {
        const std::string key = prefix + node.key;
        if (node.kind == Node::Kind::Table)
            collect(node, key + ".", settings);
        else if (node.kind == Node::Kind::Float)
            settings[key] = {fmt::format("{}", node.number), node.number};
        else if (node.kind == Node::Kind::Integer)
            settings[key] = {fmt::format("{}", node.integer), node.number};
        else if (node.kind == Node::Kind::String)
            settings[key] = {node.string, std::nan("")};
        else if (node.kind == Node::Kind::Boolean)
            settings[key] = {node.boolean ? "true" : "false", std::nan("")};
    }
}

}  // namespace

std::map<std::string, Setting> settingsOf(const Node& table) {
    std::map<std::string, Setting> settings;
    collect(table, "", settings);
    return settings;
}

Setting settingOf(const std::string& text) {
    return {text, numberIn(text)};
}

std::string textIn(const Node& table, std::string_view key, const std::string& otherwise) {
    const Node* node = table.child(key);
    return node != nullptr && node->kind == Node::Kind::String ? node->string : otherwise;
}

}  // namespace vkdose::report
