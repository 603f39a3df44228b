// The places where a mesh touches a sphere (geometry/mesh_surface.h): local minima of the distance. A place is the foot
// of the centre on a face, if it lies in it; on an edge, if the direction to the centre leads into neither face; a
// vertex, if it leads along none of its edges.
//
// Most triangles of a cell are out of reach. So the work is done in rounds of three steps, each for what the one before
// has left over: a coarse test of triangles, in plain floats; for a few of them a closer look, still in plain floats,
// which tells the parts that may be a place; for these parts the exact computation. What is in doubt goes on to the
// next step: `margin` is more than the error of the plain floats. The exact tests overlap by kSquare, so that a place
// between two parts is found by one of them at least; found by both, it is one feature. Each edge and vertex belongs to
// one of its triangles, so that it is looked at once.
//
// The including file defines uvec4 geometryAt(uint i): vector i of the table `geometry`.
//
//   shape     2: low corner of the grid, 1 / edge of a cell      3: numbers of cells, margin [m]
//             4: triangles, edges, vertices, - (where their records begin)      5: numbers of triangles, of edges
//   heads     of two cells: list (of triangles, by vectors), how many, the same of the next cell
//   lists     four triangles
//   triangle  0: centre of a sphere around it, radius    1: normal, word of corner 2    2: corner 0, word of edge 0
//             3: low part of corner 0, word of edge 1    4: low part of the normal, word of edge 2
//             5: from corner 0 to 1, word of corner 0    6: from corner 0 to 2, word of corner 1
//             The word of an edge: number << 2 | 2 if it belongs to this triangle | which of its faces this is.
//             The word of a corner: number of the vertex << 1 | 1 if it belongs to this triangle.
//             Edge i leads from corner i to the next. Edge 1 is the longest.
//   edge      0: begin, second face's x   1: its low part, second face's y   2: unit direction, second face's z
//             3: its low part, length     4: first face, low part of the length
//             The vector of a face leads from the edge into it, square to the edge, unit; zero where there is none.
//   vertex    0: place, where its edges begin     1: low part, how many there are
//             Each of its edges takes one vector, the unit direction from it.
#ifndef VKDOSE_LAW_MESH_GLSL
#define VKDOSE_LAW_MESH_GLSL

#include "law/places.glsl"
#include "law/twoproduct.glsl"

const float kSquare = 1e-6;  // directions count as square to each other to this
const uint kPending = 8u;    // triangles of a round
const uint kNotAFace = 0xffffffffu;

vec4 realsAt(uint i) { return uintBitsToFloat(geometryAt(i)); }

/// Where the list of the cell around a point begins, and how many triangles it has.
uvec2 cellList(uint shape, uint heads, vec3 centre) {
    vec4 corner = realsAt(shape + 2u);
    uvec3 cells = geometryAt(shape + 3u).xyz;
    vec3 x = floor((centre - corner.xyz) * corner.w);
    bool inside = all(greaterThanEqual(x, vec3(0.0))) && all(lessThan(x, vec3(cells)));
    uvec3 cell = uvec3(clamp(x, vec3(0.0), vec3(cells - 1u)));
    uint c = cell.x + cells.x * (cell.y + cells.y * cell.z);
    uvec4 two = geometryAt(heads + c / 2u);
    uvec2 list = (c & 1u) == 0u ? two.xy : two.zw;
    return inside ? list : uvec2(0u);
}

/// Whether a triangle may have a point within `reach` of a point. Never wrongly false.
bool mayReach(uint triangle, vec3 centre, float reach) {
    vec4 around = realsAt(triangle);
    vec3 normal = realsAt(triangle + 1u).xyz;
    vec3 x = centre - around.xyz;
    float height = dot(normal, x), far = dot(x, x);
    float rest = reach * reach - height * height;
    float room = around.w + sqrt(max(rest, 0.0));
    return rest > 0.0 && far - height * height < room * room + 1e-6 * far;
}

uint nthTriangle(uint lists, uint list, uint n) { return geometryAt(lists + list + n / 4u)[n & 3u]; }

