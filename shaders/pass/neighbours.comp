#version 450
// neighbours: builds the other half of the neighbour rows, sorted by index, and carries the history of touching pairs
// over to it. Reads state, cells, the current rows, marks and history; writes the new rows and history, marks, anchors.
// A row lists every particle closer than the sum of radii + skin, so it stays complete until some particle has moved
// half the skin from its anchor.
#extension GL_GOOGLE_include_directive : require
#include "shared/buffers.glsl"
#include "shared/cells.glsl"

uint row[kMaxRow];

// Particles looked at for one row. Spheres of sizes that a row of kMaxRow holds stay far below. lavapipe ends all loops
// of a subgroup after 65535 trips together, silently: 8 rows of this, with the loops that sort them and find old slots,
// stay below as well.
const uint kMostVisits = 4096u;

void insertSorted(uint j, uint count) {
    uint at = count;
    for (; at > 0u && row[at - 1u] > j; --at) row[at] = row[at - 1u];
    row[at] = j;
}

uint collect(uint i, uint member, vec4 p) {
    float skin = members[member].numerics.y, size = members[member].numerics.z;
    ivec3 home = cellOf(p.xyz, size);
    uint count = 0u, found = 0u, visits = 0u;
    for (int n = 0; n < 27; ++n) {
        ivec3 cell = home + ivec3(n % 3, (n / 3) % 3, n / 9) - 1;
        uint j = cells[cellSlot(cell, member)];
        for (; j != kEmpty && visits <= kMostVisits; j = cells[push.cellMask + 1u + j]) {
            ++visits;
            if (j == i) continue;
            vec4 q = state[stateIndex(push.source, kPosition, j)];
            // Two cells may share a slot of the table: take a particle only from the cell it is in.
            if (cellOf(q.xyz, size) != cell) continue;
            if (MEMBERS != 1u && groupMember[j / gl_WorkGroupSize.x] != member) continue;
            float reach = p.w + q.w + skin;
            vec3 d = p.xyz - q.xyz;
            if (dot(d, d) >= reach * reach) continue;
            ++found;
            if (count < push.rowWidth) {
                insertSorted(j, count);
                ++count;
            }
        }
    }
    if (visits > kMostVisits) report(kErrorCrowded, i);
    if (found > push.rowWidth) report(kErrorRowFull, i);
    return count;
}

uint find(uint j, uint count) {
    for (uint s = 0u; s < count; ++s)
        if (row[s] == j) return s;
    return kEmpty;
}

void main() {
    uint i = gl_GlobalInvocationID.x;
    uint member = memberOfGroup();
    vec4 p = state[stateIndex(push.source, kPosition, i)];
    uint now = control.list.x, next = 1u - now;
    uvec4 mark = marks[i];

    uint count = 0u;
    if (p.w > 0.0) count = collect(i, member, p);
    for (uint s = 0u; s < count; ++s) rows[rowIndex(next, s, i)] = row[s];

    uvec2 touch = uvec2(0u);
    for (uint s = 0u; s < mark.w; ++s) {
        bool touching = ((s < 32u ? mark.x : mark.y) & (1u << (s & 31u))) != 0u;
        if (!touching) continue;
        uint to = find(rows[rowIndex(now, s, i)], count);
        if (to == kEmpty) continue;  // one of the two has left the canister
        history[historyIndex(next, to, 0u, i)] = history[historyIndex(now, s, 0u, i)];
        history[historyIndex(next, to, 1u, i)] = history[historyIndex(now, s, 1u, i)];
        touch[to >> 5u] |= 1u << (to & 31u);
    }
    marks[i] = uvec4(touch, mark.z, count);
    anchors[i] = p;
    atomicMax(control.list.z, count);
}
