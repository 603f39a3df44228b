#pragma once
// The part of the VTKHDF format, version 1.0, that is needed. A file holds one unstructured grid or one image (a
// regular grid) that vtkHDFReader of VTK 9.1 and later opens. The data that VTK reads lie in the group /VTKHDF. A data
// set that has a unit has it as the attribute `unit`. The same data make the same bytes.

#include <array>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "host/core/vec.h"

namespace vkdose::vtkhdf {

/// A named array with `components` numbers for each point or cell, one after the other.
struct Array {
    std::string name;
    std::string unit;  ///< empty: none
    std::size_t components = 1;
    std::variant<std::vector<double>, std::vector<float>, std::vector<std::uint32_t>, std::vector<std::uint8_t>> values;
};

enum class Cell : std::uint8_t { Vertex = 1, Line = 3, Triangle = 5 };

/// Cells of one kind.
struct Grid {
    Cell cell = Cell::Vertex;
    Array points{"Points", "m", 3, {}};      ///< three coordinates each
    std::vector<std::int64_t> connectivity;  ///< as many points for each cell as its kind has corners
    std::vector<Array> pointData, cellData;  ///< an entry for each point, each cell
    std::vector<Array> fieldData;            ///< of the whole
};

/// A regular grid along the axes. VTK 9.1 can read neither cell data nor field data of an image. So an image has no
/// cell data, and its field data lie in a group /FieldData of their own.
struct Image {
    std::array<std::uint32_t, 3> points{};  ///< along x, y, z
    Vec3 origin{0};                         ///< of the first point [m]
    Vec3 spacing{1};                        ///< [m]
    std::vector<Array> pointData;           ///< x fastest
    std::vector<Array> fieldData;           ///< of the whole
};

/// The bytes of a file that holds the data. Throws std::invalid_argument if an array has the wrong length.
std::string file(const Grid& grid);
std::string file(const Image& image);

}  // namespace vkdose::vtkhdf