/// An edge of a triangle as plain floats see it from the centre.
struct EdgeView {
    float side;    // how far inside the triangle the foot lies, from the edge [m]
    float past;    // from the edge's begin, along it [m]
    float beyond;  // from its end [m]
    float away2;   // squared distance of its line
};

EdgeView edgeView(vec3 fromBegin, vec3 edge, vec3 normal) {
    float size = length(edge);
    vec3 e = edge / size;
    float past = dot(fromBegin, e);
    vec3 off = fromBegin - past * e;
    return EdgeView(dot(cross(normal, e), fromBegin), past, past - size, dot(off, off));
}

/// An edge's share in the answer. Where the foot on face number `face` lies beyond the edge, strikes that face out.
void edgePlace(uint edges, uint word, uint face, uint firstTag, Two3 centre, float radius) {
    uint at = edges + kEdgeVectors * (word >> 2);
    vec4 begin = realsAt(at), beginLow = realsAt(at + 1u), along = realsAt(at + 2u), alongLow = realsAt(at + 3u);
    vec4 first = realsAt(at + 4u);
    vec3 second = vec3(begin.w, beginLow.w, along.w);
    Two3 e = Two3(along.xyz, alongLow.xyz);
    Two3 d = twoDifference(centre.high, centre.low, begin.xyz, beginLow.xyz);
    vec2 past = twoDot(d, e);
    precise float beyond = (past.x - alongLow.w) + (past.y - first.w);
    Two3 off = twoLess(d, past, e);
    float away = length(off.high);
    vec3 u = away > 0.0 ? off.high / away : normalize(cross(first.xyz, e.high));
    float depth = differenceOfSquares(vec2(radius, 0.0), off) / (radius + away);
    float intoFirst = dot(u, first.xyz), intoSecond = dot(u, second);
    if (face != kNotAFace && ((word & 1u) == 0u ? intoFirst : intoSecond) < -kSquare) dropPlace(face);
    bool isPlace = (word & 2u) != 0u && past.x > 0.0 && beyond < 0.0 && max(intoFirst, intoSecond) <= kSquare;
    if (isPlace && depth > 0.0) addPlace(depth, u, firstTag + (word >> 2));
}

void vertexPlace(uint vertices, uint number, uint firstTag, Two3 centre, float radius) {
    uint at = vertices + kVertexVectors * number;
    uvec4 place = geometryAt(at), placeLow = geometryAt(at + 1u);
    Two3 d = twoDifference(centre.high, centre.low, uintBitsToFloat(place.xyz), uintBitsToFloat(placeLow.xyz));
    float away = length(d.high);
    float depth = differenceOfSquares(vec2(radius, 0.0), d) / (radius + away);
    bool isPlace = depth > 0.0;
    uint k = 0u;
    for (; k < placeLow.w && isPlace; ++k) isPlace = dot(realsAt(place.w + k).xyz, d.high) <= kSquare * away;
    if (isPlace && k < placeLow.w) placesLost = true;
    if (isPlace) addPlace(depth, away > 0.0 ? d.high / away : vec3(0.0, 0.0, 1.0), firstTag + number);
}

