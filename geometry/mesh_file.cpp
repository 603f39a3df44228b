#include "geometry/mesh_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>

#include "geometry/mesh_formats.h"
#include "host/core/file.h"
#include "host/core/printable.h"

namespace vkdose::geometry {

namespace {

constexpr double kFarthest = 1e5;                  // no device reaches as far [m]
constexpr double kFlatness = 1e-4;                 // of a polygon: height over width
constexpr std::uintmax_t kLargestFile = 1U << 30;  // bytes; some 20 million triangles

struct Unit {
    const char* name;
    double metres;
};
constexpr Unit kUnits[] = {{"m", 1}, {"cm", 1e-2}, {"mm", 1e-3}, {"um", 1e-6}, {"inch", 25.4e-3}};

std::string placed(const std::string& name, std::uint64_t place, bool line) {
    return line ? fmt::format("{}:{}", printable(name), place) : fmt::format("{}: byte {}", printable(name), place);
}

template <class Number>
std::optional<Number> whole(std::string_view word) {
    if (word.size() > 1 && word[0] == '+' && word[1] != '-' && word[1] != '+') word.remove_prefix(1);
    Number value{};
    const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (code != std::errc() || end != word.data() + word.size()) return std::nullopt;
    return value;
}

}  // namespace

std::string TriangleSoup::place(std::size_t t) const {
    return placed(name, places.at(t), placesAreLines);
}

std::optional<double> metresIn(std::string_view unit) {
    for (const Unit& known : kUnits)
        if (unit == known.name) return known.metres;
    return std::nullopt;
}

std::string lengthUnits() {
    std::string names;
    for (const Unit& unit : kUnits) names += (names.empty() ? "" : ", ") + std::string(unit.name);
    return names;
}

SoupBuilder::SoupBuilder(std::string name, double metresPerUnit, bool placesAreLines) : scale_(metresPerUnit) {
    if (!(std::isfinite(metresPerUnit) && metresPerUnit > 0))
        throw MeshError(
            fmt::format("{}: a unit of {} m; name a length unit: {}", printable(name), metresPerUnit, lengthUnits()));
    soup_.name = std::move(name);
    soup_.placesAreLines = placesAreLines;
    soup_.metresPerUnit = metresPerUnit;
}

void SoupBuilder::fail(std::uint64_t place, const std::string& problem) const {
    throw MeshError(placed(soup_.name, place, soup_.placesAreLines) + ": " + problem);
}

std::uint32_t SoupBuilder::addPoint(const Vec3& inUnits, std::uint64_t place) {
    const Vec3 point = scale_ * inUnits;
    for (int d = 0; d < 3; ++d) {
        if (!std::isfinite(inUnits[d]))
            fail(place, fmt::format("a coordinate is {}; it must be a finite number", inUnits[d]));
        if (!(std::abs(point[d]) <= kFarthest))
            fail(place, fmt::format("a coordinate is {:g} m, at {:g} m per unit; it must be below {:g} m", point[d],
                                    scale_, kFarthest));
    }
    soup_.points.push_back(point);
    return static_cast<std::uint32_t>(soup_.points.size() - 1);
}

void SoupBuilder::addPolygon(const std::vector<std::uint32_t>& corners, std::uint64_t place) {
    if (corners.size() < 3)
        fail(place, fmt::format("a face has {} corners; it must have three or more", corners.size()));
    for (const std::uint32_t c : corners)
        if (c >= soup_.points.size())
            fail(place,
                 fmt::format("a face names point {} (counted from 0), and there are {}", c, soup_.points.size()));
    const auto at = [&](std::size_t i) { return soup_.points[corners[i]]; };
    Vec3 normal(0);  // by Newell: twice the area
    for (std::size_t i = 0; i < corners.size(); ++i)
        normal += glm::cross(at(i) - at(0), at((i + 1) % corners.size()) - at(0));
    const double size = glm::length(normal);
    for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
        if (corners.size() > 3) {
            const Vec3 part = glm::cross(at(i) - at(0), at(i + 1) - at(0));
            const double reach = std::max(glm::length(at(i) - at(0)), glm::length(at(i + 1) - at(0)));
            const double rise =
                std::max(std::abs(glm::dot(at(i) - at(0), normal)), std::abs(glm::dot(at(i + 1) - at(0), normal)));
            if (!(glm::dot(part, normal) > 0) || rise > kFlatness * reach * size)
                fail(place, fmt::format("a face with {} corners is not flat and convex; export the mesh as triangles",
                                        corners.size()));
        }
        soup_.triangles.push_back({corners[0], corners[i], corners[i + 1]});
        soup_.places.push_back(place);
    }
}

