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
#endif
#ifdef ENERGY_BOOK
#include "pass/books.glsl"
#endif

uint partners[kMaxRow];
uint pairs, surfaces, firstPair, firstSurface;

/// The coming slot of the contact that is in `slot` now; kEmpty if its two bodies are no longer near.
uint comingSlot(uint slot, uint other) {
    uint to = kEmpty;
    if (ofPair(slot)) {
        for (uint k = 0u; k < pairs; ++k)
            if (partners[k] == other) to = firstPair + k;
    } else if ((surfaces & (1u << surfaceOf(other))) != 0u) {
        to = firstSurface + bitCount(surfaces & ((1u << surfaceOf(other)) - 1u));
    }
    return to;
}

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

/// How near a body must be. A body and the particle may both go their slack, and the body a step more before it is told
/// that it has.
float reachOfBodies(float radius, float slack) {
    float reach = radius + slack + bodySlack() + 2.0 * member.choices.w + 1e-7;
    if (reaches()) reach += longestReach();
    return reach;
}

Two3 centreOn(uint body, uint i) {
    return toBody(motionOf(body), readState(source, kPosition, i).xyz, readState(source, kResidue, i).xyz);
}

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

/// Keeps the triangles that the slot's particle can touch before the next refresh.
void listTriangles(uint slot, uint body, Two3 centre, float reach) {
    if (!openNearby(slot)) return;
    uint kept = 0u, meshes = 0u;
    uvec2 shapes = geometryAt(kBodyVectors * body).xy;
    for (uint s = 0u; s < shapes.y; ++s) {
        uint shape = shapes.x + kShapeVectors * s;
        uvec4 head = geometryAt(shape);
        if (head.x != kShapeMesh) continue;
        ++meshes;
        float margin = uintBitsToFloat(geometryAt(shape + 3u).w);
        uint triangles = geometryAt(shape + 4u).x;
        uvec2 list = cellList(shape, head.z, centre.high);
        uint k = 0u;
        for (; k < list.y && kept < kNearbyWords; ++k) {
            uint t = nthTriangle(head.w, list.x, k);
            if (!mayReach(triangles + kTriangleVectors * t, centre.high, reach + margin)) continue;
            if (kept + 1u < kNearbyWords) nearby[nearbyStart + 1u + kept] = t;
            ++kept;
        }
        if (k < list.y) kept = kNearbyWords;
    }
    nearby[nearbyStart] = meshes == 1u && kept < kNearbyWords ? kept : kWholeCell;
}

/// Lists the bodies, and carries on what the particle remembers of them.
void listBodies(uint i, uvec4 range, float reach) {
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
        listTriangles(to, body, centreOn(body, i), reach);
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

void prepare(uint slot, uint i, uint other) {
    entries[comingEntryIndex(slot)] = uvec2(i, other);
    for (uint part = 0u; part < kParts; ++part) carried[historyIndex(part, slot)] = vec4(0.0);
}

/// Whether the contact with a wall that ends at the front wall may, before the next refresh, become one with the
/// contact with the rim or the throat, or part from it. In front of the front wall itself it cannot.
bool joinsAtFront(Sphere me, float slack) {
    bool both = (surfaces & (1u << FRONT)) != 0u && bitCount(surfaces) > 1u;
    return joints() && both && length(me.high.xy) < frontSurface().radius.x + slack + 1e-7;
}

void main() {
    openMember();
    if (control.wanted.y == 0u) return;
    uint i = firstParticle() + invocation();
    vec4 p = readState(source, kPosition, i);
    Sphere me = Sphere(p.xyz, vec3(0.0), p.w);
    float slack = slackOfParticle(i);
    uvec4 range = rangesAt(rowRangeIndex(i));

    pairs = 0u;
    for (uint s = 0u; s < range.y; ++s) {
        uint j = rowsAt(rowIndex(range.x + s));
        if (j > i && nearPair(p, slack, readState(source, kPosition, j), slackOfParticle(j))) {
            partners[pairs] = j;
            ++pairs;
        }
    }
    surfaces = nearSurfaces(me, slack);
    uint met = bitCount(surfaces);

    firstPair = atomicAdd(control.coming.x, pairs);
    firstSurface = atomicAdd(control.coming.y, met);
    bool fits = firstPair + pairs <= push.pairSlots && firstSurface + met <= push.surfaceSlots;
    if (!fits) {
        report(kErrorTables, i);
        pairs = 0u;
        surfaces = 0u;
        met = 0u;
    }
    firstPair += firstPairSlot();
    firstSurface += firstSurfaceSlot();

    for (uint k = 0u; k < pairs; ++k) prepare(firstPair + k, i, partners[k]);
    uint at = firstSurface;
    bool joined = joinsAtFront(me, slack);
    for (uint left = surfaces; left != 0u; left &= left - 1u, ++at) {
        uint works = !joined ? 1u : at == firstSurface ? met : 0u;
        prepare(at, i, findLSB(left) | works << kSurfaceBits);
    }

    for (uint k = 0u; k < range.w; ++k) {
        uint link = rowsAt(linkIndex(range.z + k)), slot = link >> 1u;
        if ((link & 1u) != 0u) continue;  // the other particle's
        if (slot >= springSlotCount()) continue;
        uint to = comingSlot(slot, entriesAt(slot).y);
        if (to != kEmpty) {
            for (uint part = 0u; part < kParts; ++part) carried[historyIndex(part, to)] = readHistory(part, slot);
        }
#ifdef ENERGY_BOOK
        if (to == kEmpty) bookDeparture(i, slot);
#endif
    }
#ifdef WITH_BODIES
    openBodies();
    float bodyReach = reachOfBodies(p.w, slack);
    bodies = nearBodies(i, p.w, bodyReach);
    listBodies(i, range, bodyReach);
#endif
    ranges[slotRangeIndex(i)] = uvec4(firstPair, pairs, firstSurface, met);
}
