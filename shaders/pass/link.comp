#version 450
// link: makes the lists that `near` prepared the current ones. Lists for every particle the slots of its contacts, in
// an order that no timing changes. Reads state, rows, coming entries, carried history; writes entries, history, links
// and their ranges, list anchors.
#extension GL_GOOGLE_include_directive : require
#include "shared/buffers.glsl"
#include "pass/margin.glsl"

uint links[kMaxLinks];

void adopt(uint slot) {
    entries[slot] = entries[comingEntryIndex(slot)];
    for (uint part = 0u; part < kParts; ++part) history[historyIndex(part, slot)] = carried[historyIndex(part, slot)];
}

void adoptBody(uint slot) {
    entries[slot] = entries[comingEntryIndex(slot)];
    for (uint part = 0u; part < kBodyHistory; ++part)
        history[placeHistoryIndex(slot, 0u, part)] = carried[placeHistoryIndex(slot, 0u, part)];
}

/// The slot of the pair (j, i) among those that j owns.
uint slotOfOwner(uint j, uint i) {
    uvec4 own = rangesAt(slotRangeIndex(j));
    uint slot = kEmpty;
    for (uint k = 0u; k < own.y; ++k)
        if (entries[comingEntryIndex(own.x + k)].y == i) slot = own.x + k;
    return slot;
}

void main() {
    openMember();
    if (control.wanted.y == 0u) return;
    uint i = firstParticle() + invocation();
    vec4 p = readState(source, kPosition, i);
    float slack = slackOfParticle(i);
    uvec4 range = rangesAt(rowRangeIndex(i)), own = rangesAt(slotRangeIndex(i));

    uint count = 0u, mine = own.x;
    for (uint s = 0u; s < range.y; ++s) {
        uint j = rowsAt(rowIndex(range.x + s));
        if (!nearPair(p, slack, readState(source, kPosition, j), slackOfParticle(j))) continue;
        uint slot = mine;
        if (j > i)
            ++mine;
        else
            slot = slotOfOwner(j, i);
        if (slot == kEmpty || j > i && mine > own.x + own.y) continue;  // the owner found no room, and has said so
        links[count] = slot << 1u | (j > i ? 0u : 1u);
        ++count;
    }
    for (uint k = 0u; k < own.w; ++k, ++count) links[count] = (own.z + k) << 1u;
    uvec4 ofBodies = uvec4(0u);
    if (BODIES > 0u) ofBodies = rangesAt(bodyRangeIndex(i));
    for (uint k = 0u; k < ofBodies.y; ++k, ++count) links[count] = (ofBodies.x + k) << 1u;
    for (uint k = 0u; k < ofBodies.y; ++k) adoptBody(ofBodies.x + k);
    for (uint k = 0u; k < own.y; ++k) adopt(own.x + k);
    for (uint k = 0u; k < own.w; ++k) adopt(own.z + k);

    uint first = atomicAdd(control.coming.w, count);
    if (first + count > push.linkEntries) {
        report(kErrorTables, i);
        count = 0u;
    }
    first += self * push.linkEntries;
    for (uint k = 0u; k < count; ++k) rows[linkIndex(first + k)] = links[k];
    ranges[rowRangeIndex(i)].zw = uvec2(first, count);
    anchors[listAnchorIndex(i)] = vec4(p.xyz, slack);
}
