#include "host/studio/edit.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "host/core/error.h"
#include "host/model/case_tree.h"
#include "host/model/parse_toml.h"

namespace vkdose::studio {

namespace {

using Lines = std::vector<std::string>;
using Values = std::map<std::string, std::string>;  // of every key

constexpr std::size_t kMostLines = 200;  // of a value

bool isListOfTables(const Node& node) {
    return node.kind == Node::Kind::Array && !node.children.empty() && node.children.front().kind == Node::Kind::Table;
}

/// A name as it stands in a path: one with a dot, a key of a case within a study, is quoted.
std::string asStep(const std::string& name) {
    return name.find('.') == std::string::npos ? name : '"' + name + '"';
}

void gather(const Node& node, const std::string& path, std::vector<Stated>& all) {
    if (isListOfTables(node)) {
        for (std::size_t i = 0; i < node.children.size(); ++i)
            gather(node.children[i], fmt::format("{}[{}]", path, i), all);
    } else if (node.kind == Node::Kind::Table) {
        for (const Node& child : node.children)
            gather(child, path.empty() ? asStep(child.key) : path + "." + asStep(child.key), all);
    } else {
        all.push_back({path, node.line, valueText(node)});
    }
}

/// Nothing for a text that is not TOML.
std::optional<Values> valuesIn(const std::string& text) {
    const auto tree = tomlTree(text, "");
    if (!tree) return std::nullopt;
    std::vector<Stated> all;
    gather(*tree, "", all);
    Values values;
    for (Stated& one : all) values[one.key] = std::move(one.text);
    return values;
}

/// A step of a path: a name, and its place in a list of tables.
struct Step {
    std::string name;
    std::optional<std::size_t> place;
};

std::vector<Step> stepsOf(const std::string& path) {
    std::vector<Step> steps;
    for (std::size_t at = 0; at <= path.size();) {
        const bool quoted = path[at] == '"';
        const std::size_t end = std::min(path.find('.', quoted ? path.find('"', at + 1) : at), path.size());
        Step step{path.substr(at, end - at), {}};
        if (quoted && step.name.size() > 1 && step.name.ends_with('"')) {
            step.name = step.name.substr(1, step.name.size() - 2);
        } else if (const std::size_t open = step.name.find('['); open != std::string::npos) {
            std::size_t place = 0;
            std::from_chars(step.name.data() + open + 1, step.name.data() + step.name.size(), place);
            step.place = place;
            step.name.erase(open);
        }
        steps.push_back(std::move(step));
        at = end + 1;
    }
    return steps;
}

const Node* nodeAt(const Node& tree, const std::vector<Step>& steps, std::size_t count) {
    const Node* node = &tree;
    for (std::size_t i = 0; i < count && node != nullptr; ++i) {
        node = node->child(steps[i].name);
        if (node == nullptr || !steps[i].place) continue;
        const bool there = isListOfTables(*node) && *steps[i].place < node->children.size();
        node = there ? &node->children[*steps[i].place] : nullptr;
    }
    return node;
}

/// The name of a table in a header, without places in lists.
std::string headerOf(const std::vector<Step>& steps, std::size_t count) {
    std::string name;
    for (std::size_t i = 0; i < count; ++i) name += (i == 0 ? "" : ".") + asStep(steps[i].name);
    return name;
}

int lastLineOf(const Node& node) {
    int last = node.line;
    for (const Node& child : node.children) last = std::max(last, lastLineOf(child));
    return last;
}

/// Tries texts, and keeps the first that states what it should.
class Attempt {
  public:
    Attempt(const std::string& text, Values wanted) : wanted_(std::move(wanted)) {
        for (std::size_t at = 0; at < text.size();) {
            const std::size_t end = std::min(text.find('\n', at), text.size());
            lines_.push_back(text.substr(at, end - at));
            at = end + 1;
        }
    }

    /// The lines from `first` on, `count` of them, give way to `instead`.
    bool with(std::size_t first, std::size_t count, const Lines& instead) {
        if (first + count > lines_.size()) return false;
        std::string text;
        const auto add = [&](const std::string& line) { text += line + "\n"; };
        std::for_each(lines_.begin(), lines_.begin() + long(first), add);
        std::for_each(instead.begin(), instead.end(), add);
        std::for_each(lines_.begin() + long(first + count), lines_.end(), add);
        if (valuesIn(text) != wanted_) return false;
        found = std::move(text);
        return true;
    }

    const Lines& lines() const { return lines_; }
    std::optional<std::string> found;

