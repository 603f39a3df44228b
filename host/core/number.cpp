#include "host/core/number.h"

#include <fmt/format.h>

#include <charconv>

namespace vkdose {

namespace {

template <class Number>
std::optional<Number> whole(std::string_view text) {
    Number value{};
    const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (fault != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return value;
}

}  // namespace

std::optional<double> numberOf(std::string_view text) {
    return whole<double>(text);
}

std::optional<unsigned long long> wholeNumberOf(std::string_view text) {
    return whole<unsigned long long>(text);
}

double nearestDecimal(double value, int digits) {
    return numberOf(fmt::format("{:.{}g}", value, digits)).value_or(value);  // none: beyond the largest double
}

}  // namespace vkdose
