#pragma once
// Bodies as triangles, for pictures and files. No computation of contacts uses them.

#include <vector>

#include "geometry/mesh_file.h"
#include "host/model/rigid_body.h"
#include "host/model/skin.h"
#include "host/model/world.h"

namespace vkdose {

/// Corners of a full circle, unless a caller wants more or fewer.
inline constexpr int kCornersAround = 64;
/// The same of a wire's cross-section.
inline constexpr int kWireAround = 10;

/// A shape of a body in the frame of the body [m]. Round parts get `perTurn` corners to a turn, a wire `around`
/// around itself. A mesh stays as it is. An endless shape is cut off at `room`, which is in the frame of the body too.
std::vector<geometry::Triangle> shapeMesh(const geometry::Shape& shape, const Box& room, int perTurn = kCornersAround,
                                          int around = kWireAround);

/// All shapes of a body in its own frame. `room` is a box of the world. It cuts off endless shapes of the body in its
/// place at the start, turned with it: no corner of the room is left out.
std::vector<geometry::Triangle> bodyMesh(const RigidBody& body, const Box& room, int perTurn = kCornersAround,
                                         int around = kWireAround);

/// What is drawn of a body, in its own frame: the shapes that have an end.
Skin bodySkin(const RigidBody& body);

/// The triangles from the frame of the body into the world.
std::vector<geometry::Triangle> placed(std::vector<geometry::Triangle> mesh, const geometry::Pose& pose);

/// The box around a box of the world, in the frame of a body.
Box seenFrom(const geometry::Pose& pose, const Box& room);

}  // namespace vkdose
