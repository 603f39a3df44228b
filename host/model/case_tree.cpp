#include "host/model/case_tree.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <sstream>

#include "host/core/file.h"
#include "host/model/case_keys.h"

namespace vkdose {
namespace {

/// TOML text being converted: its name for messages and its lines, to show a value as it was written.
struct Source {
    std::string name;
    std::vector<std::string> lines;
};

Source makeSource(std::string name, const std::string& text) {
    Source source{std::move(name), {}};
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) source.lines.push_back(line);
    return source;
}

/// Byte at which a column of toml++ begins. (toml++ counts columns in characters.)
std::size_t byteOf(const std::string& text, std::size_t column) {
    std::size_t at = 0;
    for (std::size_t seen = 1; at < text.size() && seen < column; ++seen) {
        ++at;
        while (at < text.size() && (static_cast<unsigned char>(text[at]) & 0xc0U) == 0x80U) ++at;
    }
    return at;
}

/// The value as it was written, if it is on one line; otherwise "...".
std::string written(const toml::source_region& region, const Source& source) {
    const std::size_t line = region.begin.line;
    if (line == 0 || line > source.lines.size() || region.end.line != region.begin.line) return "...";
    const std::string& text = source.lines[line - 1];
    const std::size_t first = byteOf(text, region.begin.column);
    std::string value = text.substr(first, byteOf(text, region.end.column) - first);
    while (!value.empty() && std::isspace(static_cast<unsigned char>(value.back())) != 0) value.pop_back();
    return value;
}

void setScalar(Node& node, const toml::node& from) {
    if (const auto* value = from.as_boolean()) {
        node.kind = Node::Kind::Boolean;
        node.boolean = value->get();
    } else if (const auto* whole = from.as_integer()) {
        node.kind = Node::Kind::Integer;
        node.integer = whole->get();
        node.number = static_cast<double>(whole->get());
    } else if (const auto* real = from.as_floating_point()) {
        node.kind = Node::Kind::Float;
        node.number = real->get();
    } else if (const auto* string = from.as_string()) {
        node.kind = Node::Kind::String;
        node.string = string->get();
        node.text = fmt::format("\"{}\"", node.string);
    } else {
        node.kind = Node::Kind::Other;
    }
}

Node convert(const toml::node& from, const Source& source, std::string key) {
    Node node;
    node.key = std::move(key);
    node.file = source.name;
    node.line = static_cast<int>(from.source().begin.line);
    if (const toml::table* table = from.as_table()) {
        node.kind = Node::Kind::Table;
        for (const auto& [name, value] : *table)
            node.children.push_back(convert(value, source, std::string(name.str())));
        // Keep the order of the file, not of the alphabet, so that faults are reported from top to bottom.
        std::stable_sort(node.children.begin(), node.children.end(),
                         [](const Node& a, const Node& b) { return a.line < b.line; });
    } else if (const toml::array* array = from.as_array()) {
        node.kind = Node::Kind::Array;
        node.text = written(from.source(), source);
        for (const toml::node& value : *array) node.children.push_back(convert(value, source, ""));
    } else {
        node.text = written(from.source(), source);
        setScalar(node, from);
    }
    return node;
}

std::string readText(const std::filesystem::path& file, const Diagnostic& whoAsks) {
    std::optional<std::string> text = fileContent(file);
    if (text) return *std::move(text);
    Diagnostic fault = whoAsks;
    fault.problem = unreadable(file);
    if (fault.file.empty()) fault = {file.string(), 0, "", "", readFault(file), fault.remedy};
    throw CaseError({fault});
}

/// Largest number of dots. The parser works by recursion, one level for every part of a dotted key and for every
/// bracket. It limits the brackets itself (256). With this limit on the dots, the deepest text stays far from the end
/// of the stack.
constexpr std::ptrdiff_t kMostDots = 64;
/// Longest text that is read. A case is only a few kilobytes long.
constexpr std::size_t kMostBytes = 1U << 20U;

/// Refuses a text that cannot be a case before the parser sees it.
void requirePlain(const std::string& text, const std::string& name) {
    const char* remedy = "give the path of a case file";
    if (text.size() > kMostBytes)
        throw CaseError({{name, 0, "", "", fmt::format("not a case: {} MiB long", text.size() >> 20U), remedy}});
    std::istringstream stream(text);
    int number = 0;
    for (std::string line; std::getline(stream, line);) {
        ++number;
        const std::size_t first = line.find_first_not_of(" \t");
        const bool comment = first != std::string::npos && line[first] == '#';
        if (!comment && std::count(line.begin(), line.end(), '.') > kMostDots)
            throw CaseError(
                {{name, number, "", "", fmt::format("not a case: more than {} dots in a line", kMostDots), remedy}});
    }
}

/// Turns an error of the parser into a message in the words of a case. The parser knows only the grammar, not the
/// mistakes that people usually make.
Diagnostic syntaxFault(const toml::parse_error& error, const std::string& text, const std::string& name) {
    const std::string said = shortened(std::string(error.description()));
    const auto at = static_cast<std::size_t>(error.source().begin.line);
    Diagnostic fault{name, static_cast<int>(at), "", "", "not TOML: " + said, "see https://toml.io for the syntax"};
    const Source source = makeSource(name, text);
    const std::string line = at >= 1 && at <= source.lines.size() ? shortened(source.lines[at - 1]) : "";
    const auto says = [&](const char* words) { return said.find(words) != std::string::npos; };
    if (says("cannot redefine existing")) {
        fault.problem = fmt::format("not TOML: {} is there twice", said.substr(said.find("existing") + 9));
        fault.remedy = "keep one of the two";
    } else if (says("utf-8") || says("UTF-8")) {
        fault.problem = "not TOML: the text is not UTF-8";
        fault.remedy = "save the file as UTF-8";
    } else if (says("expected a comment or whitespace, saw ','")) {
        fault.problem = fmt::format("not TOML: a comma in a number: {}", line);
        fault.remedy = "write decimals with a point";
    } else if (says("expected a comment or whitespace, saw")) {
        fault.problem = fmt::format("not TOML: more than a value: {}", line);
        fault.remedy = "give the value alone, without its unit; a text stands between quotes";
    }
    return fault;
}

Node parseText(const std::string& text, const std::string& name) {
    requirePlain(text, name);
    try {
        const toml::table table = toml::parse(text, name);
        Node node = convert(table, makeSource(name, text), "");
        node.line = 0;
        return node;
    } catch (const toml::parse_error& error) {
        throw CaseError({syntaxFault(error, text, name)});
    }
}

Node readWithBase(const std::filesystem::path& file, const Diagnostic& whoAsks,
                  std::vector<std::filesystem::path>& above) {
    std::error_code code;
    const std::filesystem::path canonical = std::filesystem::weakly_canonical(file, code);
    if (std::find(above.begin(), above.end(), canonical) != above.end()) {
        Diagnostic fault = whoAsks;
        fault.problem = "this base leads back to the file itself";
        fault.remedy = "name a base that does not build on this case";
        throw CaseError({fault});
    }
    above.push_back(canonical);
    Node tree = parseText(readText(file, whoAsks), file.string());
    const Node* base = tree.child("base");
    if (base == nullptr) return tree;
    const Diagnostic place{base->file, base->line, "base",
                           base->text, "",         "give the path of a case file, relative to this one"};
    if (base->kind != Node::Kind::String) {
        Diagnostic fault = place;
        fault.problem = "must be a string";
        throw CaseError({fault});
    }
    Node lower = readWithBase(file.parent_path() / base->string, place, above);
    tree.drop("base");
    merge(lower, std::move(tree));
    return lower;
}

/// Removes from `lower` the keys that keys of `upper` exclude, so that the upper layer wins.
void dropRivals(Node& lower, const Node& upper, std::string_view path) {
    for (const Key* key : keysOf(caseKeys(), path)) {
        const Node* winner = upper.child(key->name);
        if (key->losers.empty() || winner == nullptr) continue;
        const Node* before = lower.child(key->name);
        const bool choice = key->type == Key::Type::Word;
        if (choice && (before == nullptr || before->string == winner->string)) continue;
        for (const std::string& loser : wordsOf(key->losers)) {
            if (loser == "*")
                lower.children.clear();
            else
                lower.drop(loser);
        }
    }
}

void mergeAt(Node& lower, Node upper, const std::string& path) {
    dropRivals(lower, upper, path);
    for (Node& value : upper.children) {
        Node* below = lower.child(value.key);
        if (below == nullptr)
            lower.children.push_back(std::move(value));
        else if (below->kind == Node::Kind::Table && value.kind == Node::Kind::Table)
            mergeAt(*below, std::move(value), path.empty() ? below->key : path + "." + below->key);
        else
            *below = std::move(value);
    }
}

/// The keys whose values are paths, relative to the file that they stand in.
constexpr std::array<std::string_view, 4> kPathKeys{"list", "sieves", "mesh", "file"};

void makePathsAbsolute(Node& node) {
    for (Node& child : node.children) {
        const bool path = child.kind == Node::Kind::String &&
                          std::find(kPathKeys.begin(), kPathKeys.end(), child.key) != kPathKeys.end();
        const std::filesystem::path file = child.file == kCommandLine ? "" : child.file;
        if (path)
            child.string = std::filesystem::absolute(file.parent_path() / child.string).lexically_normal().string();
        makePathsAbsolute(child);
    }
}

bool isBareWord(const std::string& value) {
    const auto first = static_cast<unsigned char>(value.empty() ? '-' : value.front());
    if (std::isalpha(first) == 0 && first != '/' && first != '.' && first != '_') return false;
    return std::none_of(value.begin(), value.end(), [](char c) { return c == '"' || c == '\'' || c == '\n'; });
}

Node overrideNode(const std::string& path, const std::string& value) {
    const Diagnostic fault{kCommandLine, 0, path, value, "", "write key.path=value with a TOML value or a bare word"};
    if (value.find('\n') != std::string::npos) {
        Diagnostic bad = fault;
        bad.problem = "is more than one line";
        throw CaseError({bad});
    }
    if (!isKeyPath(path)) {
        Diagnostic bad = fault;
        bad.problem = "is not the path of a key";
        throw CaseError({bad});
    }
    Node tree;
    try {
        const std::string text = fmt::format("{} = {}", path, value);
        requirePlain(text, kCommandLine);
        tree = convert(toml::parse(text), makeSource(kCommandLine, text), "");
    } catch (const toml::parse_error&) {
        if (!isBareWord(value)) {
            Diagnostic bad = fault;
            bad.problem = "is not a value";
            throw CaseError({bad});
        }
        const std::string text = fmt::format("{} = '{}'", path, value);
        tree = convert(toml::parse(text), makeSource(kCommandLine, text), "");
    }
    return tree;
}

void clearLines(Node& node) {
    node.line = 0;
    for (Node& child : node.children) clearLines(child);
}

}  // namespace

