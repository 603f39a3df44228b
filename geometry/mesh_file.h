#pragma once
// Reads files of triangles: STL (ASCII and binary), Wavefront OBJ, PLY (ASCII and binary). A file that is not wholly in
// order is refused at the place of its first fault; nothing is guessed, and of a surface nothing is left out in
// silence. The decision against a packaged reader is told in geometry/README.md.

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "host/core/vec.h"

namespace vkdose::geometry {

/// A mesh cannot be used. The message names the file and the place, what is wrong there and what would be right.
class MeshError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

using Triangle = std::array<Vec3, 3>;  ///< anticlockwise, seen from outside [m]

/// Triangles as they stand in a file, before equal corners are made one (mesh.h).
struct TriangleSoup {
    std::string name;                                     ///< of the file, for messages
    std::vector<Vec3> points;                             ///< [m]
    std::vector<std::array<std::uint32_t, 3>> triangles;  ///< indices of points
    std::vector<std::uint64_t> places;                    ///< of each triangle in the file: its line or byte
    bool placesAreLines = true;
    double metresPerUnit = 1;  ///< of the file's lengths
    std::string passedOver;    ///< bytes of the file that say nothing and should not be there; empty without them

    /// "part.stl:12" or "part.stl: byte 134", where triangle `t` stands.
    std::string place(std::size_t t) const;
};

/// Metres in a length unit of that name: "m", "cm", "mm", "um", "inch". Nothing if there is no such unit.
std::optional<double> metresIn(std::string_view unit);
/// The names that `metresIn` knows, for messages: "m, cm, mm, um, inch".
std::string lengthUnits();

/// Reads a file whose name ends in .stl, .obj or .ply. Its lengths are multiples of `metresPerUnit`. Throws MeshError.
TriangleSoup readMeshFile(const std::filesystem::path& file, double metresPerUnit);

/// The same from the bytes of a file called `name`.
TriangleSoup readMesh(std::string_view content, const std::string& name, double metresPerUnit);

/// Triangles that a program made, as if they came from a file called `name`; places are their numbers.
TriangleSoup soupOf(const std::vector<Triangle>& mesh, const std::string& name);

}  // namespace vkdose::geometry
