// Part of pass/step: contacts with other particles.

/// Contact of this particle with j; `slot` holds its history. Returns whether they touch.
bool meetParticle(uint i, Body me, uint j, uint list, uint slot, bool known, inout Sum sum) {
    vec4 position = readState(push.source, kPosition, j);
    Body other = Body(Sphere(position.xyz, readState(push.source, kResidue, j).xyz, position.w),
                      readState(push.source, kVelocity, j).xyz, readState(push.source, kSpin, j).xyz);
    bool first = i < j;
    Body a = me, b = other;
    if (!first) {
        a = other;
        b = me;
    }
    Overlap o = sphereOverlap(a.sphere, b.sphere);
    if (!(o.depth > 0.0) || position.w <= 0.0) return false;

    float leverA = a.sphere.radius - 0.5 * o.depth, leverB = b.sphere.radius - 0.5 * o.depth;
    vec3 velocity = (a.velocity - b.velocity) - cross(leverA * a.spin + leverB * b.spin, o.normal);
    float ra = a.sphere.radius, rb = b.sphere.radius;
    Meeting m = Meeting(o.normal, o.depth, 2.0 * ra * rb / (ra + rb), velocity, a.spin - b.spin);
    History h = History(vec4(0.0), vec4(0.0));
    if (known) {
        h.slidingMax = readHistory(list, slot, 0u, i);
        h.rollingTorsion = readHistory(list, slot, 1u, i);
    }
    Response r = contactResponse(members[member].contact[kParticleParticle], members[member].choices, m, springDt, h);
    history[historyIndex(list, slot, 0u, i)] = h.slidingMax;
    history[historyIndex(list, slot, 1u, i)] = h.rollingTorsion;

    vec3 turn = cross(o.normal, r.sliding);
    sum.force += first ? r.force : -r.force;
    sum.torque += first ? r.couple - leverA * turn : -r.couple - leverB * turn;
    sum.overlap = max(sum.overlap, o.depth / min(ra, rb));
    return true;
}

/// Every contact of the row. Returns the row's new touch bits. Candidates are found first, from the high parts alone
/// and a margin far above their rounding, so that the expensive loop runs over touching slots only.
uvec2 touchPairs(uint i, Body me, uvec4 mark, inout Sum sum) {
    uint list = control.list.x;
    uvec2 touch = uvec2(0u);
    for (uint word = 0u; word * 32u < mark.w; ++word) {
        uint slots = min(mark.w - word * 32u, 32u);
        uint candidates = 0u;
        for (uint s = 0u; s < slots; ++s) {
            vec4 q = readState(push.source, kPosition, readRow(list, word * 32u + s, i));
            vec3 d = me.sphere.high - q.xyz;
            float reach = 1.00001 * (me.sphere.radius + q.w) + 1e-7;
            if (dot(d, d) < reach * reach && q.w > 0.0) candidates |= 1u << s;
        }
        uint known = word == 0u ? mark.x : mark.y;
        uint met = 0u;
        for (; candidates != 0u; candidates &= candidates - 1u) {
            uint s = findLSB(candidates);
            uint slot = word * 32u + s;
            uint bit = 1u << s;
            if (meetParticle(i, me, readRow(list, slot, i), list, slot, (known & bit) != 0u, sum)) met |= bit;
        }
        if (word == 0u)
            touch.x = met;
        else
            touch.y = met;
    }
    return touch;
}
