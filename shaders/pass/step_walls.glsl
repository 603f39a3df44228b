// Part of pass/step: contacts with the fixed surfaces and the coil.

/// Contact with a wall or the coil whose history is in `slot`. `wall` is the wall's velocity at the contact.
void meetWall(uint i, Body me, Overlap o, uint kind, vec3 wall, uint slot, bool known, inout Sum sum, out vec3 force,
              out vec3 couple) {
    float lever = me.sphere.radius - 0.5 * o.depth;
    Meeting m = Meeting(o.normal, o.depth, 2.0 * me.sphere.radius,
                        (me.velocity - wall) - lever * cross(me.spin, o.normal), me.spin);
    if (kind == kParticleCoil) m.spin.z -= members[member].coil.motion.x;
    History h = History(vec4(0.0), vec4(0.0));
    if (known) {
        h.slidingMax = wallHistory[wallHistoryIndex(slot, 0u, i)];
        h.rollingTorsion = wallHistory[wallHistoryIndex(slot, 1u, i)];
    }
    Response r = contactResponse(members[member].contact[kind], members[member].choices, m, springDt, h);
    wallHistory[wallHistoryIndex(slot, 0u, i)] = h.slidingMax;
    wallHistory[wallHistoryIndex(slot, 1u, i)] = h.rollingTorsion;
    force = r.force;
    couple = r.couple;
    sum.force += r.force;
    sum.torque += r.couple - lever * cross(o.normal, r.sliding);
    sum.overlap = max(sum.overlap, o.depth / me.sphere.radius);
}

uint touchSurfaces(uint i, Body me, uint mark, inout Sum sum) {
    uint surfaces = members[member].choices.x;
    uint candidates = 0u;
    for (uint s = 0u; s < surfaces; ++s)
        if (surfaceOverlap(members[member].surface[s], me.sphere).depth > 0.0) candidates |= 1u << s;
    uint met = candidates;
    for (; candidates != 0u; candidates &= candidates - 1u) {
        uint s = findLSB(candidates);
        Overlap o = surfaceOverlap(members[member].surface[s], me.sphere);
        vec3 force, couple;
        meetWall(i, me, o, kParticleWall, vec3(0.0), s, (mark & (1u << s)) != 0u, sum, force, couple);
    }
    return met;
}

/// Rotation of the coil in turns at this step, in [-0.5, 0.5): start + step x increment in 64-bit fixed point, so that
/// hours of turning lose nothing. Only the high word is needed.
float coilTurn(uvec4 phase) {
    uint high, low, carry;
    umulExtended(phase.w, push.stepInBatch, high, low);
    low = uaddCarry(low, phase.y, carry);
    high += phase.z * push.stepInBatch + phase.x + carry;
    return float(int(high)) * (1.0 / 4294967296.0);
}

uint wireAngleIndex(uint surfaces, uint turn, uint i) {
    return (surfaces * 2u + kMaxTurns * 2u + turn) * push.particles + i;
}

/// The slot whose turn is at `angle`, if one of `mark` is: the same turn moves far less than half a turn in a step.
uint knownTurn(uint i, uint surfaces, uint mark, float angle) {
    for (uint t = 0u; t < kMaxTurns; ++t)
        if ((mark & (1u << (kMaxSurfaces + t))) != 0u &&
            abs(wallHistory[wireAngleIndex(surfaces, t, i)].x - angle) < 0.5 * kTwoPi)
            return t;
    return kEmpty;
}

uint freeTurn(uint mark) {
    for (uint t = 0u; t < kMaxTurns; ++t)
        if ((mark & (1u << (kMaxSurfaces + t))) == 0u) return t;
    return kEmpty;
}

uint touchCoil(uint i, Body me, uint mark, inout Sum sum) {
    CoilParams c = members[member].coil;
    uint surfaces = members[member].choices.x;
    CoilView view = coilView(c, coilTurn(c.phase), me.sphere);
    uint trips = coilCandidates(c, view);
    uint met = 0u;
    for (uint k = 0u; k < trips; ++k) {
        CoilTouch touch = coilCandidate(c, view, k);
        if (touch.failed) report(kErrorNewton, i);
        if (!(touch.depth > 0.0)) continue;
        uint slot = knownTurn(i, surfaces, mark, touch.wireAngle);
        bool known = slot != kEmpty;
        // A new turn must not take the place of one whose history is still to be claimed by a later candidate.
        if (!known) slot = freeTurn(mark | met);
        if (slot == kEmpty) slot = freeTurn(met);
        if (slot == kEmpty) {
            report(kErrorTurns, i);
            continue;
        }
        met |= 1u << (kMaxSurfaces + slot);
        wallHistory[wireAngleIndex(surfaces, slot, i)] = vec4(touch.wireAngle, 0.0, 0.0, 0.0);

        vec3 point = me.sphere.high - touch.normal * (me.sphere.radius - 0.5 * touch.depth);
        vec3 wall = c.motion.x * vec3(-point.y, point.x, 0.0);
        vec3 force, couple;
        meetWall(i, me, Overlap(touch.depth, touch.normal), kParticleCoil, wall, surfaces + slot, known, sum, force,
                 couple);
        sum.coilTorque -= point.x * force.y - point.y * force.x + couple.z;
    }
    return met;
}

/// Surfaces and coil. Returns the new touch bits.
uint touchWalls(uint i, Body me, uint mark, inout Sum sum) {
    uint met = touchSurfaces(i, me, mark, sum);
    if (members[member].coil.motion.z != 0.0) met |= touchCoil(i, me, mark, sum);
    return met;
}
