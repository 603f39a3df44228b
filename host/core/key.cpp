#include "host/core/key.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

namespace vkdose {
namespace {

/// "plane[2]" and "plane[]" are both keys of "plane".
std::string withoutIndex(std::string_view path) {
    std::string plain;
    bool index = false;
    for (const char c : path) {
        if (c == '[') index = true;
        if (!index) plain += c;
        if (c == ']') index = false;
    }
    return plain;
}

/// Whether a table that is declared at `declared` may stand at `path`, both without indices. A part "A-B" of it stands
/// for any two names with a hyphen between them.
bool declares(std::string_view declared, std::string_view path) {
    while (true) {
        const std::size_t end = declared.find('.'), pathEnd = path.find('.');
        const std::string_view part = declared.substr(0, end), name = path.substr(0, pathEnd);
        if (part != name && !(part == kPairOfNames && name.find('-') != std::string_view::npos)) return false;
        if (end == std::string_view::npos || pathEnd == std::string_view::npos) return end == pathEnd;
        declared.remove_prefix(end + 1);
        path.remove_prefix(pathEnd + 1);
    }
}

std::string heading(std::string_view paths) {
    if (paths.empty()) return "At the top of the file";
    std::string text;
    for (const std::string& path : wordsOf(paths)) {
        const bool list = path.ends_with(']');
        const std::string name = withoutIndex(path);
        text += (text.empty() ? "" : ", ") + (list ? "`[[" + name + "]]`" : "`[" + name + "]`");
    }
    return text;
}

std::string defaultText(const Key& key) {
    const Default& d = key.standard;
    if (d.kind == Default::Kind::Required) return "required";
    if (d.kind == Default::Kind::Told) return std::string(d.text);
    switch (key.type) {
        case Key::Type::Boolean:
            return d.value[0] != 0 ? "`true`" : "`false`";
        case Key::Type::Word:
        case Key::Type::Text:
            return fmt::format("`\"{}\"`", d.text);
        case Key::Type::Vector:
            return fmt::format("[{}, {}, {}]", d.value[0], d.value[1], d.value[2]);
        default:
            return fmt::format("{}", d.value[0]);
    }
}

std::string allowedText(const Key& key) {
    std::string words;
    switch (key.type) {
        case Key::Type::Number:
            return key.bound == Bound::Positive ? "> 0" : key.bound == Bound::NonNegative ? "≥ 0" : "a number";
        case Key::Type::Integer:
            if (key.high == std::numeric_limits<std::int64_t>::max()) return fmt::format("whole, ≥ {}", key.low);
            return fmt::format("whole, {} to {}", key.low, key.high);
        case Key::Type::Boolean:
            return "`true`, `false`";
        case Key::Type::Word:
            for (const std::string& word : wordsOf(key.words))
                words += (words.empty() ? "" : ", ") + fmt::format("`\"{}\"`", word);
            return words;
        case Key::Type::Text:
            return "a string";
        case Key::Type::Vector:
            return "three numbers";
        case Key::Type::Other:
            return "";
    }
    return "";
}

}  // namespace

std::vector<std::string> wordsOf(std::string_view list) {
    std::istringstream stream{std::string(list)};
    std::vector<std::string> words;
    for (std::string word; stream >> word;) words.push_back(word);
    return words;
}

std::vector<const Key*> keysOf(std::span<const KeyTable> tables, std::string_view path) {
    const std::string wanted = withoutIndex(path);
    std::vector<const Key*> found;
    for (const KeyTable& table : tables) {
        const std::vector<std::string> paths = wordsOf(table.paths);
        const bool here = wanted.empty() ? paths.empty() : std::any_of(paths.begin(), paths.end(), [&](const auto& p) {
            return declares(withoutIndex(p), wanted);
        });
        if (!here) continue;
        for (const Key& key : table.keys)
            if (std::none_of(found.begin(), found.end(), [&](const Key* k) { return k->name == key.name; }))
                found.push_back(&key);
    }
    return found;
}

std::string keyReference(std::span<const KeyTable> tables) {
    std::string text;
    std::string above = "\n";  // no heading is that
    for (const KeyTable& table : tables) {
        const std::string title = heading(table.paths);
        if (title != above) text += fmt::format("{}### {}\n\n", text.empty() ? "" : "\n", title);
        if (title == above) text += "\n";
        above = title;
        if (!table.about.empty()) text += fmt::format("{}\n\n", table.about);
        if (table.keys.empty()) continue;
        text += "| key | unit | default | allowed | meaning |\n| --- | --- | --- | --- | --- |\n";
        for (const Key& key : table.keys)
            text += fmt::format("| `{}` | {} | {} | {} | {} |\n", key.name, key.unit.name, defaultText(key),
                                allowedText(key), key.meaning);
    }
    return text;
}

}  // namespace vkdose
