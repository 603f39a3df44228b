#include "host/model/section.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "host/core/closest_word.h"
#include "host/model/case_reader.h"

namespace vkdose {
namespace {

/// Shortest text that reads back as the same double; "-0" is a whole number, which has no sign at 0.
std::string numeral(double value) {
    return value == 0 && std::signbit(value) ? "-0.0" : fmt::format("{}", value);
}

std::string numeral(const Vec3& v) {
    return fmt::format("[{}, {}, {}]", numeral(v.x), numeral(v.y), numeral(v.z));
}

std::string kindName(Node::Kind kind) {
    switch (kind) {
        case Node::Kind::Boolean:
            return "a boolean";
        case Node::Kind::Integer:
            return "a whole number";
        case Node::Kind::Float:
            return "a number";
        case Node::Kind::String:
            return "a string";
        case Node::Kind::Array:
            return "an array";
        case Node::Kind::Table:
            return "a table";
        case Node::Kind::Other:
            return "a date or time";
    }
    return "something else";
}

std::string listed(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
    return text;
}

std::string numberRemedy(Bound bound, Unit unit) {
    std::string text = "give a number";
    if (bound == Bound::Positive) text += " > 0";
    if (bound == Bound::NonNegative) text += " >= 0";
    if (*unit.name != '\0') text += fmt::format(" [{}]", unit.name);
    return text;
}

}  // namespace

std::string Section::path(std::string_view key) const {
    return path_.empty() ? std::string(key) : fmt::format("{}.{}", path_, key);
}

bool Section::isString(std::string_view key) const {
    const Node* node = node_ == nullptr ? nullptr : node_->child(key);
    return node != nullptr && node->kind == Node::Kind::String;
}

void Section::fault(const Node& node, std::string_view key, std::string problem, std::string remedy) {
    reader_.add({node.file, node.line, path(key), node.text, std::move(problem), std::move(remedy)});
}

const Node* Section::take(std::string_view key, bool required, const std::string& remedy) {
    know(key);
    const Node* node = node_ == nullptr ? nullptr : node_->child(key);
    if (node == nullptr && required && !broken_) reader_.fault(path(key), "is missing", remedy);
    return node;
}

void Section::write(std::string_view key, const std::string& value) {
    for (auto& [known, text] : used_) {
        if (known != key) continue;
        text = value;
        return;
    }
    used_.emplace_back(key, value);
}

double Section::checked(const Node& node, std::string_view key, Bound bound, Unit unit, const std::string& remedy) {
    std::string problem;
    if (!node.isNumber())
        problem = fmt::format("is {}, not a number", kindName(node.kind));
    else if (!std::isfinite(node.number))
        problem = "is not a finite number";
    else if (bound != Bound::Any && node.number < 0)
        problem = "is negative";
    else if (bound == Bound::Positive && node.number == 0)
        problem = "is zero";
    else if (std::abs(node.number / unit.perSI) > kLargestNumber)
        problem = "is larger than anything in a canister";
    else if (bound == Bound::Positive && node.number / unit.perSI < kSmallestNumber)
        problem = "is smaller than anything in a canister";
    if (problem.empty()) return node.number;
    fault(node, key, problem, remedy);
    return kNaN;
}

const Key& Section::declared(std::string_view key) const {
    for (const Key* declared : keysOf(reader_.tables_, path_))
        if (declared->name == key) return *declared;
    throw std::logic_error(fmt::format("the key {} is read but not declared", path(key)));
}

double Section::number(std::string_view key, std::optional<double> fallback) {
    const Key& k = declared(key);
    if (!fallback && k.standard.kind == Default::Kind::Value) fallback = k.standard.value[0];
    const std::string remedy = numberRemedy(k.bound, k.unit);
    const Node* node = take(key, !fallback, remedy);
    double value = fallback.value_or(kNaN);
    if (node != nullptr) value = checked(*node, key, k.bound, k.unit, remedy);
    if (std::isfinite(value)) write(key, numeral(value));
    return value / k.unit.perSI;
}

std::int64_t Section::integer(std::string_view key) {
    const Key& k = declared(key);
    const bool required = k.standard.kind != Default::Kind::Value;
    std::string remedy = fmt::format("give a whole number >= {}", k.low);
    if (k.high != std::numeric_limits<std::int64_t>::max()) remedy += fmt::format(" and <= {}", k.high);
    const Node* node = take(key, required, remedy);
    std::int64_t value = required ? k.low : static_cast<std::int64_t>(k.standard.value[0]);
    if (node != nullptr && node->kind != Node::Kind::Integer) {
        fault(*node, key, fmt::format("is {}, not a whole number", kindName(node->kind)), remedy);
    } else if (node != nullptr && node->integer < k.low) {
        fault(*node, key, node->integer < 0 ? "is negative" : "is too small", remedy);
    } else if (node != nullptr && node->integer > k.high) {
        fault(*node, key, "is too large", remedy);
    } else {
        if (node != nullptr) value = node->integer;
        write(key, fmt::format("{}", value));
    }
    return value;
}

bool Section::boolean(std::string_view key) {
    const Node* node = take(key, false, "");
    bool value = declared(key).standard.value[0] != 0;
    if (node != nullptr && node->kind != Node::Kind::Boolean)
        fault(*node, key, fmt::format("is {}, not a boolean", kindName(node->kind)), "give true or false");
    else if (node != nullptr)
        value = node->boolean;
    write(key, value ? "true" : "false");
    return value;
}

std::string Section::string(std::string_view key, std::optional<std::string> fallback) {
    const Default& standard = declared(key).standard;
    if (!fallback && standard.kind == Default::Kind::Value) fallback = std::string(standard.text);
    const std::string remedy = "give a string";
    const Node* node = take(key, !fallback, remedy);
    std::string value = fallback.value_or("");
    if (node != nullptr && node->kind != Node::Kind::String)
        fault(*node, key, fmt::format("is {}, not a string", kindName(node->kind)), remedy);
    else if (node != nullptr)
        value = node->string;
    write(key, tomlString(value));
    return value;
}

std::optional<std::size_t> Section::choice(std::string_view key, std::optional<std::size_t> fallback) {
    const Key& k = declared(key);
    const std::vector<std::string> words = wordsOf(k.words);
    const auto standard = std::find(words.begin(), words.end(), k.standard.text);
    if (!fallback && k.standard.kind == Default::Kind::Value)
        fallback = static_cast<std::size_t>(standard - words.begin());
    return chosen(key, words, fallback);
}

void Section::onlyWord(std::string_view key) {
    chosen(key, {std::string(declared(key).orWord)}, std::nullopt);
}

std::optional<std::size_t> Section::chosen(std::string_view key, const std::vector<std::string>& words,
                                           std::optional<std::size_t> fallback) {
    const std::string remedy = fmt::format("give one of {}", listed(words));
    const Node* node = take(key, !fallback, remedy);
    std::optional<std::size_t> index = fallback;
    if (node != nullptr) {
        index.reset();
        const auto found = std::find(words.begin(), words.end(), node->string);
        if (node->kind != Node::Kind::String) {
            fault(*node, key, fmt::format("is {}, not a string", kindName(node->kind)), remedy);
        } else if (found == words.end()) {
            const std::string meant = closestWord(node->string, words);
            fault(*node, key, "is not known",
                  meant.empty() ? remedy : fmt::format("did you mean \"{}\"? ({})", meant, listed(words)));
        } else {
            index = static_cast<std::size_t>(found - words.begin());
        }
    }
    if (index) write(key, tomlString(words[*index]));
    return index;
}

Vec3 Section::vector(std::string_view key, std::optional<Vec3> fallback) {
    const Default& standard = declared(key).standard;
    if (!fallback && standard.kind == Default::Kind::Value)
        fallback = Vec3(standard.value[0], standard.value[1], standard.value[2]);
    const std::string remedy = "give three numbers: [x, y, z]";
    const Node* node = take(key, !fallback, remedy);
    Vec3 value = fallback.value_or(Vec3(kNaN));
    if (node != nullptr && (node->kind != Node::Kind::Array || node->children.size() != 3)) {
        fault(*node, key, "is not an array of three numbers", remedy);
        return Vec3(kNaN);
    }
    for (glm::length_t axis = 0; node != nullptr && axis < 3; ++axis) {
        const Node& item = node->children[static_cast<std::size_t>(axis)];
        value[axis] = item.isNumber() ? item.number : kNaN;
        const bool finite = std::isfinite(value[axis]);
        if (finite && std::abs(value[axis]) <= kLargestNumber) continue;
        fault(*node, key,
              fmt::format("{} is {}", item.text.empty() ? "an entry" : item.text,
                          finite ? "larger than anything in a canister" : "not a finite number"),
              remedy);
        return Vec3(kNaN);
    }
    if (std::isfinite(value.x)) write(key, numeral(value));
    return value;
}

Section& Section::table(std::string_view key) {
    if (Section* before = reader_.opened(path(key))) return *before;
    const Node* node = take(key, false, "");
    bool broken = broken_;
    if (node != nullptr && node->kind != Node::Kind::Table) {
        fault(*node, key, fmt::format("is {}, not a table", kindName(node->kind)),
              fmt::format("write [{}]", path(key)));
        node = nullptr;
        broken = true;
    }
    return reader_.open(node, path(key), broken);
}

Section& Section::requiredTable(std::string_view key) {
    if (has(key) || broken_ || reader_.opened(path(key)) != nullptr) return table(key);
    std::string header = path(key);  // in an item of a list it stands without the item's index
    if (const std::size_t index = header.find('['); index != std::string::npos)
        header.erase(index, header.find(']') + 1 - index);
    reader_.fault(path(key), "the table is missing", fmt::format("add [{}]", header));
    know(key);
    return reader_.open(nullptr, path(key), true);
}

std::vector<Section*> Section::tables(std::string_view key) {
    const Node* node = take(key, false, "");
    std::vector<Section*> found;
    if (node == nullptr) return found;
    const bool good =
        node->kind == Node::Kind::Array && std::all_of(node->children.begin(), node->children.end(),
                                                       [](const Node& n) { return n.kind == Node::Kind::Table; });
    if (!good) {
        fault(*node, key, "is not a list of tables", fmt::format("write [[{}]] above each", path(key)));
        return found;
    }
    for (std::size_t i = 0; i < node->children.size(); ++i) {
        Section& item = reader_.open(&node->children[i], fmt::format("{}[{}]", path(key), i), broken_);
        item.isItem_ = true;
        found.push_back(&item);
    }
    return found;
}

Section& Section::item(std::string_view key, std::size_t index) {
    return *reader_.opened(fmt::format("{}[{}]", path(key), index));
}

const Node* Section::node(std::string_view key) {
    return take(key, false, "");
}

void Section::record(std::string_view key, double value) {
    write(key, numeral(value));
}
void Section::record(std::string_view key, const Vec3& value) {
    write(key, numeral(value));
}
void Section::record(std::string_view key, const std::string& value) {
    write(key, tomlString(value));
}

void Section::record(std::string_view key, const std::vector<double>& values) {
    std::vector<std::string> items;
    for (const double value : values) items.push_back(numeral(value));
    write(key, "[" + listed(items) + "]");
}

void Section::forget(std::string_view key) {
    std::erase_if(used_, [&](const auto& entry) { return entry.first == key; });
}

void Section::finish() {
    if (node_ == nullptr) return;
    for (const Node& child : node_->children) {
        if (std::find(known_.begin(), known_.end(), child.key) != known_.end()) continue;
        const std::string meant = closestWord(child.key, known_);
        if (abandoned_ && meant.empty()) continue;  // the key may belong to the choice that could not be read
        const bool isTable = child.kind == Node::Kind::Table;
        std::vector<std::string> sorted = known_;
        std::sort(sorted.begin(), sorted.end());
        sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
        fault(child, child.key, isTable ? "unknown table" : "unknown key",
              meant.empty() ? fmt::format("known here: {}", listed(sorted)) : fmt::format("did you mean {}?", meant));
    }
}

}  // namespace vkdose
