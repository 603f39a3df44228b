#include "host/study/readable_case.h"

#include <fmt/format.h>

#include <algorithm>

namespace vkdose {

namespace {

bool isListOfTables(const Node& node) {
    const auto isTable = [](const Node& item) { return item.kind == Node::Kind::Table; };
    return node.kind == Node::Kind::Array && !node.children.empty() &&
           std::all_of(node.children.begin(), node.children.end(), isTable);
}

/// Puts a table's own values first: below the header of another table they would belong to that.
void put(const Node& table, const std::string& path, std::string& text) {
    const auto below = [&](const Node& child) { return path.empty() ? child.key : path + "." + child.key; };
    for (const Node& child : table.children)
        if (child.kind != Node::Kind::Table && !isListOfTables(child))
            text += fmt::format("{} = {}\n", child.key, valueText(child));
    for (const Node& child : table.children) {
        if (child.kind == Node::Kind::Table) {
            text += fmt::format("\n[{}]\n", below(child));
            put(child, below(child), text);
        } else if (isListOfTables(child)) {
            for (const Node& item : child.children) {
                text += fmt::format("\n[[{}]]\n", below(child));
                put(item, below(child), text);
            }
        }
    }
}

}  // namespace

std::string readableText(const Node& tree) {
    std::string text;
    put(tree, "", text);
    return text;
}

}  // namespace vkdose