/// Adds the places of the mesh to the list. `shape` is its record, `head` the first vector of it.
void meshPlaces(uint shape, uvec4 head, Two3 centre, float radius) {
    float margin = uintBitsToFloat(geometryAt(shape + 3u).w);
    uvec4 starts = geometryAt(shape + 4u);
    uint firstEdge = head.y + geometryAt(shape + 5u).x, firstVertex = firstEdge + geometryAt(shape + 5u).y;
    uvec2 list = cellList(shape, head.z, centre.high);
    float reach = radius + margin, reach2 = reach * reach;

    uint pending[kPending];
    uvec2 pendingEdges[3u * kPending];  // word, face to strike out
    uint pendingVertices[3u * kPending];
    uint n = 0u;
    for (uint round = 0u; round < kMostInCell && n < list.y; ++round) {
        uint triangles = 0u, edges = 0u, vertices = 0u;
        for (; n < list.y && triangles < kPending; ++n) {
            uint t = nthTriangle(head.w, list.x, n);
            if (mayReach(starts.x + kTriangleVectors * t, centre.high, reach)) pending[triangles++] = t;
        }
        for (uint k = 0u; k < triangles; ++k) {
            uint t = pending[k], at = starts.x + kTriangleVectors * t;
            uvec4 v1 = geometryAt(at + 1u), v2 = geometryAt(at + 2u), v3 = geometryAt(at + 3u);
            uvec4 v4 = geometryAt(at + 4u), v5 = geometryAt(at + 5u), v6 = geometryAt(at + 6u);
            Two3 d = twoDifference(centre.high, centre.low, uintBitsToFloat(v2.xyz), uintBitsToFloat(v3.xyz));
            vec3 normal = uintBitsToFloat(v1.xyz);
            vec3 to1 = uintBitsToFloat(v5.xyz), to2 = uintBitsToFloat(v6.xyz);
            vec3 from1 = d.high - to1, from2 = d.high - to2;
            EdgeView a = edgeView(d.high, to1, normal), b = edgeView(from1, to2 - to1, normal);
            EdgeView c = edgeView(from2, -to2, normal);

            vec2 height = twoDot(d, Two3(normal, uintBitsToFloat(v4.xyz)));
            float up = height.x < 0.0 ? -1.0 : 1.0;
            precise float depth = (radius - up * height.x) - up * height.y;
            bool face = depth > 0.0 && min(min(a.side, b.side), c.side) > -margin;
            if (face) addPlace(depth, up * normal, head.y + t);

            // Edges where the foot may be outside, with a place within reach, or where the face is in doubt.
            uvec3 words = uvec3(v2.w, v3.w, v4.w);
            bvec3 outside = lessThan(vec3(a.side, b.side, c.side), vec3(margin));
            vec3 past = vec3(a.past, b.past, c.past), beyond = vec3(a.beyond, b.beyond, c.beyond);
            vec3 away2 = vec3(a.away2, b.away2, c.away2);
            for (uint i = 0u; i < 3u; ++i) {
                bool own = (words[i] & 2u) != 0u && past[i] > -margin && beyond[i] < margin && away2[i] < reach2;
                if (outside[i] && (own || face)) pendingEdges[edges++] = uvec2(words[i], face ? head.y + t : kNotAFace);
            }
            // Corners that the centre lies beyond, as both their edges see it.
            if ((v5.w & 1u) != 0u && a.past < margin && c.beyond > -margin && dot(d.high, d.high) < reach2)
                pendingVertices[vertices++] = v5.w >> 1;
            if ((v6.w & 1u) != 0u && b.past < margin && a.beyond > -margin && dot(from1, from1) < reach2)
                pendingVertices[vertices++] = v6.w >> 1;
            if ((v1.w & 1u) != 0u && c.past < margin && b.beyond > -margin && dot(from2, from2) < reach2)
                pendingVertices[vertices++] = v1.w >> 1;
        }
        for (uint k = 0u; k < edges; ++k)
            edgePlace(starts.y, pendingEdges[k].x, pendingEdges[k].y, firstEdge, centre, radius);
        for (uint k = 0u; k < vertices; ++k)
            vertexPlace(starts.z, pendingVertices[k], firstVertex, centre, radius);
    }
    if (n < list.y) placesLost = true;
}

/// Whether a triangle of the mesh may come within `reach` of the centre. Never wrongly false.
bool mayTouchMesh(uint shape, uvec4 head, vec3 centre, float reach) {
    float margin = uintBitsToFloat(geometryAt(shape + 3u).w);
    uint triangles = geometryAt(shape + 4u).x;
    uvec2 list = cellList(shape, head.z, centre);
    bool may = false;
    for (uint n = 0u; n < list.y && !may; ++n)
        may = mayReach(triangles + kTriangleVectors * nthTriangle(head.w, list.x, n), centre, reach + margin);
    return may;
}

#endif
