// Part of pass/step: contacts with other particles.

/// Contact of this particle with the one in `slot` of its row. Returns whether they touch.
bool meetParticle(uint i, Body me, uint list, uint slot, bool known, inout Sum sum) {
    uint j = readRow(list, slot, i);
    Body other = readBody(j);
    vec4 old0 = readHistory(list, slot, 0u, i), old1 = readHistory(list, slot, 1u, i);
    History h = History(known ? old0 : vec4(0.0), known ? old1 : vec4(0.0));

    bool first = i < j;
    Body a = me, b = other;
    if (!first) {
        a = other;
        b = me;
    }
    Overlap o = sphereOverlap(a.sphere, b.sphere);
    bool touching = o.depth > 0.0 && other.sphere.radius > 0.0;
    float ra = a.sphere.radius, rb = b.sphere.radius;
    float leverA = ra - 0.5 * o.depth, leverB = rb - 0.5 * o.depth;
    vec3 velocity = (a.velocity - b.velocity) - cross(leverA * a.spin + leverB * b.spin, o.normal);
    Meeting m = Meeting(o.normal, o.depth, 2.0 * ra * rb / (ra + rb), velocity, a.spin - b.spin);
#ifdef ENERGY_BOOK
    History old = h;
#endif
    Response r = contactResponse(pairLaw, choices, m, springDt, h);
    vec3 turn = cross(o.normal, r.sliding);
    if (touching) {
        history[historyIndex(list, slot, 0u, i)] = h.slidingMax;
        history[historyIndex(list, slot, 1u, i)] = h.rollingTorsion;
        sum.force += first ? r.force : -r.force;
        sum.torque += first ? r.couple - leverA * turn : -r.couple - leverB * turn;
        sum.overlap = max(sum.overlap, o.depth / min(ra, rb));
    }
#ifdef ENERGY_BOOK
    bookPair(i, list, slot, a, b, o, r, known, touching, old, h);
#endif
    return touching;
}

/// Slots whose spheres can overlap, from the high parts of the positions alone and a margin far above their rounding.
uint candidatesInWord(uint i, Body me, uint list, uint first, uint slots) {
    uint candidates = 0u;
    for (uint s = 0u; s < slots; ++s) {
        vec4 q = readState(push.source, kPosition, readRow(list, first + s, i));
        vec3 d = me.sphere.high - q.xyz;
        float reach = 1.00001 * (me.sphere.radius + q.w) + 1e-7;
        candidates |= dot(d, d) < reach * reach && q.w > 0.0 ? 1u << s : 0u;
    }
    return candidates;
}

/// Every contact of the row. Returns the row's new touch bits.
uvec2 touchPairs(uint i, Body me, uint list, uvec4 mark, inout Sum sum) {
    uvec2 touch = uvec2(0u);
    for (uint word = 0u; word * 32u < mark.w; ++word) {
        uint candidates = candidatesInWord(i, me, list, word * 32u, min(mark.w - word * 32u, 32u));
        uint known = word == 0u ? mark.x : mark.y;
        uint met = 0u;
#ifdef ENERGY_BOOK
        uint checked = candidates;
#endif
        for (; candidates != 0u; candidates &= candidates - 1u) {
            uint s = findLSB(candidates);
            uint bit = 1u << s;
            if (meetParticle(i, me, list, word * 32u + s, (known & bit) != 0u, sum)) met |= bit;
        }
#ifdef ENERGY_BOOK
        // A touch bit without a candidate: what was no candidate has certainly parted; the others booked it themselves.
        for (uint parted = known & ~checked; parted != 0u; parted &= parted - 1u)
            partPair(i, me, list, word * 32u + findLSB(parted));
#endif
        if (word == 0u)
            touch.x = met;
        else
            touch.y = met;
    }
    return touch;
}