void SoupBuilder::passOver(std::uint64_t bytes) {
    soup_.passedOver = fmt::format("{} {} behind the last triangle passed over", bytes, bytes == 1 ? "byte" : "bytes");
}

TriangleSoup SoupBuilder::finish() {
    if (soup_.triangles.empty())
        throw MeshError(fmt::format("{}: there is no triangle in it; export a surface mesh", printable(soup_.name)));
    return std::move(soup_);
}

bool TextLines::nextLine() {
    if (rest_.empty()) return false;
    const std::size_t end = std::min(rest_.find_first_of("\r\n"), rest_.size());
    text_ = rest_.substr(0, end);
    rest_.remove_prefix(end);
    rest_.remove_prefix(rest_.starts_with("\r\n") ? 2 : std::min<std::size_t>(1, rest_.size()));
    unread_ = text_;
    line_ = next_++;
    return true;
}

std::string_view TextLines::word() {
    constexpr std::string_view kBlanks = " \t\r\v\f";
    const std::size_t begin = std::min(unread_.find_first_not_of(kBlanks), unread_.size());
    unread_.remove_prefix(begin);
    const std::size_t end = std::min(unread_.find_first_of(kBlanks), unread_.size());
    const std::string_view found = unread_.substr(0, end);
    unread_.remove_prefix(end);
    return found;
}

std::optional<double> number(std::string_view word) {
    return whole<double>(word);
}

std::optional<std::int64_t> integer(std::string_view word) {
    return whole<std::int64_t>(word);
}

std::string inQuotes(std::string_view word) {
    constexpr std::size_t kLongest = 40;
    if (word.empty()) return "the end of the line";
    return "'" + printable(word.substr(0, kLongest)) + (word.size() > kLongest ? "...'" : "'");
}

std::string_view withoutPadding(std::string_view content) {
    constexpr std::string_view kPadding("\0\x1a \t\r\n", 6);
    return content.substr(0, content.find_last_not_of(kPadding) + 1);
}

TriangleSoup readMesh(std::string_view content, const std::string& name, double metresPerUnit) {
    constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
    std::string kind = std::filesystem::path(name).extension().string();
    std::transform(kind.begin(), kind.end(), kind.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? c + 32 : c; });
    if (content.empty()) throw MeshError(printable(name) + ": the file is empty; export the mesh again");
    if (content.starts_with("\xff\xfe") || content.starts_with("\xfe\xff"))
        throw MeshError(printable(name) + ": the text is UTF-16; save it as UTF-8, or export the mesh as binary");
    // The free bytes of a binary STL may begin with anything.
    if (kind == ".stl") return readStl(content, name, metresPerUnit);
    if (content.starts_with(kByteOrderMark)) content.remove_prefix(kByteOrderMark.size());
    if (kind == ".obj") return readObj(content, name, metresPerUnit);
    if (kind == ".ply") return readPly(content, name, metresPerUnit);
    throw MeshError(printable(name) + ": its name must end in .stl, .obj or .ply");
}

TriangleSoup readMeshFile(const std::filesystem::path& file, double metresPerUnit) {
    std::error_code code;
    const std::uintmax_t size = std::filesystem::file_size(file, code);
    if (!code && size > kLargestFile)
        throw MeshError(fmt::format("{}: {} bytes; at most {} are read, so export a coarser mesh",
                                    printable(file.string()), size, kLargestFile));
    const std::optional<std::string> content = fileContent(file);
    if (!content) throw MeshError(unreadable(file));
    return readMesh(*content, file.string(), metresPerUnit);
}

TriangleSoup soupOf(const std::vector<Triangle>& mesh, const std::string& name) {
    SoupBuilder soup(name, 1, true);
    for (std::size_t t = 0; t < mesh.size(); ++t) {
        std::vector<std::uint32_t> corners;
        for (const Vec3& corner : mesh[t]) corners.push_back(soup.addPoint(corner, t));
        soup.addPolygon(corners, t);
    }
    return soup.finish();
}

}  // namespace vkdose::geometry
