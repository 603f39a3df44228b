#include "host/output/vtkhdf.h"

#include <numeric>
#include <stdexcept>

#include "host/output/hdf5.h"

namespace vkdose::vtkhdf {

namespace {

using Shape = std::vector<std::size_t>;

std::size_t corners(Cell cell) {
    return cell == Cell::Vertex ? 1 : cell == Cell::Line ? 2 : 3;
}

std::size_t length(const Array& a) {
    return std::visit([](const auto& values) { return values.size(); }, a.values);
}

/// Opens the group that everything is in.
void begin(hdf5::Writer& writer, const char* type) {
    writer.group("/VTKHDF");
    writer.attribute("/VTKHDF", "Version", std::vector<std::int64_t>{1, 0});
    writer.attribute("/VTKHDF", "Type", type);
}

void put(hdf5::Writer& writer, const std::string& folder, const Array& a, Shape shape) {
    if (a.components != 1) shape.push_back(a.components);
    const std::size_t wanted = std::accumulate(shape.begin(), shape.end(), std::size_t{1}, std::multiplies<>());
    if (length(a) != wanted)
        throw std::invalid_argument(a.name + " has " + std::to_string(length(a)) + " numbers, not " +
                                    std::to_string(wanted));
    const std::string path = folder + "/" + a.name;
    std::visit([&](const auto& values) { writer.array(path, values, shape); }, a.values);
    if (!a.unit.empty()) writer.attribute(path, "unit", a.unit);
}

void putAll(hdf5::Writer& writer, const std::string& group, const std::vector<Array>& arrays, const Shape& shape) {
    if (arrays.empty()) return;
    writer.group(group);
    for (const Array& a : arrays) put(writer, group, a, shape);
}

void putFields(hdf5::Writer& writer, const std::string& group, const std::vector<Array>& arrays) {
    if (arrays.empty()) return;
    writer.group(group);
    for (const Array& a : arrays) put(writer, group, a, {length(a) / a.components});
}

void putOne(hdf5::Writer& writer, const char* name, std::size_t value) {
    writer.array(std::string("/VTKHDF/") + name, std::vector<std::int64_t>{static_cast<std::int64_t>(value)}, {1});
}

}  // namespace

std::string file(const Grid& grid) {
    const std::size_t points = length(grid.points) / 3, each = corners(grid.cell);
    const std::size_t cells = grid.connectivity.size() / each;
    if (grid.connectivity.size() != cells * each) throw std::invalid_argument("a cell lacks corners");
    hdf5::Writer writer;
    begin(writer, "UnstructuredGrid");
    putOne(writer, "NumberOfPoints", points);
    putOne(writer, "NumberOfCells", cells);
    putOne(writer, "NumberOfConnectivityIds", grid.connectivity.size());
    put(writer, "/VTKHDF", grid.points, {points});
    std::vector<std::int64_t> offsets(cells + 1);
    for (std::size_t c = 0; c <= cells; ++c) offsets[c] = static_cast<std::int64_t>(c * each);
    writer.array("/VTKHDF/Connectivity", grid.connectivity, {grid.connectivity.size()});
    writer.array("/VTKHDF/Offsets", offsets, {cells + 1});
    writer.array("/VTKHDF/Types", std::vector<std::uint8_t>(cells, static_cast<std::uint8_t>(grid.cell)), {cells});
    putAll(writer, "/VTKHDF/PointData", grid.pointData, {points});
    putAll(writer, "/VTKHDF/CellData", grid.cellData, {cells});
    putFields(writer, "/VTKHDF/FieldData", grid.fieldData);
    return writer.image();
}

std::string file(const Image& image) {
    const auto& n = image.points;
    if (n[0] == 0 || n[1] == 0 || n[2] == 0) throw std::invalid_argument("the image has no points");
    hdf5::Writer writer;
    begin(writer, "ImageData");
    writer.attribute("/VTKHDF", "WholeExtent", std::vector<std::int64_t>{0, n[0] - 1, 0, n[1] - 1, 0, n[2] - 1});
    writer.attribute("/VTKHDF", "Origin", std::vector<double>{image.origin.x, image.origin.y, image.origin.z});
    writer.attribute("/VTKHDF", "Spacing", std::vector<double>{image.spacing.x, image.spacing.y, image.spacing.z});
    writer.attribute("/VTKHDF", "Direction", std::vector<double>{1, 0, 0, 0, 1, 0, 0, 0, 1});
    // HDF5 names the slowest axis first.
    putAll(writer, "/VTKHDF/PointData", image.pointData, {n[2], n[1], n[0]});
    putFields(writer, "/FieldData", image.fieldData);
    return writer.image();
}

}  // namespace vkdose::vtkhdf
