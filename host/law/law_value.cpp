#include "host/law/law_value.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>

namespace vkdose {
namespace {

constexpr double kTwo32 = 4294967296.0, kTwo31 = 2147483648.0;

/// A whole number as 32 bits hold it.
double wrapped(double x, LawBase base) {
    if (!std::isfinite(x)) return 0;
    double rest = std::fmod(std::trunc(x), kTwo32);
    if (rest < 0) rest += kTwo32;
    return base == LawBase::Int && rest >= kTwo31 ? rest - kTwo32 : rest;
}

double asBase(double x, LawBase to) {
    switch (to) {
        case LawBase::Float:
            return x;
        case LawBase::Bool:
            return x != 0 ? 1 : 0;
        default:
            return wrapped(x, to);
    }
}

/// The base that both sides of an operation become.
LawBase commonBase(LawBase a, LawBase b) {
    if (a == LawBase::Float || b == LawBase::Float) return LawBase::Float;
    if (a == LawBase::Uint || b == LawBase::Uint) return LawBase::Uint;
    return a;
}

/// The element of a value, of a scalar always the same.
double at(const LawValue& v, std::size_t k) {
    return v.type.isScalar() ? v[0] : v[k];
}

template <class F>
LawValue eachOf(const LawValue& a, const LawValue& b, LawBase base, const F& f) {
    LawValue result;
    result.type = a.type.isScalar() ? b.type : a.type;
    result.type.base = base;
    for (std::size_t k = 0; k < result.type.size(); ++k) result.x[k] = f(at(a, k), at(b, k));
    return result;
}

/// Divisions of whole numbers have a result on every device (cases/laws/README.md).
double divided(double x, double y, LawBase base) {
    if (base == LawBase::Float) return x / y;
    if (y == 0 || (base == LawBase::Int && x == -kTwo31 && y == -1)) return x;
    return std::trunc(x / y);
}

double remainder(double x, double y, LawBase base) {
    if (y == 0 || (base == LawBase::Int && x == -kTwo31 && y == -1)) return 0;
    return x - y * std::trunc(x / y);
}

double multiplied(double x, double y, LawBase base) {
    if (base == LawBase::Float) return x * y;
    // 64 bits hold what 32 keep of a product.
    const auto a = std::uint64_t(std::int64_t(x)), b = std::uint64_t(std::int64_t(y));
    return wrapped(double((a * b) & 0xffffffffU), base);
}

LawValue arithmetic(char sign, const LawValue& a, const LawValue& b) {
    const LawBase base = commonBase(a.type.base, b.type.base);
    return eachOf(a, b, base, [&](double x, double y) {
        switch (sign) {
            case '+':
                return asBase(x + y, base);
            case '-':
                return asBase(x - y, base);
            case '*':
                return multiplied(x, y, base);
            case '/':
                return divided(x, y, base);
            default:
                return remainder(x, y, base);
        }
    });
}

/// The product of linear algebra, in which a vector on the left is a row.
LawValue matrixProduct(const LawValue& a, const LawValue& b) {
    const bool row = !a.type.isMatrix(), column = !b.type.isMatrix();
    const std::size_t rows = row ? 1 : a.type.rows, inner = b.type.rows, columns = column ? 1 : b.type.columns;
    LawValue result;
    result.type = {LawBase::Float, std::uint8_t(row ? columns : rows), std::uint8_t(row || column ? 1 : columns)};
    for (std::size_t c = 0; c < columns; ++c)
        for (std::size_t r = 0; r < rows; ++r)
            for (std::size_t k = 0; k < inner; ++k) result.x[c * rows + r] += a[k * rows + r] * b[c * inner + k];
    return result;
}

double ofBits(std::string_view sign, double x, double y, LawBase base) {
    const auto a = std::uint32_t(std::int64_t(x)), b = std::uint32_t(std::int64_t(y));
    const auto of = [&](std::uint32_t bits) { return wrapped(double(bits), base); };
    if (sign == "&") return of(a & b);
    if (sign == "|") return of(a | b);
    if (sign == "^") return of(a ^ b);
    if (b > 31) return 0;  // the language leaves it open
    if (sign == "<<") return of(a << b);
    return base == LawBase::Int ? double(std::int32_t(a) >> b) : of(a >> b);
}

LawValue truth(bool is) {
    return lawNumber(is ? 1 : 0, LawBase::Bool);
}

bool same(const LawValue& a, const LawValue& b) {
    return std::equal(a.x.begin(), a.x.begin() + std::ptrdiff_t(a.type.size()), b.x.begin());
}

using Arguments = std::span<const LawValue>;
using Numbers1 = double (*)(double);
using Numbers2 = double (*)(double, double);

double dotOf(const LawValue& a, const LawValue& b) {
    double sum = 0;
    for (std::size_t k = 0; k < a.type.size(); ++k) sum += a[k] * b[k];
    return sum;
}

double stepAt(double edge, double x) {
    return x < edge ? 0 : 1;
}

double signOf(double x) {
    return x > 0 ? 1 : x < 0 ? -1 : 0;
}

/// Halves go to the even number.
double roundedEven(double x) {
    return x - std::remainder(x, 1.0);
}

const std::map<std::string_view, Numbers1> kOfOne{
    {"abs", [](double x) { return std::abs(x); }},
    {"sign", signOf},
    {"floor", [](double x) { return std::floor(x); }},
    {"ceil", [](double x) { return std::ceil(x); }},
    {"trunc", [](double x) { return std::trunc(x); }},
    {"round", roundedEven},
    {"fract", [](double x) { return x - std::floor(x); }},
    {"sqrt", [](double x) { return std::sqrt(x); }},
    {"inversesqrt", [](double x) { return 1 / std::sqrt(x); }},
    {"exp", [](double x) { return std::exp(x); }},
    {"log", [](double x) { return std::log(x); }},
    {"exp2", [](double x) { return std::exp2(x); }},
    {"log2", [](double x) { return std::log2(x); }},
    {"sin", [](double x) { return std::sin(x); }},
    {"cos", [](double x) { return std::cos(x); }},
    {"tan", [](double x) { return std::tan(x); }},
    {"asin", [](double x) { return std::asin(x); }},
    {"acos", [](double x) { return std::acos(x); }},
    {"atan", [](double x) { return std::atan(x); }},
    {"sinh", [](double x) { return std::sinh(x); }},
    {"cosh", [](double x) { return std::cosh(x); }},
    {"tanh", [](double x) { return std::tanh(x); }},
    {"asinh", [](double x) { return std::asinh(x); }},
    {"acosh", [](double x) { return std::acosh(x); }},
    {"atanh", [](double x) { return std::atanh(x); }},
    {"radians", [](double x) { return x * (3.14159265358979323846 / 180); }},
    {"degrees", [](double x) { return x * (180 / 3.14159265358979323846); }},
};

const std::map<std::string_view, Numbers2> kOfTwo{
    {"mod", [](double x, double y) { return x - y * std::floor(x / y); }},
    {"min", [](double x, double y) { return y < x ? y : x; }},
    {"max", [](double x, double y) { return x < y ? y : x; }},
    {"step", stepAt},
    {"pow", [](double x, double y) { return std::pow(x, y); }},
    {"atan", [](double y, double x) { return std::atan2(y, x); }},
};

const std::map<std::string_view, bool (*)(double, double)> kComparisons{
    {"equal", [](double x, double y) { return x == y; }},
    {"notEqual", [](double x, double y) { return x != y; }},
    {"lessThan", [](double x, double y) { return x < y; }},
    {"lessThanEqual", [](double x, double y) { return x <= y; }},
    {"greaterThan", [](double x, double y) { return x > y; }},
    {"greaterThanEqual", [](double x, double y) { return x >= y; }},
};

LawValue cross(const LawValue& a, const LawValue& b) {
    LawValue result;
    result.type = a.type;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t n = (k + 1) % 3, m = (k + 2) % 3;
        result.x[k] = a[n] * b[m] - a[m] * b[n];
    }
    return result;
}

LawValue mixed(Arguments v) {
    LawValue result = v[0].type.isScalar() ? v[1] : v[0];
    const bool chosen = v[2].type.base == LawBase::Bool;
    for (std::size_t k = 0; k < result.type.size(); ++k) {
        const double x = at(v[0], k), y = at(v[1], k), a = at(v[2], k);
        result.x[k] = chosen ? (a != 0 ? y : x) : x * (1 - a) + y * a;
    }
    return result;
}

LawValue smoothStep(Arguments v) {
    LawValue result = v[2];
    for (std::size_t k = 0; k < result.type.size(); ++k) {
        const double t = std::clamp((at(v[2], k) - at(v[0], k)) / (at(v[1], k) - at(v[0], k)), 0.0, 1.0);
        result.x[k] = t * t * (3 - 2 * t);
    }
    return result;
}

/// Functions whose result is one number, or a vector as a whole.
LawValue ofVectors(std::string_view name, Arguments v) {
    const auto length = [](const LawValue& a) { return std::sqrt(dotOf(a, a)); };
    if (name == "dot") return lawNumber(dotOf(v[0], v[1]));
    if (name == "length") return lawNumber(length(v[0]));
    if (name == "distance") return lawNumber(length(combined("-", v[0], v[1])));
    if (name == "normalize") return combined("/", v[0], lawNumber(length(v[0])));
    if (name == "cross") return cross(v[0], v[1]);
    const auto begin = v[0].x.begin(), end = begin + std::ptrdiff_t(v[0].type.size());
    const auto holds = [](double x) { return x != 0; };
    if (name == "any") return truth(std::any_of(begin, end, holds));
    if (name == "all") return truth(std::all_of(begin, end, holds));
    return v[0];
}

/// Whole numbers become floats where a function takes floats alone.
LawBase baseOf(std::string_view name, const LawBase base) {
    const bool keeps = name == "abs" || name == "sign" || name == "min" || name == "max";
    return keeps ? base : LawBase::Float;
}

}  // namespace

