#include "host/terminal/pixels.h"
#include "tests/support/catch.h"

using namespace vkdose::terminal;

namespace {
constexpr Colour kRed{255, 0, 0}, kBlue{0, 0, 255};
}

TEST_CASE("dots of a braille character stand where Unicode puts them") {
    // Each pixel by itself, against the table of the Unicode standard: dots 1 2 3 7 down the left, 4 5 6 8 down the
    // right.
    const char* const expected[2][4] = {{"⠁", "⠂", "⠄", "⡀"}, {"⠈", "⠐", "⠠", "⢀"}};
    for (int x = 0; x < 2; ++x)
        for (int y = 0; y < 4; ++y) {
            Canvas canvas(3, 2, Style::Plain);
            CHECK(canvas.width() == 6);
            CHECK(canvas.height() == 8);
            canvas.light(2 + x, 4 + y, kRed);
            const auto lines = canvas.lines();
            REQUIRE(lines.size() == 2);
            CHECK(lines[0] == "   ");
            CHECK(lines[1] == std::string(" ") + expected[x][y] + " ");
        }
}

TEST_CASE("halves of a cell have their colours, said once and taken back") {
    Canvas canvas(5, 1, Style::Colour);
    CHECK(canvas.width() == 5);
    CHECK(canvas.height() == 2);
    canvas.light(0, 0, kRed);
    canvas.light(1, 0, kRed);
    canvas.light(2, 0, kRed);
    canvas.light(2, 1, kBlue);
    canvas.light(3, 1, kBlue);
    CHECK(canvas.lines()[0] == "\033[38;2;255;0;0m▀▀\033[48;2;0;0;255m▀\033[0m\033[38;2;0;0;255m▄ \033[0m");
    CHECK(Canvas(2, 1, Style::Colour).lines()[0] == "  ");
}

TEST_CASE("pixels outside a canvas are nobody's, and a canvas may be empty") {
    Canvas canvas(2, 1, Style::Colour);
    for (const int x : {-1, 0, 2})
        for (const int y : {-1, 2}) {
            canvas.light(x, y, kRed);
            canvas.darken(x, y);
            CHECK_FALSE(canvas.at(x, y));
        }
    CHECK(canvas.lines()[0] == "  ");
    canvas.light(1, 1, kBlue);
    CHECK(canvas.at(1, 1) == kBlue);
    canvas.darken(1, 1);
    CHECK_FALSE(canvas.at(1, 1));
    CHECK(Canvas(-3, 5, Style::Plain).lines() == std::vector<std::string>(5));
}
