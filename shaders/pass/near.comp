#version 450
// near: lists the contacts that can come about before the next refresh and gives each a slot. The particle of smaller
// index lists a pair. Reads state, rows, current entries, links and history; writes the coming entries, the history
// carried to them and the ranges of own slots. `link` then makes them current. Which slot a contact gets depends on
// timing; nothing that moves a particle depends on the slot.
//
// The rows alone would do. But of three contacts in them one touches. The slack is a hundredth of a radius instead of
// the rows' skin, so nearly every slot is a touching contact, which keeps all lanes of `pairs` busy.
#extension GL_GOOGLE_include_directive : require
#include "shared/buffers.glsl"
#include "pass/margin.glsl"
#ifdef WITH_BODIES
#include "pass/bodies.glsl"
#include "pass/near_bodies.glsl"
#endif
#ifdef ENERGY_BOOK
#include "pass/books.glsl"
#endif

uint surfaces, firstSurface;

#ifdef WITH_BODIES
uint bodies, firstBody;

#ifdef ENERGY_BOOK
/// What bookDeparture is for contacts with walls.
void bookDepartureFromBody(uint i, uint slot, uint body) {
    BodyMotion motion = motionOf(body);
    uint pair = pairIndex(materialOf(i), uint(motion.velocity.w));
    float reduced = reducedAtWall(abs(readState(source, kPosition, i).w), motion.centre.w);
    for (uint k = 0u; k < kMaxBodyTouches; ++k) {
        vec4 springs = historyAt(placeHistoryIndex(slot, k, 0u));
        if (springs.w <= 0.0) continue;
        History h = historyOfPlace(slot, k);
        Exerted e = Exerted(historyAt(placeHistoryIndex(slot, k, 3u)), historyAt(placeHistoryIndex(slot, k, 4u)),
                            historyAt(placeHistoryIndex(slot, k, 5u)));
        books[bookIndex(kBookFlow, i)].y += storedIn(lawOf(pair), e, reduced, h);
    }
}
#endif

/// The bodies within reach, a bit each.
uint nearBodies(uint i, float radius, float reach) {
    uint near = 0u;
    if (radius <= 0.0) return near;
    for (uint b = 0u; b < member.bodies.x; ++b) {
        Two3 centre = centreOn(b, i);
        if (mayTouch(b, centre, reach) && mayBeNear(b, centre, reach)) near |= 1u << b;
    }
    return near;
}

/// Lists the bodies, and carries on what the particle remembers of them.
void listBodies(uint i, uvec4 range) {
    uint count = bitCount(bodies);
    firstBody = atomicAdd(control.coming.z, count);
    if (firstBody + count > push.bodySlots) {
        report(kErrorTables, i);
        bodies = 0u;
        count = 0u;
    }
    firstBody += firstBodySlot();
    uint to = firstBody;
    for (uint left = bodies; left != 0u; left &= left - 1u, ++to) {
        uint body = uint(findLSB(left));
        entries[comingEntryIndex(to)] = uvec2(i, body);
        for (uint part = 0u; part < kBodyHistory; ++part) carried[placeHistoryIndex(to, 0u, part)] = vec4(0.0);
    }
    uint first = springSlotCount();
    for (uint k = 0u; k < range.w; ++k) {
        uint slot = rowsAt(linkIndex(range.z + k)) >> 1u;
        if (slot < first) continue;
        uint body = entriesAt(slot).y;
        if ((bodies >> body & 1u) == 0u) {
#ifdef ENERGY_BOOK
            bookDepartureFromBody(i, slot, body);
#endif
            continue;
        }
        to = firstBody + bitCount(bodies & ((1u << body) - 1u));
        for (uint part = 0u; part < kBodyHistory; ++part)
            carried[placeHistoryIndex(to, 0u, part)] = historyAt(placeHistoryIndex(slot, 0u, part));
    }
    ranges[bodyRangeIndex(i)] = uvec4(firstBody, count, 0u, 0u);
}
#endif

