#pragma once
// The device side of coarse-grained fields: the passes shaders/pass/field_*.comp over the tables of a load.

#include <cstdint>

#include "host/backend/vulkan/pace.h"
#include "host/backend/vulkan/passes.h"
#include "host/model/field.h"

namespace vkdose {

/// The tables of shaders/shared/field_tables.h, each under its name, for grids of up to `points`.
struct FieldTables {
    FieldTables(const vk::Device& device, const Tables& tables, std::size_t n);

    const std::size_t points;
#define TABLE(number, name, element, count, title) vk::Buffer name;
#include "shaders/shared/field_tables.h"
};

class FieldPasses {
  public:
    /// For grids of up to `points`. `passes` must outlive it.
    FieldPasses(const vk::Device& device, const Passes& passes, std::size_t points);

    /// Whether a grid fits its tables.
    bool holds(const FieldRequest& request) const { return request.grid.points() <= own_.points; }

    struct Moment {
        std::uint32_t row;     ///< of the member on the roster
        double largestRadius;  ///< [m]
    };
    /// Fields of a member. The request must have no fault (faultOf). The device must be idle.
    FieldPoints compute(const FieldRequest& request, const Moment& moment);

  private:
    void dispatch(vk::Commands& commands, const vk::Pipeline& pass, std::uint32_t groups) const;

    const vk::Device& device_;
    const Passes& passes_;
    FieldTables own_;
    vk::BindingSet bindings_, branchBindings_;  ///< the second has the tables of the bodies, if there are any
    vk::Pipeline branches_, weigh_, sums_, kinetic_;
    Pace slices_{16, 1u << 20};  ///< of the particles, one dispatch each
};

}  // namespace vkdose
