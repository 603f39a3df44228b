#pragma once
// Typed access to a case tree that collects every fault instead of stopping at the first, tells unknown keys by what
// was never asked for, and writes down each value it gave out: that record is the resolved case.

#include <cstdint>
#include <list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host/core/vec.h"
#include "host/model/case_tree.h"
#include "host/model/key.h"

namespace vkdose {

/// Beyond these, in SI, no number of a case or of a list of particles means anything: a unit or an exponent slipped.
/// Powers and ratios of what lies between stay far from the ends of a double.
inline constexpr double kLargestNumber = 1e15;
inline constexpr double kSmallestNumber = 1e-15;  ///< of what must be positive

class CaseReader;

/// One table of the case. Getters return SI; where the file is at fault they note it and return NaN (0, "") so that
/// later comparisons, written to be false for NaN, stay quiet about the same key.
class Section {
  public:
    Section(CaseReader& reader, const Node* node, std::string path, bool broken)
        : reader_(reader), node_(node), path_(std::move(path)), broken_(broken) {}

    bool has(std::string_view key) const { return node_ != nullptr && node_->child(key) != nullptr; }
    bool isString(std::string_view key) const;
    std::string path(std::string_view key) const;

    /// Unit, bounds, words and default are those that the key was declared with (key.h). A `fallback` stands for a
    /// default that follows from other keys; it is in the unit of the file (NaN: what it follows from is at fault). A
    /// key with neither must be there. An undeclared key throws std::logic_error.
    double number(std::string_view key, std::optional<double> fallback = std::nullopt);
    std::int64_t integer(std::string_view key);
    bool boolean(std::string_view key);
    std::string string(std::string_view key, std::optional<std::string> fallback = std::nullopt);
    /// Index of the chosen word; nothing when it is missing or not one of them.
    std::optional<std::size_t> choice(std::string_view key, std::optional<std::size_t> fallback = std::nullopt);
    /// The same for a key that takes only this word where it holds a string: its number is read by number().
    void onlyWord(std::string_view key, const std::string& word);
    Vec3 vector(std::string_view key, std::optional<Vec3> fallback = std::nullopt);

    /// A table inside this one, the same object at every call; when it is not there, all its keys take their defaults
    /// or are missing.
    Section& table(std::string_view key);
    /// The same, but a missing table is one fault instead of one for each of its keys.
    Section& requiredTable(std::string_view key);
    /// The tables of [[key]]; none when the key is absent.
    std::vector<Section*> tables(std::string_view key);

    /// The value as it stands, for what no getter above reads; null if there is none.
    const Node* node(std::string_view key);

    /// Notes a value worked out elsewhere (in the unit of the file) for the resolved case.
    void record(std::string_view key, double value);
    void record(std::string_view key, const Vec3& value);
    void record(std::string_view key, const std::string& value);
    /// After a fault that decides which keys belong here: no more faults from this table but misspelt known keys.
    void abandon() { broken_ = abandoned_ = true; }

    /// Marks a key as known without reading it.
    void know(std::string_view key) { known_.emplace_back(key); }

  private:
    friend class CaseReader;
    const Key& declared(std::string_view key) const;
    const Node* take(std::string_view key, bool required, const std::string& remedy);
    std::optional<std::size_t> chosen(std::string_view key, const std::vector<std::string>& words,
                                      std::optional<std::size_t> fallback);
    void fault(const Node& node, std::string_view key, std::string problem, std::string remedy);
    double checked(const Node& node, std::string_view key, Bound bound, Unit unit, const std::string& remedy);
    void write(std::string_view key, const std::string& value);
    void finish();

    CaseReader& reader_;
    const Node* node_;
    std::string path_;
    bool broken_;  ///< already reported; stay silent
    bool abandoned_ = false;
    bool isItem_ = false;
    std::vector<std::string> known_;
    std::vector<std::pair<std::string, std::string>> used_;  ///< key and value for the resolved case
};

class CaseReader {
  public:
    /// `tables` declare every key that the file may hold, and outlive the reader.
    CaseReader(std::string file, Node tree, std::span<const KeyTable> tables);

    Section& root() { return sections_.front(); }

    /// Reports a fault of the key at `path` ("coil.radius_mm"), at its line, or at its table's when it is a default.
    void fault(const std::string& path, std::string problem, std::string remedy);
    void add(Diagnostic fault) { faults_.push_back(std::move(fault)); }

    bool faulty() const { return !faults_.empty(); }
    /// Reports the keys nobody asked for. Call once, after reading.
    void finish();
    /// Throws CaseError when there are faults.
    void throwIfFaulty() const;

    /// The case as TOML, every key as it was used.
    std::string resolved() const;

    /// Folder against which the paths in the value at `path` are meant.
    std::filesystem::path folderOf(const std::string& path) const;

  private:
    friend class Section;
    const Node* find(const std::string& path, const Node** nearest) const;
    Section* opened(const std::string& path);
    Section& open(const Node* node, std::string path, bool broken);

    std::string file_;
    Node tree_;
    std::span<const KeyTable> tables_;
    std::list<Section> sections_;  ///< a list: references stay valid
    std::vector<Diagnostic> faults_;
};

/// The word of `known` that `word` was probably meant to be; empty when none is close.
std::string closestWord(std::string_view word, const std::vector<std::string>& known);

}  // namespace vkdose
