#pragma once
// Tables of columns. A type whose values are rows of a file has one constexpr table: for every column its name, its
// unit, its meaning and the member it shows. Header, CSV row, JSON, checkpoint record, reader and manual walk that
// table, so that a new column is one line in it.
//
//   inline constexpr auto kDoseColumns = columns(column<&Dose::index>("dose", "1", "Number of the dose, from 1."),
//   ...);

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <vector>

#include "host/core/csv_lines.h"

namespace vkdose {

/// Name, unit and meaning of a column, as manual and messages show them.
struct ColumnText {
    std::string name;
    std::string unit;  ///< "s", "kg"; "1" for a number without a unit, "" for a word
    std::string meaning;
};

/// An enumeration that tables show as a word. A specialisation gives the words as `names`, in the order of its values.
template <class E>
struct Words;

inline constexpr int kAllDigits = 0;  ///< as many digits as are needed to read the same number back

/// Goes from a row to the value that a column shows. Each step is a member, a member function or the index of an
/// element.
template <auto Step, auto... Rest, class R>
constexpr decltype(auto) follow(R&& row) {
    using S = decltype(Step);
    const auto next = [](auto&& part) -> decltype(auto) {
        if constexpr (std::is_member_function_pointer_v<S>)
            return (part.*Step)();
        else if constexpr (std::is_member_object_pointer_v<S>)
            return (part.*Step);
        else
            return (part[Step]);
    };
    if constexpr (sizeof...(Rest) == 0) {
        return next(row);
    } else if constexpr (std::is_lvalue_reference_v<decltype(next(row))>) {
        return follow<Rest...>(next(row));
    } else {  // a part of a value that a function returned is returned by value, because that value does not last
        const auto value = next(row);
        return std::decay_t<decltype(follow<Rest...>(value))>(follow<Rest...>(value));
    }
}

template <auto... Path>
struct Column {
    const char* name = "";
    const char* unit = "";     ///< as in ColumnText
    const char* meaning = "";  ///< one sentence
    int digits = 9;            ///< significant digits of a number that is not whole, or kAllDigits
    bool emptyIfNaN = false;   ///< a number that there is none of is an empty field; else it is "nan"

    /// Whether the value is computed from other members. It is then written, but neither stored nor read.
    static constexpr bool kComputed = (std::is_member_function_pointer_v<decltype(Path)> || ...);

