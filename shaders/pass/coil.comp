#version 450
// coil: computes the contacts with the turning coil in this step, one particle near it per invocation.
// Reads the source half of the state, entries, the coil's history; writes that history, forces and torques, which
// `move` gathers, and the sum of the particle's torque on the coil, which `sense` reads.
#extension GL_GOOGLE_include_directive : require
#include "shared/buffers.glsl"
#include "pass/wall.glsl"
#include "law/coil.glsl"
#ifdef ENERGY_BOOK
#include "pass/slot_books.glsl"
#endif

/// The turn that was touched at `angle`. In a step the contact with one turn moves far less than half a turn along the
/// wire, so its angle identifies it.
uint knownTurn(vec4 angles, uint met, float angle) {
    uint turn = kEmpty;
    for (uint t = 0u; t < kMaxTurns; ++t)
        if ((met & (1u << t)) == 0u && abs(angles[t] - angle) < 0.5 * kTwoPi) turn = t;
    return turn;
}

/// Finds room for a new turn: a place that no old contact may still claim, else any place not taken in this step.
uint freeTurn(vec4 angles, uint met) {
    uint turn = kEmpty;
    for (uint t = kMaxTurns; t > 0u; --t)
        if ((met & (1u << (t - 1u))) == 0u) turn = t - 1u;
    for (uint t = kMaxTurns; t > 0u; --t)
        if ((met & (1u << (t - 1u))) == 0u && angles[t - 1u] == kNoTurn) turn = t - 1u;
    return turn;
}

void main() {
    openMember();
    ContactParams law = lawOf(kParticleCoil);  // before any branch, as in `pairs`
    CoilParams coil = member.coil;
    uvec4 chosen = choices();
    float density = gravity().w;
    float springDt = springStep();
    uint listed = control.listed.z;
    if (waits() || invocation() >= listed) return;
    uint slot = firstCoilSlot() + invocation();
    uint i = entriesAt(slot).x;
    Body me = readBody(i);
    vec4 angles = coilHistoryAt(wireAngleIndex(i));
    CoilView view = coilView(coil, coilTurn(coil.phase, stepInBatch), me.sphere);
    uint trouble = kEmpty;
    uint trips = coilCandidates(coil, view), candidates = 0u;
    for (uint k = 0u; k < trips; ++k) {
        CoilTouch touch = coilCandidate(coil, view, k);
        if (touch.failed) trouble = kErrorNewton;
        candidates |= touch.depth > 0.0 ? 1u << k : 0u;
    }

    float reduced = reducedAtCoil(coil, me.sphere.radius);
    vec3 force = vec3(0.0), torque = vec3(0.0);
    float coilTorque = 0.0, overlap = 0.0;
    uint met = 0u;
    vec4 was = angles;
#ifdef ENERGY_BOOK
    openSlotBook();
#endif
    for (; candidates != 0u; candidates &= candidates - 1u) {
        CoilTouch touch = coilCandidate(coil, view, findLSB(candidates));
        uint turn = knownTurn(was, met, touch.wireAngle);
        bool known = turn != kEmpty;
        if (!known) turn = freeTurn(was, met);
        if (turn == kEmpty) {
            trouble = kErrorTurns;
            turn = 0u;
        }
        met |= 1u << turn;
        angles[turn] = touch.wireAngle;

        uint at = coilHistoryIndex(turn, 0u, i);
        vec4 old0 = coilHistoryAt(at), old1 = coilHistoryAt(at + push.particles);
        History h = History(known ? old0 : vec4(0.0), known ? old1 : vec4(0.0));
#ifdef ENERGY_BOOK
        History old = h;
#endif
        vec3 point = me.sphere.high - touch.normal * (me.sphere.radius - 0.5 * touch.depth);
        vec3 wall = coil.motion.y * vec3(-point.y, point.x, 0.0);
        Overlap o = Overlap(touch.depth, touch.normal);
        Response r;
        WallForce f =
            meetWall(me, o, reduced, law, chosen, density, springDt, wall, vec3(0.0, 0.0, coil.motion.y), h, r);
        coilHistory[at] = h.slidingMax;
        coilHistory[at + push.particles] = h.rollingTorsion;
        force += f.force;
        torque += f.torque;
        writeForce(forceOfTurn(turn, slot), vec4(f.force, 0.0));  // the host asks for single contacts
        coilTorque -= point.x * f.force.y - point.y * f.force.x + f.couple.z;
        overlap = max(overlap, o.depth / me.sphere.radius);
#ifdef ENERGY_BOOK
        bookCoil(law, springDt, coil.motion.x, reduced, i, turn, me, o, r, known, true, old, h);
#endif
    }
#ifdef ENERGY_BOOK
    partCoil(law, springDt, coil.motion.x, reduced, i, me, was, met);
    writeBook(slot, slotBook);
#endif
    for (uint t = 0u; t < kMaxTurns; ++t)
        if ((met & (1u << t)) == 0u) angles[t] = kNoTurn;
    if (any(notEqual(angles, was))) coilHistory[wireAngleIndex(i)] = angles;
    if (trouble != kEmpty) report(trouble, i);
    writeForce(slot, vec4(force, overlap));
    writeTorque(slot, vec4(torque, coilTorque));
    coilTorques[coilTorqueIndex(i)] += coilTorque;
}