  private:
    Lines lines_;
    Values wanted_;
};

bool replaceValue(Attempt& attempt, const Node& old, const std::string& name, const std::string& value) {
    const auto at = std::size_t(old.line - 1);
    if (at >= attempt.lines().size()) return false;
    const std::string line = attempt.lines()[at];
    // A string is kept without its quotes, which may be of two kinds.
    for (const std::string& was : {old.text, "'" + old.string + "'", valueText(old)})
        for (std::size_t from = line.find(was); from != std::string::npos && !was.empty();
             from = line.find(was, from + 1))
            if (attempt.with(at, 1, {line.substr(0, from) + value + line.substr(from + was.size())})) return true;
    for (std::size_t count = 1; count <= kMostLines; ++count)
        if (attempt.with(at, count, {name + " = " + value})) return true;
    return false;
}

bool removeKey(Attempt& attempt, const Node& old) {
    for (std::size_t count = 1; count <= kMostLines; ++count)
        if (attempt.with(std::size_t(old.line - 1), count, {})) return true;
    return false;
}

bool isOwnKey(const Node& child) {
    return child.kind != Node::Kind::Table && !isListOfTables(child);
}

bool hasOwnKeys(const Node& table) {
    return std::any_of(table.children.begin(), table.children.end(), isOwnKey);
}

/// Behind the last key of the table itself, or behind its header.
bool insertIn(Attempt& attempt, const Node& table, const std::string& entry) {
    int last = table.line;
    for (const Node& child : table.children)
        if (isOwnKey(child)) last = std::max(last, child.line);
    for (std::size_t more = 0; more <= kMostLines; ++more)
        if (attempt.with(std::size_t(last) + more, 0, {entry})) return true;
    return false;
}

/// Before the first header and behind the remarks that a file begins with.
bool insertAbove(Attempt& attempt, const std::string& entry) {
    std::size_t at = 0;
    const Lines& lines = attempt.lines();
    while (at < lines.size() && lines[at].starts_with("#")) ++at;
    return attempt.with(at, 0, {entry}) || attempt.with(0, 0, {entry});
}

bool insertTable(Attempt& attempt, const std::string& header, std::size_t from, const std::string& entry) {
    const std::size_t end = attempt.lines().size();
    if (attempt.with(end, 0, {"", header, entry})) return true;
    for (std::size_t at = from; at < std::min(end, from + kMostLines); ++at)
        if (attempt.with(at, 0, {header, entry})) return true;
    return false;
}

bool insertKey(Attempt& attempt, const Node& tree, const std::vector<Step>& steps, const std::string& value) {
    const std::size_t above = steps.size() - 1;
    const std::string entry = asStep(steps.back().name) + " = " + value;
    if (above == 0) return (hasOwnKeys(tree) && insertIn(attempt, tree, entry)) || insertAbove(attempt, entry);
    const std::string header = headerOf(steps, above);
    if (const Node* table = nodeAt(tree, steps, above)) {
        if (table->kind != Node::Kind::Table) return false;
        if (insertIn(attempt, *table, entry)) return true;
        return insertIn(attempt, *table, header + "." + entry);  // of a table that has dotted keys and no header
    }
    if (steps[above - 1].place) return insertTable(attempt, "[[" + header + "]]", 0, entry);
    // A table within an element of a list stands behind that element.
    const Node* within = nodeAt(tree, steps, above - 1);
    return insertTable(attempt, "[" + header + "]", within ? std::size_t(lastLineOf(*within)) : 0, entry);
}

}  // namespace

std::vector<Stated> statedIn(const std::string& text) {
    std::vector<Stated> all;
    gather(parseToml(text, ""), "", all);
    return all;
}

std::optional<std::string> edited(const std::string& text, const std::string& key,
                                  const std::optional<std::string>& value) {
    const Node tree = parseToml(text, "");
    Values wanted = valuesIn(text).value();
    if (value) {
        const Node given = parseToml("x = " + *value, key);
        if (given.children.size() != 1 || value->find('\n') != std::string::npos)
            throw CaseError({{"", 0, key, *value, "is more than one value", "give one"}});
        wanted[key] = valueText(given.children.front());
    } else if (wanted.erase(key) == 0) {
        return text;
    }
    Attempt attempt(text, std::move(wanted));
    const std::vector<Step> steps = stepsOf(key);
    const Node* old = nodeAt(tree, steps, steps.size());
    if (!value)
        (void)removeKey(attempt, *old);
    else if (old != nullptr)
        (void)replaceValue(attempt, *old, asStep(steps.back().name), *value);
    else
        (void)insertKey(attempt, tree, steps, *value);
    return attempt.found;
}

}  // namespace vkdose::studio
