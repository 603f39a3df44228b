// The places where a mesh touches a sphere (geometry/mesh_surface.h): local minima of the distance. A place is the foot
// of the centre on a face, if it lies in it; on an edge, if the direction to the centre leads into neither face; a
// vertex, if it leads along none of its edges.
//
// Most triangles of a cell are out of reach. So the work is done in three steps, each for what the one before has left
// over: a coarse test of 32 triangles, in plain floats; for a few of them a closer look, still in plain floats, which
// tells the parts that may be a place; for these parts the exact computation. What is in doubt goes on to the next
// step: `margin` is more than the error of the plain floats. The exact tests overlap by kSquare, so that a place
// between two parts is found by one of them at least; found by both, it is one feature. Each edge and vertex belongs to
// one of its triangles, so that it is looked at once. What a step leaves over is kept as bits of a word: lavapipe takes
// minutes to compile arrays with many readers.
//
// A sphere that stays near where it is needs the first two steps once: partsToCome gives the parts of a triangle that
// may be a place until it has gone a given way. Where such a list was made, only the third step is left.
//
// The including file defines uvec4 geometryAt(uint i): vector i of the table `geometry`; and uint nearbyAt(uint i):
// entry i of the list near the sphere, triangle << kPartBits | parts, if it sets `nearbyCount`. One that makes lists
// defines KEEPS_NEARBY, and keepNearby(uint i, uint entry).
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
const uint kRound = 32u;     // triangles of a round, one bit of a word each
// So many entries of nearbyAt hold all that can be a place. kWholeCell: there is no list, and all of the cell may be.
const uint kWholeCell = 0xffffffffu;
uint nearbyCount = kWholeCell;

vec4 realsAt(uint i) { return uintBitsToFloat(geometryAt(i)); }

