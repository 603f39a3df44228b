#include "host/model/case_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace vkdose {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// Shortest text that reads back as the same double.
std::string numeral(double value) {
    return fmt::format("{}", value);
}

std::string numeral(const Vec3& v) {
    return fmt::format("[{}, {}, {}]", v.x, v.y, v.z);
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

/// Levenshtein distance: single-character insertions, deletions and substitutions.
std::size_t editDistance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t above = row[j];
            const std::size_t change = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
            row[j] = std::min({above + 1, row[j - 1] + 1, change});
            diagonal = above;
        }
    }
    return row[b.size()];
}

}  // namespace

std::string closestWord(std::string_view word, const std::vector<std::string>& known) {
    std::string best;
    std::size_t bestDistance = std::max<std::size_t>(2, word.size() / 3) + 1;
    for (const std::string& candidate : known) {
        const std::size_t distance = editDistance(word, candidate);
        if (distance < bestDistance) {
            best = candidate;
            bestDistance = distance;
        }
    }
    if (!best.empty()) return best;
    // Finds "radius_mm" for "radius" and "coil_speed" for "speed": a unit or a qualifier was left out or added.
    for (const std::string& candidate : known)
        if (word.size() >= 3 &&
            (candidate.find(word) != std::string::npos || word.find(candidate) != std::string::npos))
            return candidate;
    return "";
}

// ---- Section ------------------------------------------------------------------------------------------------------

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
    reader_.fault(path(key), "the table is missing", fmt::format("add [{}]", path(key)));
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

// ---- CaseReader ---------------------------------------------------------------------------------------------------

CaseReader::CaseReader(std::string file, Node tree, std::span<const KeyTable> tables)
    : file_(std::move(file)), tree_(std::move(tree)), tables_(tables) {
    open(&tree_, "", false);
}

Section* CaseReader::opened(const std::string& path) {
    const auto found =
        std::find_if(sections_.begin(), sections_.end(), [&](const Section& s) { return s.path_ == path; });
    return found == sections_.end() ? nullptr : &*found;
}

Section& CaseReader::open(const Node* node, std::string path, bool broken) {
    return sections_.emplace_back(*this, node, std::move(path), broken);
}

const Node* CaseReader::find(const std::string& path, const Node** nearest) const {
    const Node* node = &tree_;
    *nearest = node;
    for (std::size_t start = 0; start <= path.size();) {
        const std::size_t end = std::min(path.find('.', start), path.size());
        std::string name = path.substr(start, end - start);
        const std::size_t bracket = name.find('[');
        const std::size_t index = bracket == std::string::npos ? 0 : std::stoul(name.substr(bracket + 1));
        name = name.substr(0, bracket);
        node = node->child(name);
        if (node != nullptr && bracket != std::string::npos) node = &node->children[index];
        if (node == nullptr) return nullptr;
        *nearest = node;
        start = end + 1;
    }
    return node;
}

void CaseReader::fault(const std::string& path, std::string problem, std::string remedy) {
    const Node* nearest = nullptr;
    const Node* node = find(path, &nearest);
    const std::string file = nearest == &tree_ ? file_ : nearest->file;
    add({file, nearest->line, path, node == nullptr ? "" : node->text, std::move(problem), std::move(remedy)});
}

void CaseReader::finish() {
    for (Section& section : sections_) section.finish();
}

void CaseReader::throwIfFaulty() const {
    if (faults_.empty()) return;
    std::vector<Diagnostic> sorted = faults_;
    std::stable_sort(sorted.begin(), sorted.end(), [](const Diagnostic& a, const Diagnostic& b) {
        return a.file != b.file ? a.file < b.file : a.line < b.line;
    });
    throw CaseError(std::move(sorted));
}

std::string CaseReader::resolved() const {
    std::string text;
    const auto write = [&](const Section& section) {
        if (section.used_.empty()) return;
        std::string path = section.path_;
        if (const std::size_t index = path.find('['); index != std::string::npos)
            path.erase(index, path.find(']') + 1 - index);
        if (section.isItem_)
            text += fmt::format("\n[[{}]]\n", path);
        else if (!path.empty())
            text += fmt::format("\n[{}]\n", path);
        for (const auto& [key, value] : section.used_) text += fmt::format("{} = {}\n", key, value);
    };
    for (const Section& section : sections_) {
        const bool inItem = section.path_.find("].") != std::string::npos;
        if (inItem) continue;
        write(section);
        if (!section.isItem_) continue;
        // A table inside an item belongs to the item that stands before it.
        for (const Section& inside : sections_)
            if (inside.path_.starts_with(section.path_ + ".")) write(inside);
    }
    return text;
}

std::filesystem::path CaseReader::folderOf(const std::string& path) const {
    const Node* nearest = nullptr;
    const Node* node = find(path, &nearest);
    if (node == nullptr || node->file == kCommandLine) return {};
    return std::filesystem::path(node->file).parent_path();
}

}  // namespace vkdose
