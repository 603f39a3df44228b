#include "geometry/shape.h"

namespace vkdose::geometry {

namespace {

/// The shape itself: bodies share their meshes.
template <class S>
const S& itself(const S& shape) {
    return shape;
}
const MeshSurface& itself(const std::shared_ptr<const MeshSurface>& mesh) {
    return *mesh;
}

template <class S>
std::vector<Feature> placesOf(const S& shape, const Vec3& centre, double radius) {
    if constexpr (requires { shape.closest(centre); }) {
        const Feature only{shape.closest(centre)};
        return only.distance < radius ? std::vector{only} : std::vector<Feature>{};
    } else {
        return shape.places(centre, radius);
    }
}

}  // namespace

std::vector<Feature> places(const Shape& shape, const Vec3& centre, double radius) {
    return std::visit([&](const auto& s) { return placesOf(itself(s), centre, radius); }, shape);
}

ShapeForm formOf(const Shape& shape) {
    return std::visit([](const auto& s) { return itself(s).form(); }, shape);
}

std::vector<Triangle> tessellated(const Shape& shape, double facet, const Vec3& low, const Vec3& high,
                                  StraightLines straight) {
    Tessellator tessellator(facet, low, high, straight);
    std::visit([&](const auto& s) { itself(s).cut(tessellator); }, shape);
    return tessellator.take();
}

std::vector<Feature> touched(const std::vector<Shape>& shapes, const Vec3& centre, double radius, double reach) {
    std::vector<Feature> all;
    for (std::uint32_t s = 0; s < shapes.size(); ++s)
        for (Feature& place : places(shapes[s], centre, radius + reach)) {
            place.shape = s;
            all.push_back(place);
        }
    return distinct(std::move(all), centre, radius, reach);
}

}  // namespace vkdose::geometry
