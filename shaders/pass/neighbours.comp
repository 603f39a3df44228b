#version 450
// neighbours: builds the rows, sorted by index.
// Reads state and cells; writes rows, their ranges and the anchors of the rows. A row lists every particle closer than
// the sum of radii + reach of contacts + skin, so it stays complete until some particle has moved half the skin from
// its anchor. Where in the table a row lies depends on timing; nothing that moves a particle depends on it.
#extension GL_GOOGLE_include_directive : require
#include "shared/buffers.glsl"
#include "shared/cells.glsl"
#include "law/reach.glsl"

uint row[kMaxRow];

// The most particles that are looked at for one row. Sizes of spheres for which kMaxRow is enough stay far below.
// lavapipe silently ends all loops of a subgroup after 65535 trips together. 8 rows with this many visits, and the
// loops that sort them, stay below this limit as well.
const uint kMostVisits = 4096u;

void insertSorted(uint j, uint count) {
    uint at = count;
    for (; at > 0u && row[at - 1u] > j; --at) row[at] = row[at - 1u];
    row[at] = j;
}

uint collect(uint i, vec4 p) {
    float skin = numerics().y, size = numerics().z;
    if (reaches()) skin += longestReach();
    ivec3 home = cellOf(p.xyz, size);
    uint count = 0u, found = 0u, visits = 0u;
    for (int n = 0; n < 27; ++n) {
        ivec3 cell = home + ivec3(n % 3, (n / 3) % 3, n / 9) - 1;
        uint j = cells[headIndex(self, cellSlot(cell))];
        for (; j != kEmpty && visits <= kMostVisits; j = cells[nextIndex(j)]) {
            ++visits;
            if (j == i) continue;
            vec4 q = readState(source, kPosition, j);
            // Two cells may share a slot of the table: take a particle only from the cell it is in.
            if (cellOf(q.xyz, size) != cell) continue;
            float reach = p.w + q.w + skin;
            vec3 d = p.xyz - q.xyz;
            if (dot(d, d) >= reach * reach) continue;
            ++found;
            if (count < kMaxRow) {
                insertSorted(j, count);
                ++count;
            }
        }
    }
    if (visits > kMostVisits) report(kErrorCrowded, i);
    if (found > kMaxRow) report(kErrorRowFull, i);
    return count;
}

void main() {
    openMember();
    if (control.wanted.x == 0u) return;
    uint i = firstParticle() + invocation();
    vec4 p = readState(source, kPosition, i);
    uint count = 0u;
    if (p.w > 0.0) count = collect(i, p);
    uint first = atomicAdd(control.list.x, count);
    if (first + count > push.rowEntries) {
        report(kErrorTables, i);
        count = 0u;
    }
    first += self * push.rowEntries;
    for (uint s = 0u; s < count; ++s) rows[rowIndex(first + s)] = row[s];
    ranges[rowRangeIndex(i)].xy = uvec2(first, count);
    anchors[rowAnchorIndex(i)] = p;
    atomicMax(control.list.z, count);
}
