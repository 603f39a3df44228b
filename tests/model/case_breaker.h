#pragma once
// Breaks a case file, which has its values on a line each, in every way that is certainly wrong. What a key may be,
// the tables here say.

#include <cctype>
#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "tests/model/mutants.h"

namespace vkdose::test {

/// A line `key = value # comment` taken apart.
struct Entry {
    std::size_t line;
    std::string header;
    std::string key;
    std::string value;
    bool zero() const { return number() && std::stod(value) == 0; }
    bool number() const { return std::string("+-.0123456789").find(value[0]) != std::string::npos; }
    bool string() const { return value[0] == '"'; }
    bool array() const { return value[0] == '['; }
};

inline std::vector<Entry> entriesOf(const std::vector<std::string>& lines) {
    std::vector<Entry> entries;
    std::string header;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        if (lines[i][0] == '[') header = lines[i].substr(0, lines[i].find(']') + 1);
        const std::size_t equals = lines[i].find(" = ");
        if (equals == std::string::npos || std::isalpha(static_cast<unsigned char>(lines[i][0])) == 0) continue;
        std::string value = lines[i].substr(equals + 3);
        value = value[0] == '"' ? value.substr(0, value.find('"', 1) + 1) : value.substr(0, value.find('#'));
        value.erase(value.find_last_not_of(' ') + 1);
        entries.push_back({i, header, lines[i].substr(0, equals), value});
    }
    return entries;
}

inline bool among(const std::string& key, const std::set<std::string>& keys) {
    return keys.count(key) == 1;
}

/// Any sign is right for these; a number in any other key is a size, a ratio or a duration.
inline const std::set<std::string> kSigned{"z_start_mm", "start_angle_deg"};
/// Zero is right for these as well.
inline const std::set<std::string> kMayBeZero{"z_start_mm", "start_angle_deg",  "kc_over_k",        "plasticity_depth",
                                              "damping",    "friction",         "rolling_friction", "speed_rpm",
                                              "time_s",     "rotate_s",         "rest_s",           "threshold_g",
                                              "seed",       "torsion_friction", "damping_t_ratio",  "damping_r_ratio"};
/// Tables in which zero is right for every number.
inline const std::set<std::string> kZeroTables{"[frames]"};
/// Keys that choose among words.
inline const std::set<std::string> kWords{"boundaries", "distribution", "coulomb_limit", "floor",
                                          "rule",       "hand",         "kernel"};
/// Keys that take a word or a number.
inline const std::set<std::string> kWordOrNumber{"bulk_density"};
/// Keys without which no case of theirs is complete.
inline const std::set<std::string> kRequired{"density",
                                             "distribution",
                                             "k",
                                             "k1_over_k",
                                             "damping",
                                             "length_mm",
                                             "width_mm",
                                             "height_mm",
                                             "outlet_diameter_mm",
                                             "throat_length_mm",
                                             "wire_diameter_mm",
                                             "speed_rpm",
                                             "radius_min_mm",
                                             "radius_max_mm",
                                             "radius_mean_mm",
                                             "point",
                                             "normal",
                                             "base",
                                             "axis"};

class Breaker {
  public:
    Breaker(const std::string& text, std::uint32_t seed)
        : text_(text), lines_(linesOf(text)), entries_(entriesOf(lines_)), choice_(seed) {}

    std::vector<Mutant> all() {
        for (const Entry& e : entries_) {
            keys(e);
            values(e);
            syntax(e);
        }
        for (std::size_t i = 0; i < lines_.size(); ++i)
            if (lines_[i][0] == '[') headers(i);
        bytes();
        return std::move(mutants_);
    }

  private:
    void add(const std::string& kind, std::string text, std::string culprit, std::size_t line) {
        mutants_.push_back({kind, std::move(text), std::move(culprit), static_cast<int>(line) + 1});
    }
    void value(const Entry& e, const std::string& kind, const std::string& now) {
        add(kind, withLine(lines_, e.line, e.key + " = " + now), e.key, e.line);
    }

    void keys(const Entry& e) {
        std::string name = e.key;  // no key of a case holds a q
        name.insert(choice_.below(name.size() + 1), "q");
        add("a key nobody knows", withLine(lines_, e.line, name + " = " + e.value), name, e.line);
        std::vector<std::string> twice = lines_;
        twice.insert(twice.begin() + static_cast<std::ptrdiff_t>(e.line) + 1, lines_[e.line]);
        add("a key given twice, which TOML forbids", joined(twice), "", e.line + 1);
        // A [[plane]] and [[cylinder]] of their own have the same keys; here each required key stands in its table.
        if (among(e.key, kRequired)) {
            std::vector<std::string> without = lines_;
            without.erase(without.begin() + static_cast<std::ptrdiff_t>(e.line));
            mutants_.push_back({"a required key taken out", joined(without), e.key, 0});
        }
    }

