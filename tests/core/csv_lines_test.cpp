// CSV line by line: what is written is read again, and each line keeps its number.
#include "host/core/csv_lines.h"

#include <cmath>
#include <sstream>

#include "tests/support/catch.h"

using namespace vkdose;

TEST_CASE("what is written into a line is read from it, commas, quotes and blanks included") {
    const Row row{"1", "", "a, b", "he said \"no\"", "\"", "plain", " blank", "tab\t"};
    CHECK(csvFields(csvLine(row)) == row);
    CHECK(csvLine({"a\nb", "c"}) == "a b,c");
    CHECK(csvFields(",") == Row{"", ""});
    CHECK(csvFields("1, 2.5 ,x") == Row{"1", "2.5", "x"});
    for (const char* broken : {"\"1,2", "a\"b,2", "\"a\"b,2"}) CHECK_FALSE(csvFields(broken));
}

TEST_CASE("blank lines count, and are passed over, a byte order mark and carriage returns are no text") {
    std::istringstream text(
        "\xef\xbb\xbf"
        "a,b\r\n\n  \n1,2\r\n3,4");
    CsvLines lines(text);
    std::vector<std::tuple<int, Row, bool>> seen;
    while (lines.next()) seen.emplace_back(lines.number(), lines.fields().value(), lines.ended());
    CHECK(seen == std::vector<std::tuple<int, Row, bool>>{
                      {1, {"a", "b"}, true}, {4, {"1", "2"}, true}, {5, {"3", "4"}, false}});
}

TEST_CASE("a number is the whole of a field") {
    CHECK(numberIn("-1.5e-3") == -1.5e-3);
    for (const char* none : {"", "1x", " 1", "1 ", "0x10", "nan", "two"}) CHECK(std::isnan(numberIn(none)));
}
