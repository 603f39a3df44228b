#include "host/model/parse_toml.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cctype>
#include <utility>
#include <vector>

#include "host/core/number.h"

namespace vkdose {
namespace {

/// TOML text being converted: its name for messages and its lines, to show a value as it was written.
struct Source {
    std::string name;
    std::vector<std::string> lines;
    /// The column sought last and its byte. A search begins there, so that a long line is gone through once.
    mutable std::size_t line = 0, column = 1, byte = 0;
};

Source makeSource(std::string name, const std::string& text) {
    Source source;
    source.name = std::move(name);
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) source.lines.push_back(line);
    return source;
}

/// Byte at which a column of toml++ begins. (toml++ counts columns in characters.)
std::size_t byteOf(const Source& source, std::size_t line, std::size_t column) {
    const std::string& text = source.lines[line - 1];
    if (source.line != line || column < source.column) {
        source.line = line;
        source.column = 1;
        source.byte = 0;
    }
    std::size_t& at = source.byte;
    for (; at < text.size() && source.column < column; ++source.column) {
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
    const std::size_t first = byteOf(source, line, region.begin.column);
    std::string value = text.substr(first, byteOf(source, line, region.end.column) - first);
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

/// A case has some dozen keys in a table, and a list some dozen tables. Each is sought among the others.
constexpr std::size_t kMostTogether = 2000;

void requireFew(const char* what, std::size_t count, const toml::node& from, const Source& source,
                const std::string& key) {
    if (count <= kMostTogether) return;
    throw CaseError({{source.name, static_cast<int>(from.source().begin.line), key, "",
                      fmt::format("has {} {}, and may have {}", count, what, kMostTogether), "give fewer"}});
}

Node convert(const toml::node& from, const Source& source, std::string key) {
    Node node;
    node.key = std::move(key);
    node.file = source.name;
    node.line = static_cast<int>(from.source().begin.line);
    if (const toml::table* table = from.as_table()) {
        node.kind = Node::Kind::Table;
        requireFew("keys", table->size(), from, source, node.key);
        for (const auto& [name, value] : *table)
            node.children.push_back(convert(value, source, std::string(name.str())));
        // Keep the order of the file, not of the alphabet, so that faults are reported from top to bottom.
        std::stable_sort(node.children.begin(), node.children.end(),
                         [](const Node& a, const Node& b) { return a.line < b.line; });
    } else if (const toml::array* array = from.as_array()) {
        node.kind = Node::Kind::Array;
        if (array->is_array_of_tables()) requireFew("tables", array->size(), from, source, node.key);
        node.text = written(from.source(), source);
        for (const toml::node& value : *array) node.children.push_back(convert(value, source, ""));
    } else {
        node.text = written(from.source(), source);
        setScalar(node, from);
    }
    return node;
}

/// Largest number of dots in the keys of a line. The parser works by recursion, one level for every part of a dotted
/// key and for every bracket. It limits the brackets itself (256). With this limit on the dots, the deepest text stays
/// far from the end of the stack.
constexpr int kMostDots = 64;
/// Longest text that is read. A case is only a few kilobytes long.
constexpr std::size_t kMostBytes = 1U << 20U;

/// Whether a dot between two digits is that of a number. A key of digits may be dotted too, and has other dots beside.
bool isOfNumber(const std::string& text, std::size_t dot) {
    std::size_t first = dot, behind = dot + 1;
    while (first > 0 && isDigit(text[first - 1])) --first;
    while (behind < text.size() && isDigit(text[behind])) ++behind;
    return first < dot && behind > dot + 1 && (first == 0 || text[first - 1] != '.') &&
           (behind == text.size() || text[behind] != '.');
}

/// The first line in whose keys there are more than `most` dots; 0 without such a line. Dots in strings, comments and
/// numbers do not count: the text of a law is one long string, a list of sizes one long line of numbers.
int lineOfManyDots(const std::string& text, int most) {
    int line = 1, dots = 0;
    char quote = 0;      // of the string in which `i` is
    bool multi = false;  // that string may have several lines
    const auto three = [&](std::size_t i) { return text.compare(i, 3, std::string(3, text[i])) == 0; };
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (c == '\n') {
            ++line;
            dots = 0;
            if (!multi) quote = 0;
        } else if (quote == '"' && c == '\\' && i + 1 < text.size() && text[i + 1] != '\n') {
            ++i;
        } else if (quote != 0) {
            if (c != quote || (multi && !three(i))) continue;
            if (multi)
                for (i += 2; i + 1 < text.size() && text[i + 1] == quote;) ++i;  // it may end with quotes of its own
            quote = 0;
            multi = false;
        } else if (c == '"' || c == '\'') {
            quote = c;
            multi = three(i);
            if (multi) i += 2;
        } else if (c == '#') {
            i = std::min(text.find('\n', i), text.size()) - 1;
        } else if (c == '.' && !isOfNumber(text, i) && ++dots > most) {
            return line;
        }
    }
    return 0;
}

/// Refuses a text that cannot be a case before the parser sees it.
void requirePlain(const std::string& text, const std::string& name) {
    const char* remedy = "give the path of a case file";
    if (text.size() > kMostBytes)
        throw CaseError({{name, 0, "", "", fmt::format("not a case: {} MiB long", text.size() >> 20U), remedy}});
    if (const int line = lineOfManyDots(text, kMostDots); line > 0)
        throw CaseError({{name, line, "", "",
                          fmt::format("not a case: more than {} dots in the keys of a line", kMostDots), remedy}});
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

/// Throws CaseError when the text is too large to be a case, and toml::parse_error when it is not TOML.
Node parsed(const std::string& text, const std::string& name) {
    requirePlain(text, name);
    const toml::table table = toml::parse(text, name);
    Node node = convert(table, makeSource(name, text), "");
    node.line = 0;
    return node;
}

}  // namespace

Node parseToml(const std::string& text, const std::string& name) {
    try {
        return parsed(text, name);
    } catch (const toml::parse_error& error) {
        throw CaseError({syntaxFault(error, text, name)});
    }
}

std::optional<Node> tomlTree(const std::string& text, const std::string& name) {
    try {
        return parsed(text, name);
    } catch (const toml::parse_error&) {
        return std::nullopt;
    }
}

}  // namespace vkdose
