#version 450
// cast: a picture of spheres, of a coil and of bodies, one pixel per invocation, by rays through a uniform grid.
// Reads the picture's parameters, spheres with their colours, the joints of the coil's wire, the bodies' triangles and
// the grid; writes for every pixel its colour, how much of it is covered, and how near to the viewer.
//
// A cell of the grid is a range of `entries` in four parts: spheres, pieces of wire and triangles that a ray through
// the cell can meet, and spheres near enough to take light from a point in it. No loop is longer than a row of cells or
// such a part.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "law/precise.glsl"
#include "shared/picture.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(std430, set = 0, binding = 0) readonly buffer ParamsBuffer { PictureParams given; };
layout(std430, set = 0, binding = 6) writeonly buffer PictureBuffer { uvec2 picture[]; };  // RGBA8 (sRGB), depth bits

// The tables. Views of them follow after the eight buffers (vk::BindingSet).
#ifdef TEXEL_READS
#define TABLE(number, element, name)                                                   \
    layout(set = 0, binding = 8 + number) uniform VIEW_##element name##View; \
    element name##At(uint at) { return OF_TEXEL_##element(texelFetch(name##View, int(at))); }
#define VIEW_vec4 textureBuffer
#define VIEW_uint utextureBuffer
#define VIEW_uvec4 utextureBuffer
#define OF_TEXEL_vec4(texel) texel
#define OF_TEXEL_uint(texel) texel.x
#define OF_TEXEL_uvec4(texel) texel
#else
#define TABLE(number, element, name)                                                           \
    layout(std430, set = 0, binding = number) readonly buffer name##Buffer { element name[]; }; \
    element name##At(uint at) { return name[at]; }
#endif
TABLE(1, vec4, sphere)  // centre, radius
TABLE(2, vec4, paint)   // of a sphere: linear RGB
TABLE(3, vec4, joint)   // centre line; w: angle [rad]
TABLE(4, uvec4, parts)  // ends of the four parts
TABLE(5, uint, entry)
TABLE(7, vec4, facet)  // of a triangle: three corners (w: kind), three normals there

PictureParams params;  // as given: lavapipe reads a buffer ray by ray

const float kNever = 1e30;
const uint kNothing = 0xffffffffu;
const float kReach = 2.5;                    // of a sphere's shade, in radii; host/render/ray_grid.h has the same
const float kSky = 0.55;                     // light that comes from everywhere, over that of the colour map
const float kSun = 0.75;                     // and from one side
const vec3 kSteel = vec3(0.36, 0.38, 0.41);  // linear
const vec3 kPane = vec3(0.20, 0.25, 0.32);   // a wall that is seen through
const uint kFacetVectors = 6u;

struct Ray {
    vec3 origin;
    vec3 way;  // unit
};

struct Hit {
    float far;
    uint what;  // a sphere, or after these a piece of wire, or after these a triangle
    bool face;  // cut open
};

/// How much light comes through the walls that are seen through, on the ray's way to its hit.
float clear = 1.0;

/// Ray through a place in the picture, in pixels from its top left corner.
Ray rayThrough(vec2 place) {
    vec2 offset = (place - params.centre.xy) * params.right.w;
    vec3 point = params.target.xyz + params.right.xyz * offset.x - params.up.xyz * offset.y;
    float eye = params.up.w;
    if (eye == 0.0) return Ray(point, -params.towards.xyz);
    vec3 from = params.target.xyz + params.towards.xyz * eye;
    return Ray(from, normalize(point - from));
}

/// Where a ray enters a sphere. The squared quantity is the distance of the centre from the ray, not that from the
/// ray's origin, so that a far origin loses no digits.
float enterSphere(Ray ray, vec3 centre, float radius) {
    vec3 to = centre - ray.origin;
    float along = dot(to, ray.way);
    vec3 off = to - along * ray.way;
    float rest = radius * radius - dot(off, off);
    return rest > 0.0 ? along - sqrt(rest) : kNever;
}

/// Where a ray enters a straight piece of wire with round ends.
float enterWire(Ray ray, vec3 a, vec3 b, float radius) {
    float way = length(b - a);
    vec3 axis = (b - a) / way;
    float nearest = dot(a - ray.origin, ray.way);  // start there: small numbers
    vec3 from = ray.origin + nearest * ray.way - a;
    float fromAlong = dot(from, axis), wayAlong = dot(ray.way, axis);
    vec3 across = from - fromAlong * axis, wayAcross = ray.way - wayAlong * axis;
    float A = dot(wayAcross, wayAcross), B = dot(across, wayAcross), C = dot(across, across) - radius * radius;
    float rest = B * B - A * C;
    float ends = min(enterSphere(ray, a, radius), enterSphere(ray, b, radius));
    if (rest <= 0.0 || A < 1e-6) return ends;
    float far = (-B - sqrt(rest)) / A;
    float place = fromAlong + far * wayAlong;
    return place >= 0.0 && place <= way ? nearest + far : ends;
}

