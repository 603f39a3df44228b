#pragma once
// Small meshes as the texts and bytes of files, written here from the definitions of the formats.

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cstdint>
#include <string>
#include <vector>

#include "geometry/mesh_file.h"

namespace vkdose::test {

/// Points and triangles of a closed surface.
struct Sample {
    std::vector<Vec3> points;
    std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// The unit cube from 0 to 1, twelve triangles, outside is outside.
inline Sample cube() {
    Sample s;
    for (int i = 0; i < 8; ++i) s.points.push_back({i & 1, (i >> 1) & 1, i >> 2});
    const std::array<std::array<std::uint32_t, 4>, 6> sides{
        {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
    for (const auto& q : sides) {
        s.triangles.push_back({q[0], q[1], q[2]});
        s.triangles.push_back({q[0], q[2], q[3]});
    }
    return s;
}

inline std::string asciiStl(const Sample& s) {
    std::string text = "solid cube\n";
    for (const auto& t : s.triangles) {
        text += "  facet normal 0 0 0\n    outer loop\n";
        for (const auto v : t)
            text += fmt::format("      vertex {} {} {}\n", s.points[v].x, s.points[v].y, s.points[v].z);
        text += "    endloop\n  endfacet\n";
    }
    return text + "endsolid cube\n";
}

template <class Word>
std::string bytesOf(Word word, bool little = true) {
    std::string bytes;
    for (unsigned i = 0; i < sizeof(Word); ++i)
        bytes += static_cast<char>((word >> (8 * (little ? i : sizeof(Word) - 1 - i))) & 0xffU);
    return bytes;
}

inline std::string floatBytes(double x, bool little = true) {
    return bytesOf(std::bit_cast<std::uint32_t>(static_cast<float>(x)), little);
}

inline std::string binaryStl(const Sample& s) {
    std::string bytes(80, ' ');
    bytes += bytesOf(static_cast<std::uint32_t>(s.triangles.size()));
    for (const auto& t : s.triangles) {
        for (int i = 0; i < 3; ++i) bytes += floatBytes(0);
        for (const auto v : t)
            for (int d = 0; d < 3; ++d) bytes += floatBytes(s.points[v][d]);
        bytes += std::string(2, '\0');
    }
    return bytes;
}

inline std::string obj(const Sample& s) {
    std::string text = "# a cube\no cube\n";
    for (const Vec3& p : s.points) text += fmt::format("v {} {} {}\n", p.x, p.y, p.z);
    for (const auto& t : s.triangles) text += fmt::format("f {} {}//1 {}/2/3\n", t[0] + 1, t[1] + 1, t[2] + 1);
    return text;
}

inline std::string plyHeader(const Sample& s, const char* format) {
    return fmt::format(
        "ply\nformat {} 1.0\ncomment a cube\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n"
        "property uchar red\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",
        format, s.points.size(), s.triangles.size());
}

inline std::string asciiPly(const Sample& s) {
    std::string text = plyHeader(s, "ascii");
    for (const Vec3& p : s.points) text += fmt::format("{} {} {} 7\n", p.x, p.y, p.z);
    for (const auto& t : s.triangles) text += fmt::format("3 {} {} {}\n", t[0], t[1], t[2]);
    return text;
}

inline std::string binaryPly(const Sample& s, bool little) {
    std::string bytes = plyHeader(s, little ? "binary_little_endian" : "binary_big_endian");
    for (const Vec3& p : s.points) {
        for (int d = 0; d < 3; ++d) bytes += floatBytes(p[d], little);
        bytes += '\7';
    }
    for (const auto& t : s.triangles) {
        bytes += '\3';
        for (const auto v : t) bytes += bytesOf(v, little);
    }
    return bytes;
}

struct NamedFile {
    std::string name, content;
};

/// The same mesh in every form that is read.
inline std::vector<NamedFile> everyForm(const Sample& s) {
    return {{"a.stl", asciiStl(s)}, {"b.stl", binaryStl(s)},       {"c.obj", obj(s)},
            {"d.ply", asciiPly(s)}, {"e.ply", binaryPly(s, true)}, {"f.PLY", binaryPly(s, false)}};
}

}  // namespace vkdose::test
