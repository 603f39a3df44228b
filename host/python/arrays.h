#pragma once
// From vkdose to numpy: rows of tables as dicts, states and columns as arrays.

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <memory>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "host/core/columns.h"
#include "host/model/field.h"
#include "host/model/particles.h"
#include "host/output/vtkhdf.h"
#include "host/sim/sample.h"

namespace vkdose {

/// The particles at a rest of a run, and arrays that lie over them. Each array keeps the particles in memory, however
/// long it is kept itself. No array can be written to.
struct State {
    std::shared_ptr<const Particles> particles;

    pybind11::array positions() const;   ///< (n, 3) [m]
    pybind11::array velocities() const;  ///< (n, 3) [m/s]
    pybind11::array spins() const;       ///< (n, 3) [rad/s]
    pybind11::array radii() const;       ///< (n,) [m]
    pybind11::array status() const;      ///< (n,) Status as a number
};

/// An array that takes the values over; (n,) or (n, components).
template <class T>
pybind11::array arrayOf(std::vector<T> values, std::size_t components = 1) {
    auto owner = std::make_unique<std::vector<T>>(std::move(values));
    const T* first = owner->data();
    std::vector<pybind11::ssize_t> shape{pybind11::ssize_t(owner->size() / components)};
    if (components > 1) shape.push_back(pybind11::ssize_t(components));
    const pybind11::capsule keeper(owner.get(), [](void* p) { delete static_cast<std::vector<T>*>(p); });
    (void)owner.release();
    return pybind11::array_t<T>(std::move(shape), first, keeper);
}

/// The arrays of a frame's file by their names, with the points as `points`; a row for each particle or contact.
pybind11::dict arraysOf(vtkhdf::Grid grid, const char* points);

/// The columns of a field's file by their names, but for time, phase and dose; a row for each point.
pybind11::dict arraysOf(const FieldSensor& sensor, const FieldPoints& points, double solidDensity);

/// The columns of a row by their names.
template <class... C, class R>
pybind11::dict dictOf(const std::tuple<C...>& table, const R& row) {
    pybind11::dict dict;
    forEachColumn(table, [&](const auto& c) {
        const auto& value = c.of(row);
        if constexpr (std::is_enum_v<std::decay_t<decltype(value)>>)
            dict[c.name] = cellText(value, kAllDigits);
        else
            dict[c.name] = value;
    });
    return dict;
}

}  // namespace vkdose
