#pragma once
// Equality of records to the byte: zeros have signs, and what is not a number may stand in a state.

#include <string>
#include <variant>

#include "host/core/record.h"
#include "tests/support/catch.h"

namespace vkdose::test {

inline std::string bytes(const Record::Array& array) {
    return std::visit(
        [](const auto& values) {
            return std::string(reinterpret_cast<const char*>(values.data()), values.size() * sizeof values[0]);
        },
        array);
}

/// Array by array, so that a difference has a name.
inline void checkSameArrays(const Record& a, const Record& b) {
    CHECK(a.arrays().size() == b.arrays().size());
    for (const auto& [name, values] : a.arrays()) {
        CAPTURE(name);
        REQUIRE(b.arrays().contains(name));
        CHECK(values.index() == b.arrays().at(name).index());
        CHECK((bytes(values) == bytes(b.arrays().at(name))));
    }
}

}  // namespace vkdose::test
