// Wavefront OBJ: points ("v") and faces ("f"). Materials, textures, groups, lines and loose points mean nothing here
// and are passed over. No other file is opened.

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "geometry/mesh_formats.h"

namespace vkdose::geometry {

namespace {

constexpr std::array<std::string_view, 18> kIgnored{"vt",     "vn",     "vp",  "g",        "o",        "s",
                                                    "mg",     "l",      "p",   "usemtl",   "bevel",    "mtllib",
                                                    "usemap", "maplib", "lod", "c_interp", "d_interp", "shadow_obj"};

class Obj {
  public:
    Obj(std::string_view content, const std::string& name, double metresPerUnit)
        : lines_(content), soup_(name, metresPerUnit, true) {}

    TriangleSoup read() {
        while (lines_.nextLine()) {
            const std::string_view text = lines_.text();
            if (text.find('\0') != std::string_view::npos) fail("there is a zero byte; the file is damaged or no OBJ");
            const std::string_view word = lines_.word();
            if (word.empty() || word.front() == '#') continue;
            if (text.back() == '\\') fail("a line goes on in the next one; export each statement in one line");
            if (word == "v")
                point();
            else if (word == "f" || word == "fo")
                face();
            else if (std::find(kIgnored.begin(), kIgnored.end(), word) == kIgnored.end())
                fail(fmt::format("{} is not read: only points 'v' and faces 'f' are; export the mesh as triangles",
                                 inQuotes(word)));
        }
        return soup_.finish();
    }

  private:
    [[noreturn]] void fail(const std::string& problem) { soup_.fail(lines_.line(), problem); }

    /// Three coordinates. A weight, or a colour, may follow.
    void point() {
        Vec3 v;
        int count = 0;
        for (std::string_view word = lines_.word(); !word.empty() && word.front() != '#'; word = lines_.word()) {
            const auto value = number(word);
            if (!value) fail(fmt::format("{} is not a number; three coordinates belong here", inQuotes(word)));
            if (count < 3) v[count] = *value;
            if (count == 3) weight_ = *value;
            ++count;
        }
        if (count < 3 || count > 7 || count == 5)
            fail(fmt::format("a point has {} numbers; it must have three", count));
        if (count == 4 && weight_ != 1) fail(fmt::format("a point has the weight {}; it must be 1", weight_));
        soup_.addPoint(v, lines_.line());
    }

    /// Each word names a point, as "3", "3/7", "3//2" or "3/7/2". Negative numbers count backwards from the last point.
    void face() {
        std::vector<std::uint32_t> corners;
        for (std::string_view word = lines_.word(); !word.empty() && word.front() != '#'; word = lines_.word()) {
            const auto index = integer(word.substr(0, word.find('/')));
            if (!index) fail(fmt::format("{} does not name a point; a face is written as 'f 1 2 3'", inQuotes(word)));
            const auto known = static_cast<std::int64_t>(soup_.points());
            if (*index == 0 || *index > known || *index < -known)
                fail(fmt::format("a face names point {}, and {} stand before it", *index, known));
            corners.push_back(static_cast<std::uint32_t>(*index > 0 ? *index - 1 : known + *index));
        }
        soup_.addPolygon(corners, lines_.line());
    }

    TextLines lines_;
    SoupBuilder soup_;
    double weight_ = 1;
};

}  // namespace

TriangleSoup readObj(std::string_view content, const std::string& name, double metresPerUnit) {
    return Obj(content, name, metresPerUnit).read();
}

}  // namespace vkdose::geometry
