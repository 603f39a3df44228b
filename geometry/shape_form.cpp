#include "geometry/shape_form.h"

namespace vkdose::geometry {

double roundFacet(double radius, double length) {
    return length < kMostSlender * radius ? 2 * kPi * radius / kPiecesAround : 0;
}

std::optional<double> unmovedIf(bool revolves) {
    return revolves ? std::optional<double>(0) : std::nullopt;
}

bool onZ(const Vec3& v) {
    return v.x == 0 && v.y == 0;
}

}  // namespace vkdose::geometry
