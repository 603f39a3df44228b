#include "host/photo/bed.h"

#include <string>
#include <vector>

#include "host/photo/profile.h"
#include "tests/support/catch.h"

using namespace vkdose::photo;

namespace {

/// '#' is 1.
Mask mask(const std::vector<std::string>& rows) {
    Mask m(int(rows[0].size()), int(rows.size()));
    for (int y = 0; y < m.height; ++y)
        for (int x = 0; x < m.width; ++x) m.at(x, y) = rows[std::size_t(y)][std::size_t(x)] == '#' ? 1 : 0;
    return m;
}

std::vector<std::string> drawn(const Mask& m) {
    std::vector<std::string> rows(std::size_t(m.height), std::string(std::size_t(m.width), '.'));
    for (int y = 0; y < m.height; ++y)
        for (int x = 0; x < m.width; ++x)
            if (m.at(x, y) != 0) rows[std::size_t(y)][std::size_t(x)] = '#';
    return rows;
}

}  // namespace

TEST_CASE("small holes are filled, small patches dropped, and what does not reach down is not the bed") {
    const Mask powder = mask({
        ".####.........",  // stuck to the window
        ".####.........",
        "..............",
        "#.......###...",  // hangs together with the bed by a corner
        ".#....##......",
        "#####.####....",
        "##.####..#....",  // holes of one and of four; one above at the edge
        "#######..#..#.",  // a grain at the bottom
        "##########.##.",
    });
    CHECK(drawn(bedOf(powder, 2)) == std::vector<std::string>{
                                         "..............",
                                         "..............",
                                         "..............",
                                         "#.......###...",
                                         "##....##......",
                                         "#####.####....",
                                         "#######..#....",
                                         "#######..#....",
                                         "##########....",
                                     });
    const auto edge = upperEdge(bedOf(powder, 2));
    CHECK(edge[0] == 3);
    CHECK(edge[5] == 6);
    CHECK_FALSE(edge[12]);
    // Without dirt to look for, all that reaches the lowest row stays.
    CHECK(drawn(bedOf(powder, 0))[7] == "#######..#..#.");
    CHECK(drawn(bedOf(powder, 0))[6] == "##.####..#....");
}

TEST_CASE("powder is the kind that lies lower") {
    CHECK(lowerKind(mask({"..", ".#", "##"})) == Powder::Dark);
    CHECK(lowerKind(mask({"##", "#.", ".."})) == Powder::Light);
    // By the mean place, not by how many there are.
    CHECK(lowerKind(mask({"....", "....", "...#"})) == Powder::Dark);
}

TEST_CASE("a threshold parts dark from light") {
    Grey grey(3, 1);
    grey.value = {99, 100, 101};
    CHECK(drawn(darkPixels(grey, 100)) == std::vector<std::string>{"#.."});
    CHECK(drawn(inverse(darkPixels(grey, 100))) == std::vector<std::string>{".##"});
}
