#version 450
// surfaces: what the fixed surfaces exert in this step, one listed contact per invocation.
// Built with and without TEXEL_READS, PACKED_STORES (shared/buffers.glsl) and ENERGY_BOOK.
// Reads the source half of the state, entries, history; writes history, forces and torques, which `move` gathers. A
// contact that does not touch exerts nothing and remembers nothing.
#extension GL_GOOGLE_include_directive : require
#include "shared/buffers.glsl"
#include "pass/wall.glsl"
#ifdef ENERGY_BOOK
#include "pass/slot_books.glsl"
#endif

void main() {
    openMember();
    ContactParams law = lawOf(kParticleWall);  // before any branch, as in `pairs`
    uvec4 chosen = choices();
    float springDt = springStep();
    if (invocation() >= control.listed.y) return;
    uint slot = firstSurfaceSlot() + invocation();

    uvec2 who = readEntry(slot);
    Body me = readBody(who.x);
    SurfaceParams p = readSurface(who.y);
    History h = History(readHistory(0u, slot), readHistory(1u, slot));
#ifdef ENERGY_BOOK
    History old = h;
#endif
    Overlap o = surfaceOverlap(KIND_SET, uint(p.pointHigh.w), p, me.sphere);
    bool touching = o.depth > 0.0;
    Response r;
    WallForce f = meetWall(me, o, law, chosen, springDt, vec3(0.0), vec3(0.0), h, r);
    writeHistory(slot, touching ? h.slidingMax : vec4(0.0), touching ? h.rollingTorsion : vec4(0.0));
    writeForce(slot, touching ? vec4(f.force, o.depth / me.sphere.radius) : vec4(0.0));
    writeTorque(slot, touching ? vec4(f.torque, 0.0) : vec4(0.0));
#ifdef ENERGY_BOOK
    bookSurface(law, springDt, slot, me, o, r, touching, old, h);
#endif
}
