// A table of columns, walked as header, row, reader and store.
#include "host/core/columns.h"

#include <limits>

#include "host/core/vec.h"
#include "tests/support/catch.h"

using namespace vkdose;

enum class Colour { Red, Green };
template <>
struct vkdose::Words<Colour> {
    static constexpr std::array<const char*, 2> kNames{"red", "green"};
};

namespace {

struct Inner {
    std::array<double, 2> pair{};
    Vec3 arrow() const { return {pair[0], pair[1], 7}; }
};

struct Thing {
    int number = 0;
    double length = 0;
    Colour colour = Colour::Red;
    bool good = false;
    Inner inner;
    std::uint64_t count = 0;
};

constexpr auto kInner =
    columns(column<&Inner::pair, 1>("second_m", "m", "Of two."), column<&Inner::arrow, 2>("tip_m", "m", "Computed."));
constexpr auto kThing = std::tuple_cat(
    columns(column<&Thing::number>("number", "1", "A number."),
            column<&Thing::length>("length_m", "m", "A length.", kAllDigits),
            column<&Thing::colour>("colour", "", "A word."), column<&Thing::good>("good", "1", "A truth."),
            column<&Thing::count>("count", "1", "A count.")),
    within<&Thing::inner>(kInner));

const Thing kSome{-3, 0.1 + 0.2, Colour::Green, true, {{1, 1.0 / 3}}, 1ULL << 60};

/// Reads a row of texts in the order of the table; the names of those that are wrong.
std::string wrongIn(const Row& texts, Thing& thing) {
    std::string wrong;
    std::size_t at = 0;
    readRow(
        kThing, thing, [&](const char*) { return texts.at(at++); },
        [&](const char* name) { wrong += std::string(name) + " "; });
    return wrong;
}

}  // namespace

TEST_CASE("header and rows follow the table, through members, elements and functions") {
    CHECK(csvHeader(kThing) == "number,length_m,colour,good,count,second_m,tip_m");
    CHECK(csvRow(kThing, kSome) == "-3,0.30000000000000004,green,1,1152921504606846976,0.333333333,7");
    CHECK(columnTexts(kThing)[5].unit == "m");
    CHECK(csvHeader(picked<2, 0>(kThing)) == "colour,number");
}

TEST_CASE("a row is read back by name, and what is of the wrong kind is told") {
    Thing thing;
    CHECK(wrongIn({"5", "0.25", "green", "1", "12", "3"}, thing).empty());
    CHECK(thing.number == 5);
    CHECK(thing.length == 0.25);
    CHECK(thing.colour == Colour::Green);
    CHECK(thing.good);
    CHECK(thing.count == 12);
    CHECK(thing.inner.pair[1] == 3);
    CHECK(wrongIn({"x", "", "blue", "nan", "-1", "inf"}, thing) == "number length_m colour good count ");
    CHECK(thing.number == 0);
    CHECK_FALSE(thing.good);
}

TEST_CASE("a stored row comes back to the bit, its computed columns are not stored") {
    Thing some = kSome;
    some.number = 3;
    StoredRow stored;
    store(kThing, some, stored);
    CHECK(stored.counts == std::vector<std::uint64_t>{3, 1, 1, 1ULL << 60});
    CHECK(stored.figures == std::vector<double>{0.1 + 0.2, 1.0 / 3});
    const StoredRow shape = storedShape<Thing>(kThing);
    CHECK(shape.counts.size() == 4);
    CHECK(shape.figures.size() == 2);
    Thing back;
    const std::uint64_t* count = stored.counts.data();
    const double* figure = stored.figures.data();
    load(kThing, back, count, figure);
    CHECK(csvRow(kThing, back) == csvRow(kThing, some).replace(0, 1, "3"));
    CHECK(count == stored.counts.data() + 4);
    CHECK(figure == stored.figures.data() + 2);
}
