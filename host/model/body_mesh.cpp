#include "host/model/body_mesh.h"

#include <algorithm>
#include <cmath>

#include "geometry/coil_mesh.h"
#include "geometry/tessellate.h"

namespace vkdose {

using geometry::Triangle;

namespace {

/// The radius by which a shape is curved most visibly [m]; of shapes that are not curved any number.
double radiusOf(const geometry::Shape& shape) {
    if (const auto* s = std::get_if<geometry::Trough>(&shape)) return s->halfWidth;
    if (const auto* s = std::get_if<geometry::Tube>(&shape)) return s->radius;
    if (const auto* s = std::get_if<geometry::Front>(&shape)) return s->holeRadius;
    if (const auto* s = std::get_if<geometry::Cone>(&shape)) return std::max(s->baseRadius, s->endRadius);
    if (const auto* s = std::get_if<geometry::Ball>(&shape)) return s->radius;
    if (const auto* s = std::get_if<geometry::Flight>(&shape)) return s->outerRadius;
    return 1;
}

}  // namespace

bool isEndless(const geometry::Shape& shape) {
    if (const auto* tube = std::get_if<geometry::Tube>(&shape)) return std::isinf(tube->length);
    return std::holds_alternative<geometry::Plane>(shape) || std::holds_alternative<geometry::Trough>(shape) ||
           std::holds_alternative<geometry::Front>(shape);
}

bool isSolid(const geometry::Shape& shape) {
    if (const auto* block = std::get_if<geometry::Block>(&shape)) return !block->inside;
    if (const auto* mesh = std::get_if<std::shared_ptr<const geometry::MeshSurface>>(&shape))
        return (*mesh)->mesh().closed;
    return std::holds_alternative<geometry::Ball>(shape) || std::holds_alternative<geometry::Coil>(shape) ||
           std::holds_alternative<geometry::Flight>(shape);
}

std::vector<Triangle> shapeMesh(const geometry::Shape& shape, const Box& room, int perTurn, int around) {
    if (const auto* wire = std::get_if<geometry::Coil>(&shape)) return geometry::coilMesh(*wire, around, perTurn);
    // A little less than a whole part, so that rounding adds no corner.
    const double facet = 2 * kPi * radiusOf(shape) / perTurn * (1 + 1e-12);
    return geometry::tessellated(shape, facet, room.low, room.high, geometry::StraightLines::Whole);
}

Box seenFrom(const geometry::Pose& pose, const Box& room) {
    Box box{Vec3(geometry::kEndless), Vec3(-geometry::kEndless)};
    for (int corner = 0; corner < 8; ++corner) {
        const Vec3 at((corner & 1) != 0 ? room.high.x : room.low.x, (corner & 2) != 0 ? room.high.y : room.low.y,
                      (corner & 4) != 0 ? room.high.z : room.low.z);
        box.low = glm::min(box.low, pose.toBody(at));
        box.high = glm::max(box.high, pose.toBody(at));
    }
    return box;
}

std::vector<Triangle> bodyMesh(const RigidBody& body, const Box& room, int perTurn, int around) {
    const Box own = seenFrom(body.course.start, room);
    std::vector<Triangle> mesh;
    for (const geometry::Shape& shape : body.shapes) {
        const std::vector<Triangle> part = shapeMesh(shape, own, perTurn, around);
        mesh.insert(mesh.end(), part.begin(), part.end());
    }
    return mesh;
}

Skin bodySkin(const RigidBody& body) {
    Skin skin;
    for (const geometry::Shape& shape : body.shapes)
        if (!isEndless(shape)) skin.add(skinOf(shapeMesh(shape, {}), isSolid(shape)));
    return skin;
}

std::vector<Triangle> placed(std::vector<Triangle> mesh, const geometry::Pose& pose) {
    for (Triangle& t : mesh)
        for (Vec3& corner : t) corner = pose.toWorld(corner);
    return mesh;
}

}  // namespace vkdose
