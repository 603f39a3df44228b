// The shapes of bodies that come near a centre in one place at most, one line each. GLSL (shared/geometry.h,
// law/features.glsl) and C++ (geometry/shape_form.h) take what they know of a shape from these lines. A file that
// includes this one defines SHAPE before.
//
//   SHAPE(number, Name, kind, overlap)
//
// Name is the shape's word in geometry::ShapeKind, `kind` its constant on a device. `overlap` is the function of
// law/shape.glsl that answers for it. Numbers from 7 to 10 are those of other shapes (shared/geometry.h).

SHAPE(0u, Plane, kShapePlane, planeShape)
SHAPE(1u, Trough, kShapeTrough, troughShape)
SHAPE(2u, Tube, kShapeTube, tubeShape)
SHAPE(3u, Front, kShapeFront, frontShape)
SHAPE(4u, Cone, kShapeCone, coneShape)
SHAPE(5u, Ball, kShapeBall, ballShape)
SHAPE(6u, Block, kShapeBlock, blockShape)

#undef SHAPE