    void values(const Entry& e) {
        static const std::vector<std::string> notNumber{"\"word\"", "true",     "[1, 2]", "{ a = 1 }", "2024-01-01",
                                                        "[[1.0]]",  "12:30:00", "[]",     "\"\"",      "\"1.0\""};
        static const std::vector<std::string> notString{"7", "true", "[\"a\"]", "1.5", "{ a = \"b\" }"};
        static const std::vector<std::string> notVector{
            "3",           "\"up\"",        "[1, 2]",      "[1, 2, 3, 4]",  "[0, nan, 0]",
            "[inf, 0, 0]", "[\"0\", 0, 0]", "[[0, 1, 0]]", "[1e300, 0, 0]", "[]"};
        static const std::vector<std::string> notFinite{"nan", "inf", "-inf", "+nan"};
        static const std::vector<std::string> beyond{"1e300", "1.7e308", "1e30"};
        if (e.string()) {
            const bool numberToo = among(e.key, kWordOrNumber);
            value(e, "another type where a string belongs", numberToo ? "true" : choice_.of(notString));
            if (among(e.key, kWords)) value(e, "a word that is none of the choices", "\"qx\"");
        } else if (e.array()) {
            value(e, "no three finite numbers", choice_.of(notVector));
            value(e, "no three finite numbers", choice_.of(notVector));
        } else if (e.number()) {
            value(e, "another type where a number belongs", choice_.of(notNumber));
            value(e, "another type where a number belongs", choice_.of(notNumber));
            value(e, "a number that is not finite", choice_.of(notFinite));
            value(e, "a number no unit makes sense of", choice_.of(beyond));
            if (!among(e.key, kSigned) && !e.zero()) value(e, "a negative size", "-" + e.value);
            if (among(e.key, kMayBeZero) || among(e.header, kZeroTables)) return;
            value(e, "a size of zero", "0");
            value(e, "a size below every unit", "5e-324");
        } else {
            value(e, "another type where a boolean belongs", "\"yes\"");
        }
    }

    void syntax(const Entry& e) {
        const auto line = [&](const std::string& kind, const std::string& now) {
            add(kind, withLine(lines_, e.line, now), "", e.line);
        };
        switch (choice_.below(4)) {
            case 0:
                line("a key without a value", e.key + " = ");
                break;
            case 1:
                line("no equals sign", e.key + " " + e.value);
                break;
            case 2:
                line("two values on a line", e.key + " = " + e.value + " 5");
                break;
            default:
                line("a stray bracket", e.key + " = " + e.value + " ]");
        }
        const std::vector<std::string> before(lines_.begin(), lines_.begin() + static_cast<std::ptrdiff_t>(e.line));
        add("a file cut off after an equals sign", joined(before) + e.key + " =", "", e.line);
        if (e.string()) line("a string without its end", e.key + " = " + e.value.substr(0, e.value.size() - 1));
        if (e.array()) line("an array whose comma is a semicolon", e.key + " = [1; 2; 3]");
    }

    void headers(std::size_t i) {
        const bool list = lines_[i][1] == '[';
        const std::string name = lines_[i].substr(list ? 2 : 1, lines_[i].find(']') - (list ? 2 : 1));
        const auto header = [&](const std::string& kind, const std::string& now, const std::string& culprit) {
            add(kind, withLine(lines_, i, now), culprit, i);
        };
        header("a header without its end", "[" + name, "");
        // A table in an item of a list is named with the item's index.
        header("a table nobody knows", "[" + name + "q]", name.substr(name.find_last_of('.') + 1) + "q");
        if (list) {
            header("one table where a list belongs", "[" + name + "]", name);
        } else {
            header("a list where one table belongs", "[[" + name + "]]", name.substr(0, name.find('.')));
            std::vector<std::string> twice = lines_;
            twice.push_back("[" + name + "]");
            add("a table given twice, which TOML forbids", joined(twice), "", lines_.size());
        }
    }

    /// TOML is UTF-8 without control characters, comments included.
    void bytes() {
        static const std::vector<std::string> bad{"\xff", "\xc3(",   "\xed\xa0\x80", "\xf5\x80\x80\x80",
                                                  "\x80", "\xc0\x80"};
        static const std::vector<std::string> control{std::string(1, '\0'), "\x01", "\x1b", "\x7f"};
        for (int n = 0; n < 12; ++n) {
            std::string text = text_;
            text.insert(choice_.below(text.size()), choice_.of(bad));
            mutants_.push_back({"bytes that are not UTF-8", text, "not TOML", 0});
        }
        for (const std::string& c : control) {
            const Entry& e = choice_.of(entries_);
            add("a control character", withLine(lines_, e.line, e.key + c + " = " + e.value), "", e.line);
            add("a control character in a string", withLine(lines_, 0, "name = \"a" + c + "b\""), "", 0);
        }
        std::string wide = "\xff\xfe";
        for (const char c : text_) wide += std::string{c, '\0'};
        mutants_.push_back({"UTF-16", wide, "not TOML", 0});
        mutants_.push_back({"no text at all", std::string(4096, '\x7f') + text_, "not TOML", 1});
    }

    std::string text_;
    std::vector<std::string> lines_;
    std::vector<Entry> entries_;
    Choice choice_;
    std::vector<Mutant> mutants_;
};

}  // namespace vkdose::test