/// Two vectors square to a ray's way, which depend on nothing else.
void across(vec3 way, out vec3 u, out vec3 v) {
    u = normalize(abs(way.x) < 0.7 ? vec3(0.0, way.z, -way.y) : vec3(-way.z, 0.0, way.x));
    v = cross(way, u);
}

/// Where a ray meets a triangle; `share` are the parts of its corners there. Seen along the ray, the sides turn the
/// same way round the place. A side gives two triangles the same number with opposite signs, so nothing shines through.
float meetTriangle(Ray ray, uint i, out vec3 share) {
    share = vec3(1.0, 0.0, 0.0);
    vec3 u, v;
    across(ray.way, u, v);
    vec3 a = facetAt(kFacetVectors * i).xyz - ray.origin, b = facetAt(kFacetVectors * i + 1u).xyz - ray.origin,
         c = facetAt(kFacetVectors * i + 2u).xyz - ray.origin;
    precise vec2 A = vec2(preciseDot(a, u), preciseDot(a, v)), B = vec2(preciseDot(b, u), preciseDot(b, v)),
                 C = vec2(preciseDot(c, u), preciseDot(c, v));
    precise vec3 side = vec3(B.x * C.y - C.x * B.y, C.x * A.y - A.x * C.y, A.x * B.y - B.x * A.y);
    float sum = side.x + side.y + side.z;
    bool outside = any(lessThan(side, vec3(0.0))) && any(greaterThan(side, vec3(0.0)));
    if (outside || sum == 0.0) return kNever;
    share = side / sum;
    return dot(share, vec3(dot(a, ray.way), dot(b, ray.way), dot(c, ray.way)));
}

vec3 facetNormal(uint i) {
    vec3 a = facetAt(kFacetVectors * i).xyz;
    return cross(facetAt(kFacetVectors * i + 1u).xyz - a, facetAt(kFacetVectors * i + 2u).xyz - a);
}

vec3 onWire(vec3 p, vec3 a, vec3 b) {
    vec3 way = b - a;
    return a + clamp(dot(p - a, way) / dot(way, way), 0.0, 1.0) * way;
}

uint cellAt(ivec3 c) { return (uint(c.z) * params.cells.y + uint(c.y)) * params.cells.x + uint(c.x); }
uint beginOf(uint cell) { return cell == 0u ? 0u : partsAt(cell - 1u).w; }
ivec3 cellOf(vec3 p) {
    return clamp(ivec3(floor((p - params.box.xyz) / params.box.w)), ivec3(0), ivec3(params.cells.xyz) - 1);
}

bool isCut() { return dot(params.cut.xyz, params.cut.xyz) > 0.0; }

/// The body in which the cut lies at `point`, if any. Where two spheres overlap, it is the sphere on whose side of
/// their meeting the point lies.
Hit openedAt(vec3 point, float far) {
    Hit hit = Hit(kNever, kNothing, false);
    float deepest = 0.0;
    uint cell = cellAt(cellOf(point));
    uvec4 part = partsAt(cell);
    for (uint e = beginOf(cell); e < part.x; ++e) {
        vec4 s = sphereAt(entryAt(e));
        float depth = dot(point - s.xyz, point - s.xyz) - s.w * s.w;
        if (depth < deepest) {
            deepest = depth;
            hit = Hit(far, entryAt(e), true);
        }
    }
    for (uint e = part.x; e < part.y; ++e) {
        vec3 off = point - onWire(point, jointAt(entryAt(e)).xyz, jointAt(entryAt(e) + 1u).xyz);
        if (dot(off, off) < params.wire.w * params.wire.w) hit = Hit(far, params.size.z + entryAt(e), true);
    }
    return hit;
}