const Node* Node::child(std::string_view name) const {
    if (kind != Kind::Table) return nullptr;
    const auto found = std::find_if(children.begin(), children.end(), [&](const Node& n) { return n.key == name; });
    return found == children.end() ? nullptr : &*found;
}

Node* Node::child(std::string_view name) {
    return const_cast<Node*>(static_cast<const Node*>(this)->child(name));
}

void Node::drop(std::string_view name) {
    children.erase(std::remove_if(children.begin(), children.end(), [&](const Node& n) { return n.key == name; }),
                   children.end());
}

Node readTreeAlone(const std::filesystem::path& file) {
    return parseText(readText(file, {"", 0, "", "", "", "give the path of a file"}), file.string());
}

Node readTree(const std::filesystem::path& file, std::vector<std::filesystem::path>& files) {
    return readWithBase(file, {"", 0, "", "", "", "give the path of a case file"}, files);
}

Node readTreeText(const std::string& text, const std::string& name) {
    Node tree = parseText(text, name);
    if (const Node* base = tree.child("base"))
        throw CaseError({{name, base->line, "base", base->text, "there is no base here", "give the resolved case"}});
    return tree;
}

Node overrideTree(const std::vector<std::string>& overrides) {
    Node all;
    all.file = kCommandLine;
    std::vector<Diagnostic> faults;
    for (const std::string& text : overrides) {
        const std::size_t equals = text.find('=');
        const auto trim = [](std::string s) {
            s.erase(0, s.find_first_not_of(" \t"));
            s.erase(s.find_last_not_of(" \t") + 1);
            return s;
        };
        try {
            if (equals == std::string::npos)
                throw CaseError({{kCommandLine, 0, text, "", "has no value", "write key.path=value"}});
            // "\n" is a path that no table has, so that no override removes another. Two overrides that exclude each
            // other are a fault, which is reported later.
            mergeAt(all, overrideNode(trim(text.substr(0, equals)), trim(text.substr(equals + 1))), "\n");
        } catch (const CaseError& error) {
            faults.insert(faults.end(), error.faults().begin(), error.faults().end());
        }
    }
    if (!faults.empty()) throw CaseError(faults);
    clearLines(all);
    return all;
}

