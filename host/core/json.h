#pragma once
// Numbers as JSON, and rows by the table of their columns.

#include <cmath>
#include <nlohmann/json.hpp>
#include <span>
#include <tuple>
#include <type_traits>

#include "host/core/columns.h"

namespace vkdose {

/// JSON knows no infinity and no NaN. Such a figure is written as null.
inline nlohmann::ordered_json jsonNumber(double x) {
    return std::isfinite(x) ? nlohmann::ordered_json(x) : nlohmann::ordered_json(nullptr);
}

/// A list of numbers; null for those that are not finite.
inline nlohmann::ordered_json jsonNumbers(std::span<const double> values) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const double x : values) list.push_back(jsonNumber(x));
    return list;
}

/// A figure that there is none of unless it is above 0, as the closed form of a device without one.
inline nlohmann::ordered_json jsonPositive(double x) {
    return x > 0 ? jsonNumber(x) : nlohmann::ordered_json(nullptr);
}

/// A value of a row: a number, a word, true or false.
template <class T>
nlohmann::ordered_json jsonValue(const T& x) {
    if constexpr (std::is_enum_v<T>)
        return cellText(x, kAllDigits);
    else if constexpr (std::is_floating_point_v<T>)
        return jsonNumber(x);
    else
        return x;
}

/// Puts the columns of a row into `object`, by their names.
template <class... C, class R>
void putColumns(const std::tuple<C...>& table, const R& row, nlohmann::ordered_json& object) {
    forEachColumn(table, [&](const auto& c) { object[c.name] = jsonValue(c.of(row)); });
}

}  // namespace vkdose
