#version 450
// surfaces: computes the contacts with the fixed surfaces in this step, one listed contact per invocation.
// Reads the source half of the state, entries, history; writes history, forces and torques, which `move` gathers, and
// the sums of what the particle does to each surface if a member asks for them.
// A contact that does not touch exerts nothing and remembers nothing.
//
// Where walls go on into the throat, two surfaces may overlap a sphere in one contact, and the history passes from one
// to the other. So one invocation, the first one's, computes all contacts of a sphere at the rim; `near` tells it how
// many they are.
#extension GL_GOOGLE_include_directive : require
#include "shared/buffers.glsl"
#include "pass/history.glsl"
#include "pass/loads.glsl"
#include "pass/sides.glsl"
#include "pass/wall.glsl"
#ifdef ENERGY_BOOK
#include "pass/slot_books.glsl"
#endif

/// A slot's memory of the last step; all zero if the contact did not touch.
struct Memory {
    History springs;
#ifdef ENERGY_BOOK
    Exerted exerted;
#endif
};

Memory nothing() {
    Memory m;
    m.springs = noHistory();
#ifdef ENERGY_BOOK
    m.exerted = kNothing;
#endif
    return m;
}

bool known(Memory m) { return m.springs.slidingMax.w > 0.0; }

Memory recall(uint slot) {
    Memory m;
    m.springs = historyOfSlot(slot);
#ifdef ENERGY_BOOK
    m.exerted = exertedBefore(slot, known(m));
#endif
    return m;
}

void main() {
    openMember();
    dither = ditherOf(stepNumber());
    ContactParams law = lawOf(pairIndex(kFirstPowder, kWallMaterial));  // before any branch, as in `pairs`
    SurfaceParams frontWall = frontSurface();
    uvec4 chosen = choices();
    float density = gravity().w;
    float springDt = springStep();
    uint listed = control.listed.y;
    if (waits() || invocation() >= listed) return;
    uint slot = firstSurfaceSlot() + invocation();
    uvec2 who = entriesAt(slot);
    uint works = who.y >> kSurfaceBits;
    if (works == 0u) return;
    Body me = readBody(who.x);
    density = densityOf(me.material, density);

    bool joined = joints() && works > 1u;
    uint end = slot + works;
    float reduced = 2.0 * me.sphere.radius;
    Overlap front;
    if (joints()) front = frontOverlap(frontWall, me.sphere);
    if (joints() && ownLaws()) law = lawOf(pairIndex(me.material, materialOfWall(frontWall)));
#ifdef ENERGY_BOOK
    ContactParams frontLaw = law;  // under which the front wall's memory came about
#endif
    Memory frontMemory = recall(end - 1u);  // the front wall is the last; of a single contact this is its own
    bool frontTouches = joints() && holds(law, front.depth, reduced, frontMemory.springs.slidingMax.w);

    for (; slot < end; ++slot) {
        uint surface = surfaceOf(entriesAt(slot).y);
        SurfaceParams p = readSurface(surface);
        uint kind = uint(p.pointHigh.w);
        if (ownLaws()) law = lawOf(pairIndex(me.material, materialOfWall(p)));
        Overlap o = surfaceOverlap(KIND_SET, kind, p, me.sphere);
        Memory memory = frontMemory;
#ifdef ENERGY_BOOK
        ContactParams lawBefore = law;
#endif
        bool touching = holds(law, o.depth, reduced, memory.springs.slidingMax.w);
        if (joined) {
            if (slot + 1u < end) memory = recall(slot);
            touching = holds(law, o.depth, reduced, memory.springs.slidingMax.w);
            if (kind == kFront) {
                o = front;
                touching = frontTouches;
#ifdef ENERGY_BOOK
                if (ownLaws()) lawBefore = frontLaw;
#endif
            } else if (kind != kTube && p.pointLow.w != 0.0 && touching && frontTouches) {
                uint joint = jointContact(o, front, me.sphere.radius);
                // The contact that counts goes on with the other's history unless it has its own.
                if (joint == kWallCounts) {
                    frontTouches = false;
                    if (!known(memory)) {
                        memory = frontMemory;
                        frontMemory = nothing();
#ifdef ENERGY_BOOK
                        if (ownLaws()) lawBefore = frontLaw;
#endif
                    }
                } else if (joint == kFrontCounts) {
                    touching = false;
                    if (!known(frontMemory)) {
                        frontMemory = memory;
                        memory = nothing();
#ifdef ENERGY_BOOK
                        if (ownLaws()) frontLaw = law;
#endif
                    }
                }
            }
        }
        History h = memory.springs;
        Response r;
        meetMaterial(who.x, materialOfWall(p));
        WallForce f = meetWall(me, o, 1.0, reduced, law, chosen, density, 0.0, springDt, vec3(0.0), vec3(0.0), h, r);
        keepHistory(slot, h, touching);
        writeForce(slot, touching ? vec4(f.force, o.depth / me.sphere.radius) : vec4(0.0));
        writeTorque(slot, touching ? vec4(f.torque, 0.0) : vec4(0.0));
        writeFlow(slot, touching ? flowNow() : vec4(0.0));
        if (WALL_LOADS != 0u && touching) {
            vec3 point = me.sphere.high - o.normal * (me.sphere.radius - 0.5 * o.depth);
            addLoad(BODIES + surface, who.x, f.force, cross(point, f.force) + f.couple, 0.0);
        }
#ifdef ENERGY_BOOK
        bookSurface(law, springDt, slot, me, o, r, touching, lawBefore, memory.exerted, memory.springs, h);
#endif
        if (slot + 1u >= end) break;  // at the end: shaders/README.md, Drivers
    }
}
