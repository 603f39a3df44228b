#pragma once
// Typed access to one table of a case.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "host/core/key.h"
#include "host/core/vec.h"
#include "host/model/case_tree.h"

namespace vkdose {

/// Bounds in SI on the numbers of a case and of a list of particles. Beyond them a unit or an exponent must be wrong.
/// Powers and ratios of numbers within them stay far from the limits of a double.
inline constexpr double kLargestNumber = 1e15;
inline constexpr double kSmallestNumber = 1e-15;  ///< for numbers that must be positive

class CaseReader;

/// One table of the case. Getters return SI values. If the file is at fault, they note the fault and return NaN (0,
/// ""). Later comparisons are written to be false for NaN, so that they do not report the same key again.
class Section {
  public:
    Section(CaseReader& reader, const Node* node, std::string path, bool broken)
        : reader_(reader), node_(node), path_(std::move(path)), broken_(broken) {}

    bool has(std::string_view key) const { return node_ != nullptr && node_->child(key) != nullptr; }
    bool isString(std::string_view key) const;
    std::string path(std::string_view key) const;
    const std::string& path() const { return path_; }

    /// Unit, bounds, words and default are those that the key was declared with (key.h). A `fallback` is a default that
    /// follows from other keys. It is in the unit of the file; NaN means that one of those other keys is at fault. A
    /// key that has neither a default nor a fallback must be in the file. An undeclared key throws std::logic_error.
    double number(std::string_view key, std::optional<double> fallback = std::nullopt);
    std::int64_t integer(std::string_view key);
    bool boolean(std::string_view key);
    std::string string(std::string_view key, std::optional<std::string> fallback = std::nullopt);
    /// Index of the chosen word. Returns nothing if the word is missing or is none of those to choose from.
    std::optional<std::size_t> choice(std::string_view key, std::optional<std::size_t> fallback = std::nullopt);
    /// Checks a key that holds either a number or one word (Key::orElse): a string must be that word. number() reads
    /// the number.
    void onlyWord(std::string_view key);
    Vec3 vector(std::string_view key, std::optional<Vec3> fallback = std::nullopt);

    /// A table inside this one. Every call returns the same object. If the file lacks the table, each of its keys takes
    /// its default or is missing.
    Section& table(std::string_view key);
    /// The same, but a missing table is one fault instead of one for each of its keys.
    Section& requiredTable(std::string_view key);
    /// The tables of [[key]]. Empty without the key.
    std::vector<Section*> tables(std::string_view key);
    /// One of the tables that `tables` gave.
    Section& item(std::string_view key, std::size_t index);

    /// The value as it is in the file, for kinds of values that no getter above reads. Null without the key.
    const Node* node(std::string_view key);

    /// Notes a value that was computed elsewhere (in the unit of the file) for the resolved case.
    void record(std::string_view key, double value);
    void record(std::string_view key, const Vec3& value);
    void record(std::string_view key, const std::string& value);
    void record(std::string_view key, const std::vector<double>& values);
    /// Leaves a key that was read out of the resolved case, which states what became of it.
    void forget(std::string_view key);
    /// To be called after a fault in the key that decides which keys belong here. From then on this table reports only
    /// misspelt known keys.
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
    bool broken_;  ///< the table's fault is already reported, so it reports no more
    bool abandoned_ = false;
    bool isItem_ = false;
    std::vector<std::string> known_;
    std::vector<std::pair<std::string, std::string>> used_;  ///< key and value for the resolved case
};

}  // namespace vkdose
