// Part of pass/step: contacts with the turning coil.

/// Rotation of the coil in turns at this step, in [-0.5, 0.5): start + step x increment in 64-bit fixed point, so that
/// hours of turning lose nothing. Only the high word is needed.
float coilTurn(uvec4 phase) {
    uint high, low, carry;
    umulExtended(phase.w, push.stepInBatch, high, low);
    low = uaddCarry(low, phase.y, carry);
    high += phase.z * push.stepInBatch + phase.x + carry;
    return float(int(high)) * (1.0 / 4294967296.0);
}

uint turnBit(uint slot) { return 1u << (kMaxSurfaces + slot); }

/// The slot that holds the turn at `angle`: the same turn moves far less than half a turn along the wire in a step.
uint knownTurn(uint mark, vec4 angles, float angle) {
    uint slot = kEmpty;
    for (uint t = 0u; t < kMaxTurns; ++t)
        if ((mark & turnBit(t)) != 0u && abs(angles[t] - angle) < 0.5 * kTwoPi) slot = t;
    return slot;
}

/// A slot for a new turn: one that no old contact may still claim, else any not taken in this step.
uint freeTurn(uint mark, uint met) {
    uint slot = kEmpty;
    for (uint t = kMaxTurns; t > 0u; --t)
        if ((met & turnBit(t - 1u)) == 0u) slot = t - 1u;
    for (uint t = kMaxTurns; t > 0u; --t)
        if (((mark | met) & turnBit(t - 1u)) == 0u) slot = t - 1u;
    return slot;
}

uint touchCoil(uint i, Body me, uint mark, inout Sum sum) {
    uint candidates = 0u;
    CoilView view;
    // A loop of at most one trip: it is skipped where no lane is near, which a branch is not.
    bool near = me.sphere.radius > 0.0 && nearCoil(coil, me.sphere);
    for (uint once = near ? 1u : 0u; once > 0u; --once) {
        view = coilView(coil, coilTurn(coil.phase), me.sphere);
        uint trips = coilCandidates(coil, view);
        for (uint k = 0u; k < trips; ++k) {
            CoilTouch touch = coilCandidate(coil, view, k);
            if (touch.failed) report(kErrorNewton, i);
            candidates |= touch.depth > 0.0 ? 1u << k : 0u;
        }
    }

    uint met = 0u;
    for (; candidates != 0u; candidates &= candidates - 1u) {
        CoilTouch touch = coilCandidate(coil, view, findLSB(candidates));
        vec4 angles = wallHistory[wireAngleIndex(i)];
        uint slot = knownTurn(mark & ~met, angles, touch.wireAngle);
        bool known = slot != kEmpty;
        if (!known) slot = freeTurn(mark, met);
        if (slot == kEmpty) {
            report(kErrorTurns, i);
            slot = 0u;
        }
        met |= turnBit(slot);
        angles[slot] = touch.wireAngle;
        wallHistory[wireAngleIndex(i)] = angles;

        vec3 point = me.sphere.high - touch.normal * (me.sphere.radius - 0.5 * touch.depth);
        vec3 wall = coil.motion.x * vec3(-point.y, point.x, 0.0);
        WallForce f = meetWall(i, me, Overlap(touch.depth, touch.normal), coilLaw, wall, vec3(0.0, 0.0, coil.motion.x),
                               SURFACES + slot, known, sum);
        sum.coilTorque -= point.x * f.force.y - point.y * f.force.x + f.couple.z;
    }
    return met;
}