LawType lawTypeOf(std::string_view name) {
    if (name == "Contact") return {LawBase::Float, 4, 1};
    if (name == "int") return {LawBase::Int, 1, 1};
    if (name == "uint") return {LawBase::Uint, 1, 1};
    if (name == "bool") return {LawBase::Bool, 1, 1};
    const auto size = static_cast<std::uint8_t>(name.back() - '0');
    if (name.starts_with("mat")) return {LawBase::Float, size, size};
    if (name.starts_with("vec")) return {LawBase::Float, size, 1};
    if (name.starts_with("ivec")) return {LawBase::Int, size, 1};
    if (name.starts_with("uvec")) return {LawBase::Uint, size, 1};
    if (name.starts_with("bvec")) return {LawBase::Bool, size, 1};
    return {};
}

LawValue lawNumber(double x, LawBase base) {
    LawValue v;
    v.type.base = base;
    v.x[0] = x;
    return v;
}

LawValue converted(const LawValue& v, LawType to) {
    LawValue result = v;
    result.type = to;
    for (std::size_t k = 0; k < to.size(); ++k) result.x[k] = asBase(v[k], to.base);
    return result;
}

LawValue constructed(LawType to, std::span<const LawValue> from) {
    LawValue result;
    result.type = to;
    const bool single = from.size() == 1;
    if (single && to.isMatrix() && (from[0].type.isScalar() || from[0].type.isMatrix())) {
        for (std::size_t c = 0; c < to.columns; ++c)
            for (std::size_t r = 0; r < to.rows; ++r) {
                const LawValue& v = from[0];
                const bool within = v.type.isMatrix() && r < v.type.rows && c < v.type.columns;
                result.x[c * to.rows + r] = within ? v[c * v.type.rows + r] : r != c ? 0 : v.type.isScalar() ? v[0] : 1;
            }
        return result;
    }
    std::size_t next = 0;
    if (single && from[0].type.isScalar())
        for (; next < to.size(); ++next) result.x[next] = asBase(from[0][0], to.base);
    for (const LawValue& v : from)
        for (std::size_t k = 0; k < v.type.size() && next < to.size(); ++k) result.x[next++] = asBase(v[k], to.base);
    return result;
}

