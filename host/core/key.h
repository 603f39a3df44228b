#pragma once
// A key of a case or study file, declared once: the reader reads by the declaration, and `vkdose manual keys` lists it.

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host/core/vec.h"

namespace vkdose {

/// Unit of a key in the file: value in the file = value in SI * perSI.
struct Unit {
    double perSI;
    const char* name;
};
inline constexpr Unit kPlain{1, ""};
inline constexpr Unit kMetre{1, "m"};
inline constexpr Unit kSecond{1, "s"};
inline constexpr Unit kMillimetre{1e3, "mm"};
inline constexpr Unit kMicrometre{1e6, "um"};
inline constexpr Unit kGram{1e3, "g"};
inline constexpr Unit kRpm{60 / (2 * kPi), "rpm"};
inline constexpr Unit kDegree{180 / kPi, "degrees"};
inline constexpr Unit kKilogramPerCubicMetre{1, "kg/m3"};

enum class Bound { Any, NonNegative, Positive };
inline constexpr Bound kNonNegative = Bound::NonNegative;
inline constexpr Bound kPositive = Bound::Positive;

/// The value of a key that a file leaves out.
struct Default {
    enum class Kind {
        Required,  ///< there is none: the key must be given
        Value,     ///< always the same, in the unit of the file
        Told,      ///< follows from other keys: the reader computes it, and `text` says how
    };
    Kind kind = Kind::Required;
    std::array<double, 3> value{};  ///< of a number, a whole number, a boolean or a vector
    std::string_view text;          ///< a word, a text, or how the value follows
};
inline constexpr Default kRequired{};
constexpr Default told(std::string_view how) {
    return {Default::Kind::Told, {}, how};
}

struct Key {
    enum class Type { Number, Integer, Boolean, Word, Text, Vector, Other };

    std::string_view name{};
    Type type = Type::Number;
    Unit unit = kPlain;
    Bound bound = Bound::Any;                                      ///< of a number
    std::int64_t low = 0;                                          ///< of a whole number
    std::int64_t high = std::numeric_limits<std::int64_t>::max();  ///< of a whole number
    std::string_view words{};                                      ///< the words to choose from, separated by blanks
    Default standard{};                                            ///< the value of a key that is not given
    std::string_view meaning{};                                    ///< for the manual, in Markdown
    std::string_view orWord{};                                     ///< a word that may stand in place of a number
    std::string_view orEnding{};                                   ///< of other texts that may stand in place of a word
    /// Keys and tables of a lower layer that this one removes, separated by blanks; "*": all of its table.
    std::string_view losers{};
    /// Of a `name`: the key whose word is the name of a table of a list without one. A word that is the default of
    /// that key names none: the table is `field-1` then, by the list and its place.
    std::string_view followed{};

    /// Returns this key, of a number, with the addition that `word` may stand in its place.
    constexpr Key orElse(std::string_view word) const {
        Key key = *this;
        key.orWord = word;
        return key;
    }

    /// Returns this key, of a word, with the addition that any text with this ending may stand in its place.
    constexpr Key orEndingIn(std::string_view ending) const {
        Key key = *this;
        key.orEnding = ending;
        return key;
    }

    /// Returns this key with the addition that, in an upper layer (a case over its base, --set), it removes the keys
    /// `others` of the same table from the lower layer. A word removes them only if it differs from the lower layer's
    /// word, or from the default where there is none, because they belong to the old choice.
    constexpr Key replacing(std::string_view others) const {
        Key key = *this;
        key.losers = others;
        return key;
    }

    /// Returns this key, a `name`, with the addition that the word of the key `other` is its default.
    constexpr Key following(std::string_view other) const {
        Key key = *this;
        key.followed = other;
        return key;
    }
};

namespace key {

constexpr Key number(std::string_view name, Unit unit, Bound bound, Default standard, std::string_view meaning) {
    return {.name = name, .unit = unit, .bound = bound, .standard = standard, .meaning = meaning};
}
/// `standard` in the unit of the file.
constexpr Key number(std::string_view name, Unit unit, Bound bound, double standard, std::string_view meaning) {
    return number(name, unit, bound, Default{Default::Kind::Value, {standard}, ""}, meaning);
}
constexpr Key integer(std::string_view name, std::int64_t low, std::int64_t high, Default standard,
                      std::string_view meaning) {
    return {
        .name = name, .type = Key::Type::Integer, .low = low, .high = high, .standard = standard, .meaning = meaning};
}
constexpr Key integer(std::string_view name, std::int64_t low, std::int64_t high, std::int64_t standard,
                      std::string_view meaning) {
    return integer(name, low, high, Default{Default::Kind::Value, {static_cast<double>(standard)}, ""}, meaning);
}
constexpr Key boolean(std::string_view name, bool standard, std::string_view meaning) {
    return {.name = name,
            .type = Key::Type::Boolean,
            .standard = {Default::Kind::Value, {standard ? 1.0 : 0.0}, ""},
            .meaning = meaning};
}
/// `words` separated by blanks, in the order of the reader's enumeration.
constexpr Key word(std::string_view name, std::string_view words, Default standard, std::string_view meaning) {
    return {.name = name, .type = Key::Type::Word, .words = words, .standard = standard, .meaning = meaning};
}
constexpr Key word(std::string_view name, std::string_view words, std::string_view standard, std::string_view meaning) {
    return word(name, words, Default{Default::Kind::Value, {}, standard}, meaning);
}
constexpr Key text(std::string_view name, Default standard, std::string_view meaning) {
    return {.name = name, .type = Key::Type::Text, .standard = standard, .meaning = meaning};
}
constexpr Key text(std::string_view name, std::string_view standard, std::string_view meaning) {
    return text(name, Default{Default::Kind::Value, {}, standard}, meaning);
}
constexpr Key vector(std::string_view name, Unit unit, Default standard, std::string_view meaning) {
    return {.name = name, .type = Key::Type::Vector, .unit = unit, .standard = standard, .meaning = meaning};
}
constexpr Key vector(std::string_view name, Unit unit, std::array<double, 3> standard, std::string_view meaning) {
    return vector(name, unit, Default{Default::Kind::Value, standard, ""}, meaning);
}
/// A value that no getter of `Section` reads.
constexpr Key other(std::string_view name, Default standard, std::string_view meaning) {
    return {.name = name, .type = Key::Type::Other, .standard = standard, .meaning = meaning};
}

}  // namespace key

/// The keys of one table of a file, or of several tables with the same keys.
struct KeyTable {
    std::string_view
        paths;  ///< "contact contact.wall"; "": the top of the file; "plane[]": each [[plane]]; kPairOfNames
    std::span<const Key> keys;
    std::string_view about;  ///< for the manual, in Markdown; may be empty
};

/// A part of a path that stands for two names with a hyphen between them: "contact.A-B" is each [contact.cocoa-sugar].
inline constexpr std::string_view kPairOfNames = "A-B";

/// The words of a list that is separated by blanks.
std::vector<std::string> wordsOf(std::string_view list);

/// The keys of the table at `path` ("coil", "plane[2]"), each once.
std::vector<const Key*> keysOf(std::span<const KeyTable> tables, std::string_view path);

/// The tables as Markdown: a heading and a table of the keys for each.
std::string keyReference(std::span<const KeyTable> tables);

}  // namespace vkdose
