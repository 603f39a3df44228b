#version 450
// neighbours: builds the rows, sorted by index.
// Reads state and cells; writes rows, their ranges and the anchors of the rows. A row lists every particle closer than
// the sum of radii + reach of contacts + skin, so it stays complete until some particle has moved half the skin from
// its anchor. Where in the table a row lies depends on timing; nothing that moves a particle depends on it.
//
// In a direction that repeats, a particle near an end of the domain is also sought around its images beyond the other
// end. Cells are those of the places as they are: a cell that stood for another one would not have a slot of its own.
//
// One loop goes through all chains of the 27 cells, so that no lane waits at the end of each chain for the longest one.
// A row is sorted in registers, sixteen at a time: lavapipe takes five times as long with an array that it must index.
// A row that is longer is found in several searches, each for the sixteen that follow.
#extension GL_GOOGLE_include_directive : require
#include "shared/buffers.glsl"
#include "shared/cells.glsl"
#include "law/reach.glsl"

// The most particles that are looked at for one row. Sizes of spheres for which kMaxRow is enough stay far below.
// lavapipe silently ends all loops of a subgroup after 65535 trips together. The searches for a row of kMaxRow with
// this many visits stay below.
const uint kMostVisits = 4096u;
const uint kCells = 27u;

/// The sixteen least of what was kept, ascending.
struct Kept {
    uvec4 a, b, c, d;
};

/// Each place takes the middle one of three: what it holds, what the place before it holds, and the new one.
void keep(inout Kept k, uint j) {
    k.d = max(uvec4(k.c.w, k.d.xyz), min(k.d, j));
    k.c = max(uvec4(k.b.w, k.c.xyz), min(k.c, j));
    k.b = max(uvec4(k.a.w, k.b.xyz), min(k.b, j));
    k.a = max(uvec4(0u, k.a.xyz), min(k.a, j));
}

/// Which of three cells beside each other along x are within reach, a bit each. `squares`: of the distances to them.
uint three(vec3 squares, float rest, float reach) {
    bvec3 near = lessThan(squares + rest, vec3(reach));
    return (near.x ? 1u : 0u) | (near.y ? 2u : 0u) | (near.z ? 4u : 0u);
}
uint nine(vec3 x, vec3 y, float z, float reach) {
    return three(x, y.x + z, reach) | three(x, y.y + z, reach) << 3u | three(x, y.z + z, reach) << 6u;
}

/// The cells, of the 27 around `at`, that have a point within `reach`, a bit each. Both are in cells. The margin covers
/// the rounding of places in cells.
uint cellsInReach(vec3 at, float reach) {
    vec3 low = at - floor(at), high = 1.0 - low, far = abs(at);
    low *= low;
    high *= high;
    reach = reach * 1.00001 + 1e-6 * max(far.x, max(far.y, far.z));
    reach *= reach;
    vec3 x = vec3(low.x, 0.0, high.x), y = vec3(low.y, 0.0, high.y);
    return nine(x, y, low.z, reach) | nine(x, y, 0.0, reach) << 9u | nine(x, y, high.z, reach) << 18u;
}

/// The images of a place, of the 27 by a period or none in each direction, that may have a particle within
/// `reach` [m], a bit each; the place itself is not among them. Image k is k % 3 - 1 periods farther along x, and so
/// on.
uint imagesInReach(vec3 at, float reach, Period p) {
    vec3 low = domainLow().xyz, high = domainHigh().xyz;
    bvec3 repeats = greaterThan(p.high, vec3(0.0));
    vec3 far = reach + 10.0 * kBeyondEnd * p.high;
    bvec3 up = lessThan(at, low + far), down = greaterThan(at, high - far);
    uvec3 ways = uvec3(2u) + uvec3(repeats) * (uvec3(down) + 4u * uvec3(up));
    uint x = ways.x;
    uint y = (ways.y & 1u) * x | (ways.y >> 1u & 1u) * (x << 3u) | (ways.y >> 2u) * (x << 6u);
    uint z = (ways.z & 1u) * y | (ways.z >> 1u & 1u) * (y << 9u) | (ways.z >> 2u) * (y << 18u);
    return z & ~(1u << 13u);
}