    template <class R>
    static constexpr decltype(auto) of(R& row) {
        return follow<Path...>(row);
    }
};

/// The column of a member: column<&Sample::sensors, &Sensors::mass, 2>(name, unit, meaning).
template <auto... Path>
constexpr Column<Path...> column(const char* name, const char* unit, const char* meaning, int digits = 9) {
    return {name, unit, meaning, digits};
}

/// The same column, whose field is empty where there is no number.
template <auto... Path>
constexpr Column<Path...> emptyIfNaN(Column<Path...> c) {
    c.emptyIfNaN = true;
    return c;
}

template <class... C>
constexpr std::tuple<C...> columns(C... list) {
    return std::tuple<C...>(list...);
}

/// Turns a column of a type into a column of a type that holds the first as its member `Member`.
template <auto Member, auto... Path>
constexpr Column<Member, Path...> within(const Column<Path...>& c) {
    return {c.name, c.unit, c.meaning, c.digits, c.emptyIfNaN};
}
template <auto Member, class... C>
constexpr auto within(const std::tuple<C...>& table) {
    return std::apply([](const auto&... c) { return columns(within<Member>(c)...); }, table);
}

/// These columns of a table, in this order.
template <std::size_t... At, class... C>
constexpr auto picked(const std::tuple<C...>& table) {
    return columns(std::get<At>(table)...);
}

template <class... C, class Visit>
constexpr void forEachColumn(const std::tuple<C...>& table, Visit visit) {
    std::apply([&](const auto&... c) { (visit(c), ...); }, table);
}

template <class... C>
std::vector<ColumnText> columnTexts(const std::tuple<C...>& table) {
    std::vector<ColumnText> texts;
    forEachColumn(table, [&](const auto& c) { texts.push_back({c.name, c.unit, c.meaning}); });
    return texts;
}

template <class... C>
Row columnNames(const std::tuple<C...>& table) {
    Row names;
    forEachColumn(table, [&](const auto& c) { names.emplace_back(c.name); });
    return names;
}

/// "time_s,phase,dose"
template <class... C>
std::string csvHeader(const std::tuple<C...>& table) {
    return csvLine(columnNames(table));
}

/// A value as it stands in a table.
template <class T>
std::string cellText(const T& value, int digits) {
    if constexpr (std::is_enum_v<T>)
        return Words<T>::kNames.at(std::size_t(value));
    else if constexpr (std::is_same_v<T, bool>)
        return value ? "1" : "0";
    else if constexpr (std::is_floating_point_v<T>)
        return digits == kAllDigits ? fmt::format("{}", value) : fmt::format("{:.{}g}", value, digits);
    else
        return fmt::format("{}", value);
}

/// A row's field in a column.
template <auto... Path, class R>
std::string fieldText(const Column<Path...>& c, const R& row) {
    const auto& value = c.of(row);
    if constexpr (std::is_floating_point_v<std::decay_t<decltype(value)>>)
        if (c.emptyIfNaN && std::isnan(value)) return "";
    return cellText(value, c.digits);
}

/// "0.25,rest,3"
template <class... C, class R>
std::string csvRow(const std::tuple<C...>& table, const R& row) {
    std::string line;
    forEachColumn(table, [&](const auto& c) { line += "," + fieldText(c, row); });
    return line.substr(1);
}

/// Sets a value from the text in a table. Returns false if the text is not of the value's kind; a number is then NaN
/// or 0.
template <class T>
bool readCell(const std::string& text, T& value) {
    if constexpr (std::is_enum_v<T>) {
        const auto& names = Words<T>::kNames;
        for (std::size_t i = 0; i < names.size(); ++i) {
            if (names[i] != text) continue;
            value = T(i);
            return true;
        }
        return false;
    } else {
        const double number = numberIn(text);
        const bool whole = std::isfinite(number) && number >= 0;
        if constexpr (std::is_same_v<T, bool>)
            value = whole && number != 0;
        else if constexpr (std::is_floating_point_v<T>)
            value = number;
        else
            value = whole ? T(number) : T(0);
        return std::is_floating_point_v<T> ? !std::isnan(number) : whole;
    }
}

/// Sets a row from its texts, which `text(name)` gives. Calls `wrong(name)` for each text of a wrong kind.
template <class... C, class R, class Text, class Wrong>
void readRow(const std::tuple<C...>& table, R& row, const Text& text, const Wrong& wrong) {
    forEachColumn(table, [&](const auto& c) {
        if constexpr (!std::decay_t<decltype(c)>::kComputed)
            if (!readCell(text(c.name), c.of(row))) wrong(c.name);
    });
}

/// A row as numbers to store, in the table's order. One list holds whole numbers, words and booleans, the other the
/// remaining numbers.
struct StoredRow {
    std::vector<std::uint64_t> counts;
    std::vector<double> figures;
};

template <class... C, class R>
void store(const std::tuple<C...>& table, const R& row, StoredRow& into) {
    forEachColumn(table, [&](const auto& c) {
        if constexpr (!std::decay_t<decltype(c)>::kComputed) {
            if constexpr (std::is_floating_point_v<std::decay_t<decltype(c.of(row))>>)
                into.figures.push_back(c.of(row));
            else
                into.counts.push_back(static_cast<std::uint64_t>(c.of(row)));
        }
    });
}

/// How many numbers a row adds to each list of StoredRow.
template <class R, class... C>
StoredRow storedShape(const std::tuple<C...>& table) {
    StoredRow shape;
    store(table, R{}, shape);
    return shape;
}

/// Reads the row stored from these places on, and moves the places behind it.
template <class... C, class R>
void load(const std::tuple<C...>& table, R& row, const std::uint64_t*& counts, const double*& figures) {
    forEachColumn(table, [&](const auto& c) {
        if constexpr (!std::decay_t<decltype(c)>::kComputed) {
            auto& value = c.of(row);
            using T = std::decay_t<decltype(value)>;
            if constexpr (std::is_floating_point_v<T>)
                value = *figures++;
            else
                value = static_cast<T>(*counts++);
        }
    });
}

}  // namespace vkdose
