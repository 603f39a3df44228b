#include "host/app/measures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

#include "host/app/backends.h"
#include "host/core/number.h"
#include "host/core/printable.h"
#include "host/core/vec.h"

namespace vkdose {

namespace {

struct UnitName {
    std::string_view name;
    double inSI;
};

/// The units of a kind, the usual ones first, and the bounds between which a value makes sense [SI].
struct Kind {
    std::vector<UnitName> units;
    double least, most;
};

const Kind& kindOf(Measure measure) {
    static const Kind kLength{
        {{"mm", 1e-3}, {"cm", 1e-2}, {"m", 1.0}, {"um", 1e-6}, {"\u00b5m", 1e-6}, {"\u03bcm", 1e-6}}, 1e-7, 10};
    static const Kind kMass{{{"g", 1e-3}, {"mg", 1e-6}, {"kg", 1.0}}, 1e-9, 1e5};
    static const Kind kDensity{
        {{"kg/m3", 1.0}, {"g/cm3", 1e3}, {"g/l", 1.0}, {"g/ml", 1e3}, {"kg/l", 1e3}, {"kg/m\u00b3", 1.0}}, 1, 3e4};
    static const Kind kSpeed{{{"rpm", 2 * kPi / 60}, {"1/min", 2 * kPi / 60}}, 1e-4, 1e4};
    static const Kind kTime{{{"s", 1.0}, {"ms", 1e-3}, {"min", 60.0}}, 1e-4, 1e5};
    static const Kind kWallTime{{{"s", 1.0}, {"min", 60.0}, {"h", 3600.0}}, 1e-3, 1e8};
    switch (measure) {
        case Measure::Length:
            return kLength;
        case Measure::Mass:
            return kMass;
        case Measure::Density:
            return kDensity;
        case Measure::Speed:
            return kSpeed;
        case Measure::WallTime:
            return kWallTime;
        default:
            return kTime;
    }
}

std::string withoutBlanks(const std::string& text) {
    std::string out;
    for (const char c : text)
        if (c != ' ' && c != '\t') out += c;
    return out;
}

[[noreturn]] void refuse(const std::string& name, const std::string& text, const std::string& why,
                         const std::string& example) {
    throw UsageError(fmt::format("{} {}: {}; write {}", name, printable(text), why, example));
}

/// The number at the front of `left`, which loses it. A point parts the decimals; a comma is refused, because some
/// write it for thousands.
double takeNumber(std::string_view& left, const std::string& name, const std::string& text,
                  const std::string& example) {
    double value = 0;
    const auto [end, fault] = std::from_chars(left.data(), left.data() + left.size(), value);
    if (fault != std::errc() || !std::isfinite(value))
        refuse(name, text, left.empty() ? "a number is missing" : "is not a measure", example);
    left.remove_prefix(static_cast<std::size_t>(end - left.data()));
    if (!left.empty() && left.front() == ',') refuse(name, text, "a decimal point is meant, not a comma", example);
    if (!(value > 0)) refuse(name, text, "must be more than 0", example);
    return value;
}

std::string unitList(const Kind& kind) {
    std::string list;
    for (const UnitName& u : kind.units)
        if (std::all_of(u.name.begin(), u.name.end(), [](char c) { return c > 0; }))
            list += (list.empty() ? "" : ", ") + std::string(u.name);
    return list;
}

double factorOf(const Kind& kind, std::string_view unit, const std::string& name, const std::string& text,
                const std::string& example) {
    for (const UnitName& u : kind.units)
        if (u.name == unit) return u.inSI;
    refuse(name, text, fmt::format("{} is no unit of it (these are: {})", unit, unitList(kind)), example);
}

double withDigits(double value, int digits, double (*round)(double)) {
    if (value == 0 || !std::isfinite(value)) return value;
    const int exponent = static_cast<int>(std::floor(std::log10(std::abs(value)))) - digits + 1;
    // Up to a part in 10^9 a number counts as the round one that it was computed from.
    const double scaled = value / std::pow(10.0, exponent), near = std::round(scaled);
    const double whole = std::abs(scaled - near) < 1e-9 * std::abs(scaled) ? near : round(scaled);
    return numberOf(fmt::format("{}e{}", whole, exponent)).value_or(value);
}

}  // namespace

std::vector<double> measuresOf(Measure kind, const std::string& name, const std::string& text, char separator,
                               const std::string& example) {
    const Kind& all = kindOf(kind);
    const std::string plain = withoutBlanks(text);
    std::string_view left = plain;
    std::vector<double> values;
    std::vector<double> factors;  // 0: the unit comes later
    for (;;) {
        values.push_back(takeNumber(left, name, text, example));
        // Units of lengths and masses hold no separator, and those of densities stand alone.
        const std::size_t end = separator == '\0' ? left.size() : std::min(left.find(separator), left.size());
        const std::string_view unit = left.substr(0, end);
        factors.push_back(unit.empty() ? 0 : factorOf(all, unit, name, text, example));
        if (end == left.size()) break;
        left.remove_prefix(end + 1);
    }
    if (factors.back() == 0) refuse(name, text, fmt::format("lacks the unit ({})", unitList(all)), example);
    for (std::size_t i = values.size(); i-- > 0;) {
        if (factors[i] == 0) factors[i] = factors[i + 1];
        values[i] *= factors[i];
        if (values[i] < all.least || values[i] > all.most)
            refuse(name, text,
                   fmt::format("{} is too {} to be meant", values.size() > 1 ? "one of these" : "it",
                               values[i] < all.least ? "small" : "large"),
                   example);
    }
    return values;
}

double measureOf(Measure kind, const std::string& name, const std::string& text, const std::string& example) {
    return measuresOf(kind, name, text, '\0', example).front();
}

int countOf(const std::string& name, const std::string& text, int most, const std::string& example) {
    const std::string plain = withoutBlanks(text);
    int value = 0;
    const auto [end, fault] = std::from_chars(plain.data(), plain.data() + plain.size(), value);
    if (fault != std::errc() || end != plain.data() + plain.size() || value < 1 || value > most)
        refuse(name, text, fmt::format("is not a whole number from 1 to {}", most), example);
    return value;
}

std::string figureText(double value, int digits) {
    return fmt::format("{}", rounded(value, digits));
}

std::string lengthText(double metres) {
    return metres < 1e-4 ? figureText(metres * 1e6) + " um" : figureText(metres * 1e3) + " mm";
}

std::string massText(double kilograms) {
    if (kilograms >= 1) return figureText(kilograms) + " kg";
    return kilograms < 1e-4 ? figureText(kilograms * 1e6) + " mg" : figureText(kilograms * 1e3) + " g";
}

double rounded(double value, int digits) {
    return withDigits(value, digits, [](double x) { return std::round(x); });
}
double roundedUp(double value, int digits) {
    return withDigits(value, digits, [](double x) { return std::ceil(x); });
}
double roundedDown(double value, int digits) {
    return withDigits(value, digits, [](double x) { return std::floor(x); });
}

}  // namespace vkdose