LawValue combined(std::string_view sign, const LawValue& a, const LawValue& b) {
    if (sign == "*" && (a.type.isMatrix() || b.type.isMatrix()) && !a.type.isScalar() && !b.type.isScalar())
        return matrixProduct(a, b);
    if (sign.size() == 1 && std::string_view("+-*/%").find(sign) != std::string_view::npos)
        return arithmetic(sign.front(), a, b);
    if (sign == "==" || sign == "!=") return truth(same(a, b) == (sign == "=="));
    if (sign == "^^") return truth(a.isTrue() != b.isTrue());
    if (sign == "<") return truth(a[0] < b[0]);
    if (sign == ">") return truth(a[0] > b[0]);
    if (sign == "<=") return truth(a[0] <= b[0]);
    if (sign == ">=") return truth(a[0] >= b[0]);
    const bool shifts = sign == "<<" || sign == ">>";
    const LawBase base = shifts ? a.type.base : commonBase(a.type.base, b.type.base);
    return eachOf(a, b, base, [&](double x, double y) { return ofBits(sign, x, y, base); });
}

LawValue turnedBy(std::string_view sign, const LawValue& a) {
    LawValue result = a;
    if (sign == "+") return result;
    for (std::size_t k = 0; k < a.type.size(); ++k)
        result.x[k] = sign == "-"   ? asBase(-a[k], a.type.base)
                      : sign == "!" ? double(a[k] == 0)
                                    : wrapped(double(~std::uint32_t(std::int64_t(a[k]))), a.type.base);
    return result;
}

LawValue lawFunction(std::string_view name, std::span<const LawValue> v) {
    if (v.size() == 1) {
        if (name == "isnan" || name == "isinf") {
            const bool nan = name == "isnan";
            return eachOf(v[0], v[0], LawBase::Bool,
                          [&](double x, double) { return double(nan ? std::isnan(x) : std::isinf(x)); });
        }
        if (name == "not") return turnedBy("!", v[0]);
        if (const auto f = kOfOne.find(name); f != kOfOne.end())
            return eachOf(v[0], v[0], baseOf(name, v[0].type.base), [&](double x, double) { return f->second(x); });
        return ofVectors(name, v);
    }
    if (v.size() == 2) {
        const LawBase base = baseOf(name, commonBase(v[0].type.base, v[1].type.base));
        if (const auto f = kOfTwo.find(name); f != kOfTwo.end()) return eachOf(v[0], v[1], base, f->second);
        if (const auto f = kComparisons.find(name); f != kComparisons.end())
            return eachOf(v[0], v[1], LawBase::Bool, [&](double x, double y) { return double(f->second(x, y)); });
        return ofVectors(name, v);
    }
    if (name == "clamp") {
        const LawValue above = lawFunction("max", std::array{v[0], v[1]});
        return lawFunction("min", std::array{above, v[2]});
    }
    if (name == "fma") return combined("+", combined("*", v[0], v[1]), v[2]);
    if (name == "smoothstep") return smoothStep(v);
    return mixed(v);
}

}  // namespace vkdose
