#pragma once
// The parts that the readers of mesh_file.h share. No other room includes this.

#include <string>
#include <string_view>
#include <vector>

#include "geometry/mesh_file.h"

namespace vkdose::geometry {

/// Collects what a reader finds, in metres, and refuses what cannot be.
class SoupBuilder {
  public:
    SoupBuilder(std::string name, double metresPerUnit, bool placesAreLines);

    /// Throws MeshError with the place (a line or a byte) in front: "part.stl:12: PROBLEM".
    [[noreturn]] void fail(std::uint64_t place, const std::string& problem) const;

    /// Adds a point given in the units of the file; throws if it is not finite, or further off than any device.
    std::uint32_t addPoint(const Vec3& inUnits, std::uint64_t place);
    /// Adds a flat convex polygon as a fan of triangles; throws if it is none.
    void addPolygon(const std::vector<std::uint32_t>& corners, std::uint64_t place);
    /// Tells of bytes at the end that belong to nothing.
    void passOver(std::uint64_t bytes);
    std::size_t points() const { return soup_.points.size(); }

    /// Throws if there is no triangle.
    TriangleSoup finish();

  private:
    TriangleSoup soup_;
    double scale_;
};

/// Goes through a text line by line and word by word. A line ends at a line feed, a carriage return or both.
class TextLines {
  public:
    explicit TextLines(std::string_view text, std::uint64_t firstLine = 1) : rest_(text), next_(firstLine) {}

    /// On to the next line, whatever it holds; false at the end of the text.
    bool nextLine();
    std::uint64_t line() const { return line_; }
    std::string_view text() const { return text_; }  ///< of the line, without its end
    /// The next word of the line; empty at its end.
    std::string_view word();

  private:
    std::string_view rest_, text_, unread_;
    std::uint64_t line_ = 0, next_;
};

/// The whole word as a number (locale-free, "+1" allowed), if it is one within double precision.
/// "nan" and "inf" are numbers.
std::optional<double> number(std::string_view word);
std::optional<std::int64_t> integer(std::string_view word);

/// The content without what editors and transfers put behind a text: zero bytes, Ctrl-Z, blanks.
std::string_view withoutPadding(std::string_view content);

/// A word from a file for a message: in quotes, short, and safe to show.
std::string inQuotes(std::string_view word);

TriangleSoup readStl(std::string_view content, const std::string& name, double metresPerUnit);
TriangleSoup readObj(std::string_view content, const std::string& name, double metresPerUnit);
TriangleSoup readPly(std::string_view content, const std::string& name, double metresPerUnit);

}  // namespace vkdose::geometry