/// The first triangle on a ray's way in a cell. Light is taken by the walls that are seen through, and lie in the cell
/// before the hit: from `from` on, up to `edge`.
void meetFacets(Ray ray, uint begin, uint end, float from, float edge, inout Hit hit) {
    vec3 share;
    bool panes = false;
    for (uint e = begin; e < end; ++e) {
        bool pane = facetAt(kFacetVectors * entryAt(e)).w == kSeeThrough;
        panes = panes || pane;
        float far = pane ? kNever : meetTriangle(ray, entryAt(e), share);
        if (far >= from && far < hit.far) hit = Hit(far, params.cells.w + entryAt(e), false);
    }
    for (uint e = begin; e < end && panes; ++e) {
        bool pane = facetAt(kFacetVectors * entryAt(e)).w == kSeeThrough;
        float far = pane ? meetTriangle(ray, entryAt(e), share) : kNever;
        if (far < from || far >= min(edge, hit.far)) continue;
        // A thin wall takes more light where it is seen aslant.
        float slope = abs(dot(ray.way, normalize(facetNormal(entryAt(e)))));
        clear *= 1.0 - (0.07 + 0.4 * pow(max(1.0 - slope, 0.0), 3.0));
    }
}

/// The first thing on a ray's way, cell by cell.
Hit firstHit(Ray ray) {
    Hit hit = Hit(kNever, kNothing, false);
    vec3 high = params.box.xyz + params.box.w * vec3(params.cells.xyz);
    vec3 way = mix(ray.way, vec3(1e-12), lessThan(abs(ray.way), vec3(1e-12)));
    vec3 a = (params.box.xyz - ray.origin) / way, b = (high - ray.origin) / way;
    vec3 first = min(a, b), last = max(a, b);
    float enter = max(max(first.x, first.y), first.z), leave = min(min(last.x, last.y), last.z);
    bool opened = false;
    if (isCut()) {
        float cut = (params.cut.w - dot(params.cut.xyz, ray.origin)) / dot(params.cut.xyz, ray.way);
        opened = cut > enter;
        enter = max(enter, cut);
    }
    if (enter >= leave) return hit;
    if (opened) hit = openedAt(ray.origin + enter * ray.way, enter);

    ivec3 cell = cellOf(ray.origin + enter * ray.way);
    ivec3 turn = ivec3(sign(way));
    vec3 stride = params.box.w / abs(way);
    vec3 next = (params.box.xyz + params.box.w * vec3(cell + max(turn, 0)) - ray.origin) / way;
    bool under = hit.what == kNothing;
    float from = enter;
    uint most = params.cells.x + params.cells.y + params.cells.z;
    for (uint n = 0u; n < most && under; ++n) {
        uint number = cellAt(cell);
        uvec4 part = partsAt(number);
        for (uint e = beginOf(number); e < part.x; ++e) {
            vec4 s = sphereAt(entryAt(e));
            float far = enterSphere(ray, s.xyz, s.w);
            if (far >= enter && far < hit.far) hit = Hit(far, entryAt(e), false);
        }
        for (uint e = part.x; e < part.y; ++e) {
            float far = enterWire(ray, jointAt(entryAt(e)).xyz, jointAt(entryAt(e) + 1u).xyz, params.wire.w);
            if (far >= enter && far < hit.far) hit = Hit(far, params.size.z + entryAt(e), false);
        }
        float edge = min(min(next.x, next.y), next.z);
        meetFacets(ray, part.y, part.z, from, edge, hit);
        from = edge;
        bvec3 axis = next.x <= edge   ? bvec3(true, false, false)
                     : next.y <= edge ? bvec3(false, true, false)
                                      : bvec3(false, false, true);
        cell += mix(ivec3(0), turn, axis);
        next += mix(vec3(0.0), stride, axis);
        bool within = all(greaterThanEqual(cell, ivec3(0))) && all(lessThan(cell, ivec3(params.cells.xyz)));
        under = within && hit.far > edge;
    }
    // A solid that is first seen from within was opened by the cut.
    if (opened && hit.what != kNothing && hit.what >= params.cells.w) {
        uint i = hit.what - params.cells.w;
        bool within = facetAt(kFacetVectors * i).w == kSolid && dot(facetNormal(i), ray.way) > 0.0;
        if (within) hit = Hit(enter, hit.what, true);
    }
    return hit;
}

