#include "host/python/arrays.h"

#include "host/output/field_row.h"

namespace py = pybind11;

namespace vkdose {

namespace {

static_assert(sizeof(Vec3) == 3 * sizeof(double), "an array can lie over vectors");
static_assert(sizeof(Status) == sizeof(std::uint32_t));

/// Over `first`, which belongs to these particles.
template <class T>
py::array over(const std::shared_ptr<const Particles>& particles, const T* first, std::vector<py::ssize_t> shape) {
    using Owner = std::shared_ptr<const Particles>;
    auto owner = std::make_unique<Owner>(particles);
    const py::capsule keeper(owner.get(), [](void* p) { delete static_cast<Owner*>(p); });
    (void)owner.release();
    py::array_t<T> array(std::move(shape), first, keeper);
    array.attr("setflags")(py::arg("write") = false);
    return array;
}

py::array over(const std::shared_ptr<const Particles>& particles, const std::vector<Vec3>& vectors) {
    return over(particles, reinterpret_cast<const double*>(vectors.data()), {py::ssize_t(vectors.size()), 3});
}

/// The columns of rows by their names.
template <class... C>
void addColumns(py::dict& dict, const std::tuple<C...>& table, const std::vector<FieldRow>& rows) {
    forEachColumn(table, [&](const auto& c) {
        std::vector<double> values;
        values.reserve(rows.size());
        for (const FieldRow& row : rows) values.push_back(c.of(row));
        dict[c.name] = arrayOf(std::move(values));
    });
}

}  // namespace

py::array State::positions() const {
    return over(particles, particles->position);
}
py::array State::velocities() const {
    return over(particles, particles->velocity);
}
py::array State::spins() const {
    return over(particles, particles->spin);
}
py::array State::radii() const {
    return over(particles, particles->radius.data(), {py::ssize_t(particles->size())});
}
py::array State::status() const {
    return over(particles, reinterpret_cast<const std::uint32_t*>(particles->status.data()),
                {py::ssize_t(particles->size())});
}

py::dict arraysOf(vtkhdf::Grid grid, const char* points) {
    py::dict dict;
    const auto add = [&dict](const char* name, vtkhdf::Array& array) {
        dict[name] = std::visit([&](auto& v) { return arrayOf(std::move(v), array.components); }, array.values);
    };
    add(points, grid.points);
    if (grid.cell == vtkhdf::Cell::Line) {  // two points each
        const py::array ends = dict[points];
        dict[points] = ends.attr("reshape")(-1, 2, 3);
    }
    for (vtkhdf::Array& array : grid.cell == vtkhdf::Cell::Line ? grid.cellData : grid.pointData)
        add(array.name.c_str(), array);
    return dict;
}

py::dict arraysOf(const FieldSensor& sensor, const FieldPoints& points, double solidDensity) {
    const FieldGrid& grid = sensor.request.grid;
    std::vector<FieldRow> rows;
    rows.reserve(points.size());
    for (std::size_t n = 0; n < points.size(); ++n) rows.push_back({grid.point(n), points[n], solidDensity});
    py::dict all, dict;
    addColumns(all, kPlaceColumns, rows);
    int direction = 0;
    forEachColumn(kPlaceColumns, [&](const auto& c) {
        if (grid.resolved(direction++)) dict[c.name] = all[c.name];
    });
    addColumns(dict, kQuantityColumns, rows);
    if (sensor.stress) addColumns(dict, kStressColumns, rows);
    return dict;
}

}  // namespace vkdose
