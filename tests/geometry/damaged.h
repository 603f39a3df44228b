#pragma once
// Meshes with the defects that drawing programs leave, and what each encloses.

#include <algorithm>
#include <string>
#include <vector>

#include "tests/geometry/mesh_samples.h"

namespace vkdose::test {

struct Damaged {
    std::string name;
    Sample mesh;
    bool closed = true;
    double volume = 1;  ///< that it encloses; 0 if it is not closed
    std::size_t flat = 0, doubled = 0, onEdges = 0, seams = 0;
    bool apart = false;  ///< a part ends in the middle of a triangle of another, and no vertex shows it
};

/// Another part, its points not joined to those that are there.
inline void addTo(Sample& s, Sample more, const Vec3& shift) {
    for (auto& t : more.triangles)
        for (auto& v : t) v += std::uint32_t(s.points.size());
    for (Vec3& p : more.points) s.points.push_back(p + shift);
    s.triangles.insert(s.triangles.end(), more.triangles.begin(), more.triangles.end());
}

inline void addTriangle(Sample& s, const Vec3& a, const Vec3& b, const Vec3& c) {
    const auto first = std::uint32_t(s.points.size());
    s.points.insert(s.points.end(), {a, b, c});
    s.triangles.push_back({first, first + 1, first + 2});
}

/// A parallelogram in two triangles.
inline void addSheet(Sample& s, const Vec3& corner, const Vec3& u, const Vec3& v) {
    addTriangle(s, corner, corner + u, corner + u + v);
    addTriangle(s, corner, corner + u + v, corner + v);
}

/// The unit cube whose top is cut into n by n squares, so that the four sides know nothing of its vertices.
inline Sample finelyTopped(int n) {
    Sample s = cube();
    s.triangles.erase(s.triangles.begin() + 2, s.triangles.begin() + 4);
    const double w = 1.0 / n;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) addSheet(s, {i * w, j * w, 1}, {w, 0, 0}, {0, w, 0});
    return s;
}