/// Lists the pairs of i and the others that `near` marks in its row. Carries on what was remembered of those that were
/// listed before, in the slots `old`. Both go by ascending index, so that one walk along both finds what they share.
void listPairs(uint i, uint firstPair, uint row, uvec2 near, uint old, uint oldCount) {
    uint to = firstPair, from = old, oldEnd = old + oldCount;
    for (; near != uvec2(0u) || from < oldEnd;) {
        uint comes = kEmpty, was = kEmpty;
        if (near != uvec2(0u)) comes = rowsAt(row + (near.x != 0u ? findLSB(near.x) : 32u + findLSB(near.y)));
        if (from < oldEnd) was = entriesAt(from).y;
        bool carries = comes == was;
        if (comes <= was) {
            entries[comingEntryIndex(to)] = uvec2(i, comes);
            for (uint part = 0u; part < kParts; ++part)
                carried[historyIndex(part, to)] = carries ? readHistory(part, from) : vec4(0.0);
            ++to;
            near = uvec2(near.x & (near.x - 1u), near.x != 0u ? near.y : near.y & (near.y - 1u));
        }
#ifdef ENERGY_BOOK
        if (was < comes) bookDeparture(i, from);
#endif
        if (was <= comes) ++from;
    }
}

/// The same for surfaces. The first contact of a sphere that touches several at the rim works on all of them.
void listSurfaces(uint i, bool joined, uint old, uint oldCount) {
    uint to = firstSurface;
    for (uint left = surfaces; left != 0u; left &= left - 1u, ++to) {
        uint works = !joined ? 1u : to == firstSurface ? bitCount(surfaces) : 0u;
        entries[comingEntryIndex(to)] = uvec2(i, findLSB(left) | works << kSurfaceBits);
        for (uint part = 0u; part < kParts; ++part) carried[historyIndex(part, to)] = vec4(0.0);
    }
    for (uint from = old; from < old + oldCount; ++from) {
        uint surface = surfaceOf(entriesAt(from).y), before = surfaces & ((1u << surface) - 1u);
        to = firstSurface + bitCount(before);
        if ((surfaces >> surface & 1u) != 0u) {
            for (uint part = 0u; part < kParts; ++part) carried[historyIndex(part, to)] = readHistory(part, from);
        }
#ifdef ENERGY_BOOK
        else
            bookDeparture(i, from);
#endif
    }
}

/// Whether the contact with a wall that ends at the front wall may, before the next refresh, become one with the
/// contact with the rim or the throat, or part from it. In front of the front wall itself it cannot.
bool joinsAtFront(Sphere me, float slack) {
    bool both = (surfaces & (1u << FRONT)) != 0u && bitCount(surfaces) > 1u;
    return joints() && both &&
           length(me.high.xy) < frontSurface().radius.x + slack + (1e-7 + 2.0 * roundingAt(me.high));
}

void main() {
    openMember();
    if (control.wanted.y == 0u) return;
    uint i = firstParticle() + invocation();
    vec4 p = readState(source, kPosition, i);
    Sphere me = Sphere(p.xyz, vec3(0.0), p.w);
    float slack = slackOfParticle(i);
    uvec4 range = rangesAt(rowRangeIndex(i)), old = rangesAt(slotRangeIndex(i));

    uvec2 near = uvec2(0u), lists = uvec2(0u);  // the others of the row, a bit each; those of larger index
    for (uint s = 0u; s < range.y; ++s) {
        uint j = rowsAt(rowIndex(range.x + s));
        uvec2 bit = s < 32u ? uvec2(1u << s, 0u) : uvec2(0u, 1u << (s - 32u));
        if (nearPair(p, slack, readState(source, kPosition, j), slackOfParticle(j))) near |= bit;
        if (j > i) lists |= bit;
    }
    lists &= near;
    surfaces = nearSurfaces(me, slack);
    uint pairs = bitCount(lists.x) + bitCount(lists.y), met = bitCount(surfaces);

    uint firstPair = atomicAdd(control.coming.x, pairs);
    firstSurface = atomicAdd(control.coming.y, met);
    bool fits = firstPair + pairs <= push.pairSlots && firstSurface + met <= push.surfaceSlots;
    if (!fits) {
        report(kErrorTables, i);
        lists = uvec2(0u);
        surfaces = 0u;
        pairs = 0u;
        met = 0u;
    }
    firstPair += firstPairSlot();
    firstSurface += firstSurfaceSlot();
    listPairs(i, firstPair, rowIndex(range.x), lists, old.x, old.y);
    listSurfaces(i, joinsAtFront(me, slack), old.z, old.w);
#ifdef WITH_BODIES
    openBodies();
    float most = p.w, toBodies = slackToBodies(p.xyz, slack);
    if (reaches()) most += longestReach();
    bodies = nearBodies(i, p.w, most + toBodies);
    listBodies(i, range);
#endif
    ranges[rowRangeIndex(i)].zw = near;  // for `link`, in the place of the former links
    ranges[slotRangeIndex(i)] = uvec4(firstPair, pairs, firstSurface, met);
}