/// Where the list of the cell around a point begins, and how many triangles it has.
uvec2 cellList(uint shape, uint heads, vec3 centre) {
    vec4 corner = realsAt(shape + 2u);
    uvec3 size = geometryAt(shape + 3u).xyz;
    vec3 x = floor((centre - corner.xyz) * corner.w);
    bool inside = all(greaterThanEqual(x, vec3(0.0))) && all(lessThan(x, vec3(size)));
    uvec3 cell = uvec3(clamp(x, vec3(0.0), vec3(size - 1u)));
    uint c = cell.x + size.x * (cell.y + size.y * cell.z);
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

/// Of four triangles of a list, from number n on, a bit for each that may have a point within `reach` of a point.
uint reachAmongFour(uint lists, uvec2 list, uint n, uint triangles, vec3 centre, float reach) {
    uvec4 at = triangles + kTriangleVectors * geometryAt(lists + list.x + n / 4u);
    uint last = list.y - 1u;
    uint left = mayReach(at.x, centre, reach) ? 1u : 0u;
    if (n + 1u <= last && mayReach(at.y, centre, reach)) left |= 2u;
    if (n + 2u <= last && mayReach(at.z, centre, reach)) left |= 4u;
    if (n + 3u <= last && mayReach(at.w, centre, reach)) left |= 8u;
    return left;
}

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

/// A place to be: it is one if `depth` > 0.
struct MeshPlace {
    float depth;
    vec3 direction;
    float intoOwn;  // of an edge: how far the direction leads into the face that asks
    uint bend;      // how the direction turns (law/passes.glsl)
};

/// Of an edge, as its triangle's word names it.
MeshPlace edgePlace(uint edges, uint word, Two3 centre, float radius) {
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
    bool isPlace = (word & 2u) != 0u && past.x > 0.0 && beyond < 0.0 && max(intoFirst, intoSecond) <= kSquare;
    return MeshPlace(isPlace ? depth : -1.0, u, (word & 1u) == 0u ? intoFirst : intoSecond,
                     bendOfEdge(e.high));
}

MeshPlace vertexPlace(uint vertices, uint number, Two3 centre, float radius) {
    uint at = vertices + kVertexVectors * number;
    uvec4 place = geometryAt(at), placeLow = geometryAt(at + 1u);
    Two3 d = twoDifference(centre.high, centre.low, uintBitsToFloat(place.xyz), uintBitsToFloat(placeLow.xyz));
    float away = length(d.high);
    float depth = differenceOfSquares(vec2(radius, 0.0), d) / (radius + away);
    bool isPlace = depth > 0.0;
    uint k = 0u;
    for (; k < placeLow.w && isPlace; ++k) isPlace = dot(realsAt(place.w + k).xyz, d.high) <= kSquare * away;
    if (isPlace && k < placeLow.w) placesLost = true;
    return MeshPlace(isPlace ? depth : -1.0, away > 0.0 ? d.high / away : vec3(0.0, 0.0, 1.0), 0.0, kAtCorner);
}

// Parts of a triangle, as bits: three edges, three corners, the face.
const uint kPartCorner = 8u;
const uint kPartFace = 64u;
const uint kPartBits = 7u;
const uint kAllParts = 127u;
const uint kPartsInWord = 4u;  // of so many triangles

uint edgeWord(uint at, uint n) { return geometryAt(at + 2u + n).w; }
uint cornerWord(uint at, uint n) { return geometryAt(at + (n == 2u ? 1u : 5u + n)).w; }

/// The parts of a triangle that may be a place, as plain floats tell, and those edges that decide about its face.
uint partsInReach(uint at, Two3 centre, float radius, float margin) {
    uvec4 v1 = geometryAt(at + 1u), v2 = geometryAt(at + 2u), v3 = geometryAt(at + 3u);
    uvec4 v5 = geometryAt(at + 5u), v6 = geometryAt(at + 6u);
    uint word2 = geometryAt(at + 4u).w;
    vec3 d = twoDifference(centre.high, centre.low, uintBitsToFloat(v2.xyz), uintBitsToFloat(v3.xyz)).high;
    vec3 normal = uintBitsToFloat(v1.xyz);
    vec3 to1 = uintBitsToFloat(v5.xyz), to2 = uintBitsToFloat(v6.xyz);
    vec3 from1 = d - to1, from2 = d - to2;
    EdgeView a = edgeView(d, to1, normal), b = edgeView(from1, to2 - to1, normal), c = edgeView(from2, -to2, normal);
    float reach = radius + margin, reach2 = reach * reach;

    bool face = abs(dot(normal, d)) < reach && min(min(a.side, b.side), c.side) > -margin;
    uint parts = face ? kPartFace : 0u;
    // Edges where the foot may be outside, with a place within reach, or where the face is in doubt.
    bvec3 own = bvec3((v2.w & 2u) != 0u && a.past > -margin && a.beyond < margin && a.away2 < reach2,
                      (v3.w & 2u) != 0u && b.past > -margin && b.beyond < margin && b.away2 < reach2,
                      (word2 & 2u) != 0u && c.past > -margin && c.beyond < margin && c.away2 < reach2);
    if (a.side < margin && (own.x || face)) parts |= 1u;
    if (b.side < margin && (own.y || face)) parts |= 2u;
    if (c.side < margin && (own.z || face)) parts |= 4u;
    // Corners that the centre lies beyond, as both their edges see it.
    if ((v5.w & 1u) != 0u && a.past < margin && c.beyond > -margin && dot(d, d) < reach2) parts |= kPartCorner;
    if ((v6.w & 1u) != 0u && b.past < margin && a.beyond > -margin && dot(from1, from1) < reach2)
        parts |= kPartCorner << 1;
    if ((v1.w & 1u) != 0u && c.past < margin && b.beyond > -margin && dot(from2, from2) < reach2)
        parts |= kPartCorner << 2;
    return parts;
}

MeshPlace facePlace(uint at, Two3 centre, float radius) {
    vec3 normal = realsAt(at + 1u).xyz, corner = realsAt(at + 2u).xyz, cornerLow = realsAt(at + 3u).xyz;
    Two3 d = twoDifference(centre.high, centre.low, corner, cornerLow);
    vec2 height = twoDot(d, Two3(normal, realsAt(at + 4u).xyz));
    float up = height.x < 0.0 ? -1.0 : 1.0;
    precise float depth = (radius - up * height.x) - up * height.y;
    return MeshPlace(depth, up * normal, 0.0, kFlat);
}

/// Whether an edge may be a place, as far as its two faces tell in plain floats.
bool edgeMayLead(uint edges, uint word, vec3 centre, float margin) {
    uint at = edges + kEdgeVectors * (word >> 2);
    vec4 begin = realsAt(at), beginLow = realsAt(at + 1u), along = realsAt(at + 2u);
    vec3 first = realsAt(at + 4u).xyz, second = vec3(begin.w, beginLow.w, along.w);
    vec3 d = centre - begin.xyz;
    vec3 off = d - dot(d, along.xyz) * along.xyz;
    return max(dot(off, first), dot(off, second)) <= margin + kSquare * length(off);
}

/// The same of a vertex, as far as its edges tell.
bool vertexMayLead(uint vertices, uint word, vec3 centre, float margin) {
    uvec4 place = geometryAt(vertices + kVertexVectors * (word >> 1));
    uint edges = geometryAt(vertices + kVertexVectors * (word >> 1) + 1u).w;
    vec3 d = centre - uintBitsToFloat(place.xyz);
    float most = margin + kSquare * length(d);
    bool may = true;
    for (uint k = 0u; k < edges && may; ++k) may = dot(realsAt(place.w + k).xyz, d) <= most;
    return may;
}

/// The parts of a triangle that may be a place, or that decide about one, until the centre has gone `slack`.
uint partsToCome(uint at, uvec3 starts, Two3 centre, float radius, float margin, float slack) {
    float room = margin + slack;
    uint parts = partsInReach(at, centre, radius, room);
    bool face = (parts & kPartFace) != 0u;  // its edges decide about it
    for (uint n = 0u; n < 3u; ++n) {
        bool edge = (parts >> n & 1u) != 0u && !face;
        if (edge && !edgeMayLead(starts.y, edgeWord(at, n), centre.high, room)) parts &= ~(1u << n);
        bool corner = (parts & kPartCorner << n) != 0u;
        if (corner && !vertexMayLead(starts.z, cornerWord(at, n), centre.high, room)) parts &= ~(kPartCorner << n);
    }
    return parts;
}

/// Adds the place of a part of a triangle, if it is one. `at` is the triangle's record, `tags` are the first ones of
/// faces, edges and vertices. `inFace` is true before a triangle's first part; its face comes last, when its edges have
/// had their say.
void partPlace(uint at, uint triangle, uint part, uvec3 starts, uvec3 tags, Two3 centre, float radius,
               inout bool inFace) {
    MeshPlace place;
    uint tag;
    if (part < 3u) {
        uint word = edgeWord(at, part);
        place = edgePlace(starts.y, word, centre, radius);
        tag = tags.y + (word >> 2);
        inFace = inFace && place.intoOwn >= -kSquare;
    } else if (part < 6u) {
        uint number = cornerWord(at, part - 3u) >> 1;
        place = vertexPlace(starts.z, number, centre, radius);
        tag = tags.z + number;
    } else {
        place = facePlace(at, centre, radius);
        tag = tags.x + triangle;
        if (!inFace) place.depth = -1.0;
    }
    if (place.depth > 0.0) addPlace(place.depth, place.direction, tag, place.bend);
}

/// Adds the places of the mesh to the list. `shape` is its record, `head` the first vector of it.
void meshPlaces(uint shape, uvec4 head, Two3 centre, float radius) {
    float margin = uintBitsToFloat(geometryAt(shape + 3u).w);
    uvec3 starts = geometryAt(shape + 4u).xyz;
    uvec2 numbers = geometryAt(shape + 5u).xy;
    uvec3 tags = uvec3(head.y, head.y + numbers.x, head.y + numbers.x + numbers.y);
    bool known = nearbyCount != kWholeCell;
    uvec2 list = uvec2(0u, nearbyCount);
    if (!known) list = cellList(shape, head.z, centre.high);
    // These loops leave at their end when they are through (shaders/README.md, Drivers).
    uint end = 0u;
    for (uint n = 0u; n < list.y; n += kRound) {
        uint left = 0u;
        end = min(n + kRound, list.y);
        for (uint k = n; k < end; k += 4u) {
            if (!known) left |= reachAmongFour(head.w, list, k, starts.x, centre.high, radius + margin) << (k - n);
            if (known || k + 4u >= end) break;
        }
        if (known) left = 0xffffffffu >> (kRound - (end - n));
        // A few at a time, so that their parts find room in one word.
        while (left != 0u) {
            uint touching = 0u, packed = 0u, taken = 0u;
            if (known) {
                touching = left;
                left = 0u;
            }
            while (left != 0u) {
                uint bit = left & (~left + 1u);
                left &= left - 1u;
                uint at = starts.x + kTriangleVectors * nthTriangle(head.w, list.x, n + uint(findLSB(bit)));
                uint here = partsInReach(at, centre, radius, margin);
                packed |= here << (kPartBits * taken);
                if (here != 0u) {
                    touching |= bit;
                    ++taken;
                }
                if (left == 0u || taken == kPartsInWord) break;
            }
            // One loop over the parts of all these triangles: two loops would wait for the longest twice.
            uint parts = 0u, triangle = 0u;
            bool inFace = true;
            while ((touching | parts) != 0u) {
                if (parts == 0u && touching != 0u) {
                    uint nth = n + uint(findLSB(touching));
                    touching &= touching - 1u;
                    if (known) parts = nearbyAt(nth);
                    if (!known) parts = nthTriangle(head.w, list.x, nth) << kPartBits | packed & kAllParts;
                    packed >>= kPartBits;
                    triangle = parts >> kPartBits;
                    parts &= kAllParts;
                    inFace = true;
                }
                if (parts != 0u) {
                    uint part = uint(findLSB(parts));
                    parts &= parts - 1u;
                    uint at = starts.x + kTriangleVectors * triangle;
                    partPlace(at, triangle, part, starts, tags, centre, radius, inFace);
                }
                if ((touching | parts) == 0u) break;
            }
            placesLost = placesLost || (touching | parts) != 0u;
            if (left == 0u) break;
        }
        placesLost = placesLost || left != 0u;
        if (end == list.y) break;
    }
    placesLost = placesLost || end != list.y;
}

/// The number of features of a sphere near which there is only the face of one triangle, the first of its list.
uint touchedFace(uint body, Two3 centre, float radius) {
    uint shape = geometryAt(kBodyVectors * body).x;
    uint triangle = nearbyAt(0u) >> kPartBits;
    MeshPlace place = facePlace(geometryAt(shape + 4u).x + kTriangleVectors * triangle, centre, radius);
    features[0] = BodyFeature(place.depth, place.direction, geometryAt(shape).y + triangle, 1.0);
    return place.depth > 0.0 ? 1u : 0u;
}

#ifdef KEEPS_NEARBY
/// Makes the list near a sphere: all that may be a place until its centre has gone `slack` in the body's frame. Gives
/// the number of entries, or kWholeCell if there are more than the list holds. The sphere's radius and the slack
/// together must not be more than the reach for which the table was packed.
uint listNearby(uint shape, uvec4 head, Two3 centre, float radius, float slack) {
    float margin = uintBitsToFloat(geometryAt(shape + 3u).w);
    uvec3 starts = geometryAt(shape + 4u).xyz;
    uvec2 list = cellList(shape, head.z, centre.high);
    // First the triangles within reach, then what of them may be a place.
    uint found = 0u, k = 0u;
    for (; k < list.y && found < kSortedWord; ++k) {
        uint t = nthTriangle(head.w, list.x, k);
        if (!mayReach(starts.x + kTriangleVectors * t, centre.high, radius + slack + margin)) continue;
        if (found + 1u < kSortedWord) keepNearby(found, t);
        ++found;
    }
    if (k < list.y || found == kSortedWord) return kWholeCell;
    uint kept = 0u;
    for (k = 0u; k < found; ++k) {
        uint t = nearbyAt(k);
        uint parts = partsToCome(starts.x + kTriangleVectors * t, starts, centre, radius, margin, slack);
        if (parts != 0u) keepNearby(kept++, t << kPartBits | parts);
    }
    return kept;
}
#endif

/// Whether a triangle of the mesh may come within `reach` of the centre. Never wrongly false.
bool mayTouchMesh(uint shape, uvec4 head, vec3 centre, float reach) {
    float margin = uintBitsToFloat(geometryAt(shape + 3u).w);
    uint triangles = geometryAt(shape + 4u).x;
    uvec2 list = cellList(shape, head.z, centre);
    uint found = 0u, n = 0u;
    for (; n < list.y && found == 0u; n += 4u)
        found = reachAmongFour(head.w, list, n, triangles, centre, reach + margin);
    return found != 0u || n < list.y;
}

#endif