bool isKeyPath(std::string_view path) {
    return !path.empty() && path.front() != '.' && path.back() != '.' && path.find("..") == std::string_view::npos &&
           path.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-.") ==
               std::string_view::npos;
}

bool plant(Node& tree, const std::string& path, Node value) {
    const std::size_t dot = path.find('.');
    const std::string key = path.substr(0, dot);
    Node* below = tree.child(key);
    if (dot == std::string::npos) {
        if (below != nullptr) return false;
        value.key = key;
        tree.children.push_back(std::move(value));
        return true;
    }
    if (below != nullptr)
        return below->kind == Node::Kind::Table && plant(*below, path.substr(dot + 1), std::move(value));
    Node table;
    table.key = key;
    table.file = value.file;
    table.line = value.line;
    plant(table, path.substr(dot + 1), std::move(value));
    tree.children.push_back(std::move(table));
    return true;
}

std::string tomlString(const std::string& text) {
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') out += '\\';
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
            out += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
        else
            out += c;
    }
    return out + '"';
}

std::string valueText(const Node& value) {
    std::string list;
    switch (value.kind) {
        case Node::Kind::Boolean:
            return value.boolean ? "true" : "false";
        case Node::Kind::String:
            return tomlString(value.string);
        case Node::Kind::Array:
            for (const Node& item : value.children) list += (list.empty() ? "" : ", ") + valueText(item);
            return "[" + list + "]";
        case Node::Kind::Table:
            for (const Node& item : value.children)
                list += (list.empty() ? "" : ", ") + item.key + " = " + valueText(item);
            return "{" + list + "}";
        default:
            return value.text;
    }
}

std::string treeText(Node tree) {
    makePathsAbsolute(tree);
    std::string text;
    for (const Node& value : tree.children) text += value.key + " = " + valueText(value) + "\n";
    return text;
}

void merge(Node& lower, Node upper) {
    mergeAt(lower, std::move(upper), "");
}

}  // namespace vkdose
