#pragma once
// The values that a user's law computes with, and the operations of its language, in double precision.

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

namespace vkdose {

enum class LawBase : std::uint8_t { Float, Int, Uint, Bool };

/// A type of the language. A Contact is a vector of its four fields.
struct LawType {
    LawBase base = LawBase::Float;
    std::uint8_t rows = 1, columns = 1;  ///< a vector has one column, a matrix several

    std::size_t size() const { return std::size_t(rows) * columns; }
    bool isScalar() const { return size() == 1; }
    bool isMatrix() const { return columns > 1; }
    friend bool operator==(const LawType&, const LawType&) = default;
};

/// The type of this name ("vec3", "Contact"); float for a name of no type.
LawType lawTypeOf(std::string_view name);

struct LawValue {
    LawType type;
    std::array<double, 16> x{};  ///< of a matrix by columns; of whole numbers and truth values the number

    double operator[](std::size_t k) const { return x[k]; }
    bool isTrue() const { return x[0] != 0; }
};

LawValue lawNumber(double x, LawBase base = LawBase::Float);

/// As it is assigned to a variable of this type: whole numbers become floats where floats are wanted.
LawValue converted(const LawValue& v, LawType to);

/// A constructor: `vec3(1.0)`, `int(x)`, `mat2(a, b)`.
LawValue constructed(LawType to, std::span<const LawValue> from);

/// `sign` is one of + - * / % < > <= >= == != & | ^ << >> ^^.
LawValue combined(std::string_view sign, const LawValue& a, const LawValue& b);
/// `sign` is one of + - ! ~.
LawValue turnedBy(std::string_view sign, const LawValue& a);

/// A function of the language (isLawFunction) at the arguments `v`, of which there is at least one.
LawValue lawFunction(std::string_view name, std::span<const LawValue> v);

}  // namespace vkdose
