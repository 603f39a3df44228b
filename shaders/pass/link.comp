#version 450
// link: makes the lists that `near` prepared the current ones. Lists for every particle the slots of its contacts, in
// an order that no timing changes. Reads state, rows, who in them is near, coming entries, carried history; writes
// entries, history, links and their ranges, list anchors.
#extension GL_GOOGLE_include_directive : require
#include "shared/buffers.glsl"
#include "pass/margin.glsl"

void adoptSprings(uint slot) {
    entries[slot] = entries[comingEntryIndex(slot)];
    for (uint part = 0u; part < kParts; ++part) history[historyIndex(part, slot)] = carried[historyIndex(part, slot)];
}

void adoptBody(uint slot) {
    entries[slot] = entries[comingEntryIndex(slot)];
    for (uint part = 0u; part < kBodyHistory; ++part)
        history[placeHistoryIndex(slot, 0u, part)] = carried[placeHistoryIndex(slot, 0u, part)];
}

/// Makes the prepared slots of the member current, each invocation some of them, whoever owns them. Lists that found no
/// room hold less than they counted.
void adopt() {
    uvec3 most = min(control.coming.xyz, uvec3(push.pairSlots, push.surfaceSlots, push.bodySlots));
    for (uint k = invocation(); k < most.x; k += push.share) adoptSprings(firstPairSlot() + k);
    for (uint k = invocation(); k < most.y; k += push.share) adoptSprings(firstSurfaceSlot() + k);
    for (uint k = invocation(); k < most.z; k += push.share) adoptBody(firstBodySlot() + k);
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
    uvec2 near = range.zw;  // the others of the row, a bit each
    uvec4 ofBodies = uvec4(0u);
    if (BODIES > 0u) ofBodies = rangesAt(bodyRangeIndex(i));

    uint count = bitCount(near.x) + bitCount(near.y) + own.w + ofBodies.y;
    uint first = atomicAdd(control.coming.w, count);
    if (first + count > push.linkEntries) {
        report(kErrorTables, i);
        count = 0u;
        near = uvec2(0u);
        own.w = 0u;
        ofBodies.y = 0u;
    }
    first += self * push.linkEntries;
    uint at = linkIndex(first), mine = own.x;
    bool agrees = true;
    for (; near != uvec2(0u); ++at) {
        uint j = rowsAt(rowIndex(range.x) + (near.x != 0u ? findLSB(near.x) : 32u + findLSB(near.y)));
        near = uvec2(near.x & (near.x - 1u), near.x != 0u ? near.y : near.y & (near.y - 1u));
        uint slot = mine;
        if (j > i)
            ++mine;
        else
            slot = slotOfOwner(j, i);
        // If the owner found no room, and said so, any slot will do for the one step that follows.
        bool owned = slot != kEmpty && mine <= own.x + own.y;
        if (!owned) slot = firstPairSlot();
        agrees = agrees && owned;
        rows[at] = slot << 1u | (j > i ? 0u : 1u);
    }
    if (p.w > 0.0 && !(agrees && mine == own.x + own.y)) report(kErrorLists, i);
    for (uint k = 0u; k < own.w; ++k, ++at) rows[at] = (own.z + k) << 1u;
    for (uint k = 0u; k < ofBodies.y; ++k, ++at) rows[at] = (ofBodies.x + k) << 1u;
    adopt();
    ranges[rowRangeIndex(i)].zw = uvec2(first, count);
    anchors[listAnchorIndex(i)] = vec4(p.xyz, slack);
}
