// The ray caster's parameters of a picture (shaders/render/cast.comp), seen by C++ and GLSL alike (see layout.h).
// Lengths are in metres from an origin that the host puts amid the scene.
#ifndef VKDOSE_SHARED_PICTURE_H
#define VKDOSE_SHARED_PICTURE_H

#ifdef __cplusplus
#include <glm/glm.hpp>
namespace vkdose::gpu {
using glm::uvec4;
using glm::vec4;
#define PICTURE_CONST inline constexpr float
#else
#define PICTURE_CONST const float
#endif

// Kinds of triangles: a wall without thickness; the surface of a solid, which a cut shows as a section; one that is
// seen through.
PICTURE_CONST kSheet = 0.0f;
PICTURE_CONST kSolid = 1.0f;
PICTURE_CONST kSeeThrough = 2.0f;

struct PictureParams {
    vec4 right;  // xyz: unit vector to the right in the picture; w: size of a pixel in the plane through the target [m]
    vec4 up;     // xyz: unit; w: distance of the eye from that plane [m]; 0: parallel rays
    vec4 towards;  // xyz: unit, towards the viewer
    vec4 target;   // xyz: point whose place in the picture is centre.xy
    vec4 centre;   // xy: that place, in pixels from the top left corner
    vec4 light;    // xyz: unit, towards the light
    vec4 cut;   // xyz: unit normal of the half space that is taken away, zero for none; w: where it begins along it [m]
    vec4 box;   // xyz: low corner of the grid; w: edge of a cell [m]
    vec4 wire;  // xy: the coil's axis; z: radius of the wire's centre line; w: of the wire [m]
    uvec4 cells;  // xyz: of the grid; w: spheres and joints of the wire together
    uvec4 size;   // xy: of the picture in pixels; z: spheres; w: rays per pixel and direction
};

#ifdef __cplusplus
}  // namespace vkdose::gpu
#endif

#endif