/// The part of the sky that a point sees past the spheres around it. Each sphere takes cos (r/d)^2, as it would from a
/// point with nothing else around, and less towards the end of its reach.
float openness(vec3 p, vec3 normal) {
    uvec4 part = partsAt(cellAt(cellOf(p)));
    float open = 1.0;
    for (uint e = part.z; e < part.w; ++e) {
        vec4 s = sphereAt(entryAt(e));
        vec3 to = s.xyz - p;
        float square = dot(to, to), size = s.w * s.w;
        float taken = max(dot(to, normal) * inversesqrt(square), 0.0) * size / square;
        float fade = max(1.0 - square / (kReach * kReach * size), 0.0);
        bool gone = isCut() && dot(params.cut.xyz, s.xyz) > params.cut.w;
        open *= gone ? 1.0 : 1.0 - min(taken, 1.0) * fade;
    }
    return open;
}

/// The side of a body that is seen, smooth between its corners.
vec3 bodyNormal(Ray ray, uint i) {
    vec3 share;
    meetTriangle(ray, i, share);
    vec3 normal = normalize(mat3(facetAt(kFacetVectors * i + 3u).xyz, facetAt(kFacetVectors * i + 4u).xyz,
                                 facetAt(kFacetVectors * i + 5u).xyz) * share);
    return dot(facetNormal(i), ray.way) > 0.0 ? -normal : normal;
}

vec3 wireNormal(vec3 p, uint piece) {
    // The angle is interpolated between the joints, and the centre line follows from it, so that there are no facets.
    vec4 a = jointAt(piece), b = jointAt(piece + 1u);
    vec3 way = b.xyz - a.xyz;
    float share = clamp(dot(p - a.xyz, way) / dot(way, way), 0.0, 1.0), angle = mix(a.w, b.w, share);
    vec3 centre = vec3(params.wire.xy + params.wire.z * vec2(cos(angle), sin(angle)), mix(a.z, b.z, share));
    return normalize(p - centre);
}

/// A cut surface is flat and bright, with a dark rim.
vec3 shadeFace(vec3 p, Hit hit) {
    bool steel = hit.what >= params.size.z;
    if (steel) return 1.35 * kSteel;
    vec4 s = sphereAt(hit.what);
    float h = dot(params.cut.xyz, s.xyz) - params.cut.w;
    float disc = sqrt(max(s.w * s.w - h * h, 0.0)), off = length(p - (s.xyz - h * params.cut.xyz));
    return paintAt(hit.what).rgb * (disc - off < 0.1 * s.w ? 0.45 : 1.0);
}

vec3 shade(Ray ray, Hit hit) {
    vec3 p = ray.origin + hit.far * ray.way;
    if (hit.face) return shadeFace(p, hit);
    bool body = hit.what >= params.cells.w, steel = hit.what >= params.size.z;
    vec3 normal = body    ? bodyNormal(ray, hit.what - params.cells.w)
                  : steel ? wireNormal(p, hit.what - params.size.z)
                          : (p - sphereAt(hit.what).xyz) / sphereAt(hit.what).w;
    vec3 colour = steel ? kSteel : paintAt(hit.what).rgb;
    float open = openness(p, normal), sun = max(dot(normal, params.light.xyz), 0.0);
    vec3 seen = colour * (kSky * open + kSun * sun * (0.5 + 0.5 * open));
    float gleam = pow(max(dot(normal, normalize(params.light.xyz - ray.way)), 0.0), 40.0);
    return seen + (steel ? 0.35 * gleam * open : 0.0);
}

vec3 encoded(vec3 c) {  // sRGB, IEC 61966-2-1
    c = clamp(c, 0.0, 1.0);
    return mix(1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, 12.92 * c, lessThanEqual(c, vec3(0.0031308)));
}

void main() {
    params = given;
    uvec2 at = gl_GlobalInvocationID.xy;
    if (at.x >= params.size.x || at.y >= params.size.y) return;
    uint side = params.size.w;
    vec3 sum = vec3(0.0);
    float cover = 0.0, depth = -kNever;
    for (uint k = 0u; k < side * side; ++k) {
        Ray ray = rayThrough(vec2(at) + (vec2(k % side, k / side) + 0.5) / float(side));
        clear = 1.0;
        Hit hit = firstHit(ray);
        sum += (1.0 - clear) * kPane;
        if (hit.what == kNothing) {
            cover += 1.0 - clear;
        } else {
            sum += clear * shade(ray, hit);
            cover += 1.0;
            depth = max(depth, dot(ray.origin + hit.far * ray.way - params.target.xyz, params.towards.xyz));
        }
    }
    vec4 colour = vec4(encoded(cover > 0.0 ? sum / cover : vec3(0.0)), cover / float(side * side));
    picture[at.y * params.size.x + at.x] = uvec2(packUnorm4x8(colour), floatBitsToUint(depth));
}
