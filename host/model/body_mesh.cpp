#include "host/model/body_mesh.h"

#include "geometry/coil_mesh.h"
#include "geometry/shape.h"

namespace vkdose {

using geometry::Triangle;

std::vector<Triangle> shapeMesh(const geometry::Shape& shape, const Box& room, int perTurn, int around) {
    if (const auto* wire = std::get_if<geometry::Coil>(&shape)) return geometry::coilMesh(*wire, around, perTurn);
    // A little less than a whole part, so that rounding adds no corner.
    const double facet = 2 * kPi * formOf(shape).curve / perTurn * (1 + 1e-12);
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
        if (!formOf(shape).endless) skin.add(skinOf(shapeMesh(shape, {}), formOf(shape).solid));
    return skin;
}

std::vector<Triangle> placed(std::vector<Triangle> mesh, const geometry::Pose& pose) {
    for (Triangle& t : mesh)
        for (Vec3& corner : t) corner = pose.toWorld(corner);
    return mesh;
}

}  // namespace vkdose