/// Image k, as above.
vec3 imageOf(vec3 at, uint k, Period p) { return at + (vec3(k % 3u, k / 3u % 3u, k / 9u) - 1.0) * p.high; }

struct Search {
    Kept kept;
    uint found;  // neighbours, kept or not
    bool ended;
};

/// Keeps neighbours of i whose index is at least `least`.
Search search(uint i, vec4 p, uint least) {
    float skin = numerics().y, size = numerics().z;
    if (reaches()) skin += longestReach();
    vec3 centre = p.xyz;
    ivec3 corner = cellOf(centre, size) - 1;
    // A cell is as wide as two of the largest spheres and the skin.
    float farthest = p.w + 0.5 * (size + skin);
    uint left = cellsInReach(centre / size, farthest / size), images = 0u;
    if (PERIODS == 1u) images = imagesInReach(centre, farthest, period());
    Search s = Search(Kept(uvec4(kEmpty), uvec4(kEmpty), uvec4(kEmpty), uvec4(kEmpty)), 0u, false);
    uint j = kEmpty, visits = 0u;
    for (; (j != kEmpty || left != 0u || images != 0u) && visits < kMostVisits + kCells; ++visits) {
        if (PERIODS == 1u && j == kEmpty && left == 0u) {
            centre = imageOf(p.xyz, uint(findLSB(images)), period());
            images &= images - 1u;
            corner = cellOf(centre, size) - 1;
            left = cellsInReach(centre / size, farthest / size);
        }
        uint at = nextIndex(j);
        if (j == kEmpty) {
            uint cell = uint(findLSB(left));
            left &= left - 1u;
            at = headIndex(self, cellSlot(corner + ivec3(cell % 3u, cell / 3u % 3u, cell / 9u)));
        }
        j = cells[at];
        uint other = j == kEmpty ? i : j;
        vec4 q = readState(source, kPosition, other);
        float reach = p.w + q.w + skin;
        vec3 d = centre - q.xyz;
        bool hit = other != i && dot(d, d) < reach * reach;
        if (hit) ++s.found;
        keep(s.kept, hit && j >= least ? j : kEmpty);
    }
    s.ended = j == kEmpty && left == 0u && images == 0u;
    return s;
}

/// Takes room for a row; returns where it begins.
uint take(uint i, inout uint count) {
    uint first = atomicAdd(control.list.x, count);
    if (first + count > push.rowEntries) {
        report(kErrorTables, i);
        count = 0u;
    }
    atomicMax(control.list.z, count);
    return first + self * push.rowEntries;
}

void write(uint first, uint count, uvec4 four) {
    if (count > 0u) rows[rowIndex(first)] = four.x;
    if (count > 1u) rows[rowIndex(first + 1u)] = four.y;
    if (count > 2u) rows[rowIndex(first + 2u)] = four.z;
    if (count > 3u) rows[rowIndex(first + 3u)] = four.w;
}

void main() {
    openMember();
    if (control.wanted.x == 0u) return;
    uint i = firstParticle() + invocation();
    vec4 p = readState(source, kPosition, i);
    uint first = 0u, count = 0u, done = 0u, least = 0u;
    bool more = p.w > 0.0;
    for (; more; more = done < count) {
        Search s = search(i, p, least);
        if (done == 0u) {
            if (!s.ended) report(kErrorCrowded, i);
            if (s.found > kMaxRow) report(kErrorRowFull, i);
            count = min(s.found, kMaxRow);
            first = take(i, count);
        }
        uint left = count - done;
        write(first + done, left, s.kept.a);
        write(first + done + 4u, left - min(left, 4u), s.kept.b);
        write(first + done + 8u, left - min(left, 8u), s.kept.c);
        write(first + done + 12u, left - min(left, 12u), s.kept.d);
        done += 16u;
        least = s.kept.d.w + 1u;
    }
    ranges[rowRangeIndex(i)].xy = uvec2(first, count);
    anchors[rowAnchorIndex(i)] = p;
}
