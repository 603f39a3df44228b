// STL, in both its forms. A binary file is 80 free bytes, the number of triangles, and 50 bytes for each. An ASCII file
// begins with the word "solid", as the free bytes of some binary files do too, so the length decides first. The normals
// are not used, because the corners tell them; they may be zero, or no numbers.

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cctype>
#include <cmath>

#include "geometry/mesh_formats.h"

namespace vkdose::geometry {

namespace {

constexpr std::uint64_t kHead = 84, kRecord = 50;

std::uint32_t word32(std::string_view bytes, std::uint64_t at) {
    std::uint32_t value = 0;
    for (unsigned i = 0; i < 4; ++i) value |= std::uint32_t(static_cast<unsigned char>(bytes[at + i])) << (8 * i);
    return value;
}

Vec3 vector32(std::string_view bytes, std::uint64_t at) {
    Vec3 v;
    for (int d = 0; d < 3; ++d) v[d] = std::bit_cast<float>(word32(bytes, at + 4 * std::uint64_t(d)));
    return v;
}

TriangleSoup readBinary(std::string_view content, const std::string& name, double metresPerUnit) {
    SoupBuilder soup(name, metresPerUnit, false);
    const std::uint64_t count = word32(content, 80), expected = kHead + kRecord * count;
    if (content.size() < expected)
        soup.fail(80,
                  fmt::format("{} triangles are announced, which take {} bytes, but the file has {}; it was cut off "
                              "or is no binary STL",
                              count, expected, content.size()));
    // A few bytes more, or zeros, are what some programs leave there. Enough for a triangle may be one.
    const std::uint64_t more = content.size() - expected;
    if (more >= kRecord && withoutPadding(content).size() > expected)
        soup.fail(
            expected,
            fmt::format("the {} announced triangles end here, and {} bytes follow; the number at byte 80 is wrong, "
                        "or something was appended. Export the mesh again",
                        count, more));
    if (more > 0) soup.passOver(more);
    for (std::uint64_t at = kHead; at < expected; at += kRecord) {
        std::vector<std::uint32_t> corners;
        for (std::uint64_t i = 1; i <= 3; ++i) corners.push_back(soup.addPoint(vector32(content, at + 12 * i), at));
        soup.addPolygon(corners, at);
    }
    return soup.finish();
}

bool same(std::string_view word, std::string_view lowerCase) {
    if (word.size() != lowerCase.size()) return false;
    for (std::size_t i = 0; i < word.size(); ++i)
        if (std::tolower(static_cast<unsigned char>(word[i])) != lowerCase[i]) return false;
    return true;
}

bool isComment(std::string_view word) {
    return word.starts_with('#') || word.starts_with("//") || word.starts_with(';');
}

/// How programs write a number that is none, or not finite: "-nan", "nan(ind)", "1.#QNAN".
bool isNoNumber(std::string_view word) {
    if (word.starts_with('-') || word.starts_with('+')) word.remove_prefix(1);
    return same(word.substr(0, 3), "nan") || same(word.substr(0, 3), "inf") || word.starts_with("1.#");
}

class AsciiStl {
  public:
    AsciiStl(std::string_view content, const std::string& name, double metresPerUnit)
        : lines_(content), soup_(name, metresPerUnit, true) {}

    TriangleSoup read() {
        while (nextFilled()) solid();
        return soup_.finish();
    }

  private:
    /// On to the next line that is neither blank nor a comment. Its first word is in `first_`.
    bool nextFilled() {
        while (lines_.nextLine())
            if (first_ = lines_.word(); !first_.empty() && !isComment(first_)) return true;
        first_ = {};
        return false;
    }

    void require(bool good, std::string_view found, const char* wanted) {
        if (!good)
            soup_.fail(lines_.line(), fmt::format("{} stands where '{}' belongs; the file is damaged or no STL",
                                                  found.empty() ? "the end" : inQuotes(found), wanted));
    }

    void words(std::string_view first, std::string_view second, const char* wanted) {
        require(same(first_, first), first_, wanted);
        if (second.empty()) return;
        const std::string_view word = lines_.word();
        require(same(word, second), word, wanted);
    }

    void normal() {
        for (int d = 0; d < 3; ++d) {
            const std::string_view word = lines_.word();
            if (!number(word) && !isNoNumber(word))
                soup_.fail(lines_.line(),
                           fmt::format("normal: {} is not a number; three numbers belong here", inQuotes(word)));
        }
        lineEnds();
    }

    Vec3 vector(const char* of) {
        Vec3 v;
        for (int d = 0; d < 3; ++d) {
            const std::string_view word = lines_.word();
            const auto value = number(word);
            if (!value)
                soup_.fail(lines_.line(),
                           fmt::format("{}: {} is not a number; three numbers belong here", of, inQuotes(word)));
            v[d] = *value;
        }
        lineEnds();
        return v;
    }

    void lineEnds() {
        const std::string_view more = lines_.word();
        if (!more.empty())
            soup_.fail(lines_.line(), fmt::format("{} stands behind the end of the statement", inQuotes(more)));
    }

    void solid() {
        words("solid", "", "solid");
        for (;;) {
            nextFilled();
            if (same(first_, "endsolid")) return;
            facet();
        }
    }

    void facet() {
        words("facet", "normal", "facet normal");
        const std::uint64_t place = lines_.line();
        normal();
        nextFilled();
        words("outer", "loop", "outer loop");
        lineEnds();
        std::vector<std::uint32_t> corners;
        for (int i = 0; i < 3; ++i) {
            nextFilled();
            words("vertex", "", "vertex");
            corners.push_back(soup_.addPoint(vector("vertex"), lines_.line()));
        }
        nextFilled();
        words("endloop", "", "endloop");
        lineEnds();
        nextFilled();
        words("endfacet", "", "endfacet");
        lineEnds();
        soup_.addPolygon(corners, place);
    }

    TextLines lines_;
    SoupBuilder soup_;
    std::string_view first_;
};

}  // namespace

TriangleSoup readStl(std::string_view content, const std::string& name, double metresPerUnit) {
    const bool hasHead = content.size() >= kHead;
    if (hasHead && content.size() == kHead + kRecord * word32(content, 80))
        return readBinary(content, name, metresPerUnit);
    const std::string_view text = withoutPadding(content.substr(content.starts_with("\xef\xbb\xbf") ? 3 : 0));
    // A text that begins otherwise, as a file of another kind does, is told as one.
    const bool readable =
        std::all_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) >= '\t'; });
    if (readable && !text.empty()) return AsciiStl(text, name, metresPerUnit).read();
    if (hasHead) return readBinary(content, name, metresPerUnit);
    SoupBuilder(name, metresPerUnit, false)
        .fail(content.size(), "the file ends here; an STL file begins with 'solid', or has 84 bytes or more");
}

}  // namespace vkdose::geometry
