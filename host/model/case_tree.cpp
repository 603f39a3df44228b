#include "host/model/case_tree.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <utility>

#include "host/core/file.h"
#include "host/model/case_keys.h"
#include "host/model/parse_toml.h"
#include "host/model/powder_file.h"

namespace vkdose {
namespace {

std::string readText(const std::filesystem::path& file, const Diagnostic& whoAsks) {
    std::optional<std::string> text = fileContent(file);
    if (text) return *std::move(text);
    Diagnostic fault = whoAsks;
    fault.problem = unreadable(file);
    if (fault.file.empty()) fault = {file.string(), 0, "", "", readFault(file), fault.remedy};
    throw CaseError({fault});
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
    Node tree = parseToml(readText(file, whoAsks), file.string());
    const Node* base = tree.child("base");
    if (base == nullptr) {
        Node alone;
        layOver(alone, std::move(tree), above);
        return alone;
    }
    const Diagnostic place{base->file, base->line, "base",
                           base->text, "",         "give the path of a case file, relative to this one"};
    if (base->kind != Node::Kind::String) {
        Diagnostic fault = place;
        fault.problem = "must be a string";
        throw CaseError({fault});
    }
    Node lower = readWithBase(file.parent_path() / base->string, place, above);
    tree.drop("base");
    lower.drop("name");  // or two cases would share an output folder
    layOver(lower, std::move(tree), above);
    return lower;
}

/// Removes from `lower` the keys that keys of `upper` exclude, so that the upper layer wins. If it removes all of them,
/// what is missing afterwards is missing where the winner stands.
void dropRivals(Node& lower, const Node& upper, std::string_view path) {
    for (const Key* key : keysOf(caseKeys(), path)) {
        const Node* winner = upper.child(key->name);
        if (key->losers.empty() || winner == nullptr) continue;
        const Node* before = lower.child(key->name);
        const bool choice = key->type == Key::Type::Word, usual = key->standard.kind == Default::Kind::Value;
        const std::string_view was = before != nullptr ? before->string : usual ? key->standard.text : "";
        if (choice && (was.empty() || was == winner->string)) continue;
        for (const std::string& loser : wordsOf(key->losers)) {
            if (loser != "*") {
                lower.drop(loser);
                continue;
            }
            lower.children.clear();
            lower.file = winner->file;
            lower.line = winner->line;
        }
    }
}

/// What becomes of the keys of a lower layer that keys of an upper one exclude.
enum class Rivals { Drop, Keep };

void mergeAt(Node& lower, Node upper, const std::string& path, Rivals rivals);

/// The name of a table of a list, given or by default; empty if the tables of this list have none.
std::string nameOf(const Node& item, std::string_view path, std::size_t place) {
    const auto word = [&](std::string_view key) {
        const Node* value = item.child(key);
        return value != nullptr && value->kind == Node::Kind::String ? value->string : "";
    };
    if (item.child("name") != nullptr) return word("name");
    const std::vector<const Key*> keys = keysOf(caseKeys(), path);
    const auto find = [&](std::string_view name) {
        return std::find_if(keys.begin(), keys.end(), [&](const Key* key) { return key->name == name; });
    };
    const auto named = find("name");
    if (named == keys.end() || (*named)->followed.empty()) return "";
    const std::string kind = word((*named)->followed);
    const Default& usual = (*find((*named)->followed))->standard;
    if (usual.kind != Default::Kind::Value || (!kind.empty() && kind != usual.text)) return kind;
    return fmt::format("{}-{}", path.substr(path.rfind('.') + 1), place + 1);
}

/// A table over a list of tables changes those that it names: `body.gate.at` is a key of the [[body]] named gate.
void mergeNamed(Node& list, Node upper, const std::string& path, Rivals rivals) {
    for (Node& value : upper.children) {
        std::string names;
        Node* meant = nullptr;
        for (std::size_t k = 0; k < list.children.size(); ++k) {
            const std::string name = nameOf(list.children[k], path, k);
            if (name.empty()) continue;
            names += (names.empty() ? "" : ", ") + name;
            if (name == value.key) meant = &list.children[k];
        }
        if (meant == nullptr || value.kind != Node::Kind::Table)
            throw CaseError(
                {{value.file, value.line, path + "." + value.key, value.text,
                  fmt::format("is no table of the list [[{}]]", path),
                  names.empty() ? "give the whole list" : fmt::format("give a key of one of these: {}", names)}});
        const Node* given = meant->child("name");
        const std::optional<Node> name = given != nullptr ? std::optional(*given) : std::nullopt;
        mergeAt(*meant, std::move(value), path, rivals);
        // Another shape or kind removes all keys of the old one, but the name says which table this is.
        if (name && meant->child("name") == nullptr) meant->children.push_back(*name);
    }
}

void mergeAt(Node& lower, Node upper, const std::string& path, Rivals rivals) {
    if (rivals == Rivals::Drop) dropRivals(lower, upper, path);
    for (Node& value : upper.children) {
        Node* below = lower.child(value.key);
        const std::string at = path.empty() ? value.key : path + "." + value.key;
        if (below == nullptr)
            lower.children.push_back(std::move(value));
        else if (below->kind == Node::Kind::Table && value.kind == Node::Kind::Table)
            mergeAt(*below, std::move(value), at, rivals);
        else if (below->kind == Node::Kind::Array && value.kind == Node::Kind::Table)
            mergeNamed(*below, std::move(value), at, rivals);
        else
            *below = std::move(value);
    }
}

/// The keys whose values are paths, relative to the file that they stand in.
constexpr std::array<std::string_view, 4> kPathKeys{"list", "sieves", "mesh", "file"};

void makePathsAbsolute(Node& node) {
    for (Node& child : node.children) {
        const bool path = child.kind == Node::Kind::String &&
                          (std::find(kPathKeys.begin(), kPathKeys.end(), child.key) != kPathKeys.end() ||
                           (child.key == "law" && child.string.ends_with(".glsl")));
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
    if (std::optional<Node> tree = tomlTree(fmt::format("{} = {}", path, value), kCommandLine)) return *std::move(tree);
    if (!isBareWord(value)) {
        Diagnostic bad = fault;
        bad.problem = "is not a value";
        throw CaseError({bad});
    }
    return parseToml(fmt::format("{} = '{}'", path, value), kCommandLine);
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
    return parseToml(readText(file, {"", 0, "", "", "", "give the path of a file"}), file.string());
}

Node readTree(const std::filesystem::path& file, std::vector<std::filesystem::path>& files) {
    return readWithBase(file, {"", 0, "", "", "", "give the path of a case file"}, files);
}

Node readTreeText(const std::string& text, const std::string& name) {
    Node tree = parseToml(text, name);
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
            // Two overrides that exclude each other are a fault, which is reported later.
            Node override = overrideNode(trim(text.substr(0, equals)), trim(text.substr(equals + 1)));
            clearLines(override);
            mergeAt(all, std::move(override), "", Rivals::Keep);
        } catch (const CaseError& error) {
            faults.insert(faults.end(), error.faults().begin(), error.faults().end());
        }
    }
    if (!faults.empty()) throw CaseError(faults);
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
    mergeAt(lower, std::move(upper), "", Rivals::Drop);
}

}  // namespace vkdose