inline std::vector<Damaged> damagedMeshes() {
    const Sample good = cube();
    std::vector<Damaged> all;
    const auto add = [&](const char* name, const Sample& s) -> Damaged& {
        return all.emplace_back(Damaged{name, s, true, 1, 0, 0, 0, 0, false});
    };
    Sample s = good;
    addSheet(s, {0, 0, 1}, {1, 0, 0}, {0, -0.3, 0.4});
    all.push_back({"a fin on an edge of a box", s, false, 0, 0, 0, 0, 1});

    s = good;
    addSheet(s, {0, 0, 1}, {1, 1, 0}, {0, 0, 0.5});
    all.push_back({"a fin on a side of a box, along an edge of its triangles", s, false, 0, 0, 0, 0, 1});

    s = good;
    addSheet(s, {0, 0.5, 1}, {1, 0, 0}, {0, 0, 0.5});
    add("a fin on a side of a box, with its ends on two edges", s).closed = false;
    all.back().volume = 0;
    all.back().apart = true;

    s = good;
    addTo(s, good, {1, 1, 0});
    add("two boxes that share an edge", s).seams = 1;
    all.back().volume = 2;

    s = good;
    addTo(s, good, {1, 1, 1});
    add("two boxes that share a vertex", s).volume = 2;

    s = good;  // the side x = 1 is the last
    Sample other = good;
    other.triangles.erase(other.triangles.begin() + 8, other.triangles.begin() + 10);
    addTo(s, other, {1, 0, 0});
    add("two boxes with a wall between them", s).seams = 4;
    all.back().volume = 2;

    s = good;
    other = good;  // the diagonals of the two walls cross, so that no triangle stands there twice
    other.triangles[8] = {4, 6, 2};
    other.triangles[9] = {4, 2, 0};
    addTo(s, other, {1, 0, 0});
    add("two boxes with two walls in one place", s).seams = 4;
    all.back().volume = 2;

    s = good;
    addTo(s, good, {1, 0, 0});
    add("two boxes with a wall of doubles between them", s).seams = 4;
    all.back().volume = 2;
    all.back().doubled = 2;

    s = good;
    addSheet(s, {0, 0.5, 0}, {1, 0, 0}, {0, 0, 1});
    for (const double y : {0.0, 1.0})  // the floor and the top in halves that end at the wall
        for (const double z : {0.0, 1.0}) addSheet(s, {0, 0.5 * y, z}, {1, 0, 0}, {0, 0.5, 0});
    s.triangles.erase(s.triangles.begin(), s.triangles.begin() + 4);
    all.push_back({"a box with a wall in it, whose ends run over two sides", s, false, 0, 0, 0, 4, 2, true});

    s = good;
    s.triangles.insert(s.triangles.end(), good.triangles.begin() + 2, good.triangles.begin() + 5);
    std::rotate(s.triangles[12].begin(), s.triangles[12].begin() + 1, s.triangles[12].end());
    add("doubles of the same sense", s).doubled = 3;

    s = good;
    s.triangles.push_back(good.triangles[3]);
    std::swap(s.triangles.back()[1], s.triangles.back()[2]);
    add("a double of the other sense", s).doubled = 1;

    s = {};
    addSheet(s, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    s.triangles.push_back({0, 2, 1});
    s.triangles.push_back({3, 5, 4});
    all.push_back({"a plate drawn from both sides", s, false, 0, 0, 2, 0, 0});

    s = good;  // one side is cut at the middle of its lower edge, its neighbour is not
    s.points.push_back({0.5, 0, 0});
    s.triangles.push_back({0, 8, 5});
    s.triangles[4] = {8, 1, 5};
    add("a vertex on an edge", s).onEdges = 1;

    s.points[8].y = 3e-7;
    add("a vertex beside an edge, within the tolerance", s).onEdges = 1;

    add("a fine top on coarse sides", finelyTopped(7)).onEdges = 24;

    s = good;
    s.triangles.push_back({0, 0, 1});
    s.triangles.push_back({2, 2, 2});
    s.points.push_back({0.5, 1e-7, 0});
    s.triangles.push_back({0, 1, 8});
    s.points.push_back({1e-7, 0, 1e-7});
    s.triangles.push_back({0, 9, 6});
    add("flat triangles that nobody needs", s).flat = 4;

    s = good;
    s.points.push_back({0.5, 0, 0});
    s.triangles.push_back({0, 8, 5});
    s.triangles[4] = {8, 1, 5};
    s.triangles.push_back({0, 1, 8});
    add("a flat triangle between an edge and its two halves", s).flat = 1;

    s = good;  // a fan of flat triangles along the lower edge of the side
    const int pieces = 5;
    s.triangles.erase(s.triangles.begin() + 4);
    for (int i = 1; i < pieces; ++i) s.points.push_back({double(i) / pieces, 0, 0});
    const auto on = [&](int i) { return i == 0 ? 0U : i == pieces ? 1U : std::uint32_t(7 + i); };
    for (int i = 0; i < pieces; ++i) s.triangles.push_back({on(i), on(i + 1), 5});
    for (int i = 1; i < pieces; ++i) s.triangles.push_back({on(0), on(i + 1), on(i)});
    add("a fan of flat triangles along an edge", s).flat = pieces - 1;

    s = good;  // a corner cut off by so little that two of its vertices become one
    s.points.push_back({1, 1, 1 - 1e-7});
    s.triangles.push_back({7, 8, 3});
    s.triangles.push_back({7, 6, 8});
    add("needles as wide as the rounding", s).flat = 2;

    s = finelyTopped(3);
    addTo(s, good, {1, 1, 0});
    s.triangles.push_back(good.triangles[0]);
    s.triangles.push_back({0, 0, 1});
    s.points.push_back({0.5, 0, 0});
    s.triangles.push_back({0, 1, std::uint32_t(s.points.size() - 1)});
    all.push_back({"several of these at once", s, true, 2, 2, 1, 8, 1});
    return all;
}

}  // namespace vkdose::test
