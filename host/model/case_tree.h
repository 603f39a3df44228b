#pragma once
// A case file as a plain tree in which every value knows where it was written. TOML goes in; base files and
// overrides are merged here, before anything is interpreted.

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "host/core/error.h"

namespace vkdose {

struct Node {
    enum class Kind { Boolean, Integer, Float, String, Array, Table, Other };
    Kind kind = Kind::Table;
    bool boolean = false;
    std::int64_t integer = 0;
    double number = 0;  ///< the value of an Integer or a Float
    std::string string;
    std::vector<Node> children;  ///< of an Array or a Table

    std::string key;  ///< in the parent table; empty inside an array
    std::string file;
    int line = 0;
    std::string text;  ///< the value as written

    bool isNumber() const { return kind == Kind::Integer || kind == Kind::Float; }
    const Node* child(std::string_view name) const;
    Node* child(std::string_view name);
    void drop(std::string_view name);
};

/// Reads `file` alone, without its base: `base` is then a key like any other. Throws CaseError when the file cannot be
/// read or is not TOML.
Node readTreeAlone(const std::filesystem::path& file);

/// Reads `file` and, as the layer below it, the file that its key `base` names (relative to `file`). Throws CaseError
/// when a file cannot be read or is not TOML, and when bases form a circle. `files` receives the canonical paths of the
/// files that were read.
Node readTree(const std::filesystem::path& file, std::vector<std::filesystem::path>& files);

/// The same for a text; `name` stands for the file in messages. Throws CaseError when it is not TOML or has a base.
Node readTreeText(const std::string& text, const std::string& name);

/// The overrides "key.path=value" as one tree. A value that is not TOML but a bare word is a string.
/// Throws CaseError naming every override that cannot be read.
Node overrideTree(const std::vector<std::string>& overrides);

/// Whether `path` can name a key: words of letters, digits, _ and -, joined by dots.
bool isKeyPath(std::string_view path);

/// Puts `value` at `path` ("coil.speed_rpm") and makes the tables on the way to it. If there is already a value at the
/// path or on the way, nothing changes and the result is false.
bool plant(Node& tree, const std::string& path, Node value);

/// A text as a TOML string, and a value as TOML on one line. Numbers stay as they were written.
std::string tomlString(const std::string& text);
std::string valueText(const Node& value);

/// The tree as TOML that `readTreeText` reads from any folder: the paths of files that it names are absolute.
std::string treeText(Node tree);

/// Lays `upper` over `lower`, table by table. A table over a list of tables, as in `body.gate.at`, changes the one of
/// that name, or throws CaseError. A key of `upper` also removes the keys in `lower` that it excludes:
/// `pitch_mm` removes `turns`, and another `distribution` removes the keys of the old one.
void merge(Node& lower, Node upper);

}  // namespace vkdose
