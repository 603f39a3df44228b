// Books of particles. Contacts book for themselves while they touch (pass/slot_books.glsl); the rest is here.
#ifndef VKDOSE_PASS_BOOKS_GLSL
#define VKDOSE_PASS_BOOKS_GLSL

#include "law/energy.glsl"
#include "law/grown.glsl"
#include "pass/history.glsl"
#include "pass/body.glsl"

float workOnOneSide(Exerted e, Body b, float side) {
    float lever = abs(b.sphere.radius) - 0.5 * e.rest.w;
    Work w = halfStepWork(e, side * b.velocity - lever * cross(b.spin, e.normal.xyz), side * b.spin, numerics().x);
    return w.hysteretic + w.damping + dot(w.sliders, vec3(1.0));
}

/// Books a contact that touched until one of its particles, or both, left the motion. The energy in its springs is gone
/// with them. Its last force still does work on a particle that stayed, which is booked here.
void bookDeparture(uint i, uint slot) {
    History h = historyOfSlot(slot);
    if (h.slidingMax.w <= 0.0) return;
    Exerted e = Exerted(readHistory(2u, slot), readHistory(3u, slot), readHistory(4u, slot));
    Body a = readBody(i);
    float radius = abs(a.sphere.radius), left = 0.0;
    if (!ofPair(slot)) {
        uint wall = materialOfWall(readSurface(surfaceOf(entriesAt(slot).y)));
        left = storedIn(lawOf(pairIndex(a.material, wall)), e, 2.0 * radius, h);
    } else {
        Body b = readBody(entriesAt(slot).y);
        float other = abs(b.sphere.radius);
        ContactParams law = lawOf(pairIndex(a.material, b.material));
        left = storedIn(law, e, 2.0 * radius * other / (radius + other), h);
        if (a.sphere.radius > 0.0) left += workOnOneSide(e, a, 1.0);
        if (b.sphere.radius > 0.0) left += workOnOneSide(e, b, -1.0);
    }
    books[bookIndex(kBookFlow, i)].y += left;
}

/// Adds to the particle's book the books of its own contacts in this step (fields as in shared/layout.h), the
/// bodies' work, the energy that came with the load and the energy that leaves with the particle. Velocities are those
/// before and after the kick.
void bookStep(uint i, vec4 normal, vec4 sliders, vec3 centre, float r, float mass, vec3 velocity, vec3 spin,
              vec3 newVelocity, vec3 newSpin, float bodyWork, bool leaves) {
    bool first = opening();
    vec4 flow = books[bookIndex(kBookFlow, i)];
    vec3 v = first ? 2.0 * velocity - newVelocity : velocity, w = first ? 2.0 * spin - newSpin : spin;
    float motion = mass * (0.5 * dot(v, newVelocity) + 0.2 * r * r * dot(w, newSpin) - dot(gravity().xyz, centre));
    dither = ditherOf(stepNumber());
    vec4 flown = vec4(sliders.w + (first ? motion : 0.0), leaves ? motion : 0.0, 0.0, bodyWork);
    books[bookIndex(kBookNormal, i)] = grown(books[bookIndex(kBookNormal, i)], normal);
    books[bookIndex(kBookSliders, i)] = grown(books[bookIndex(kBookSliders, i)], vec4(sliders.xyz, 0.0));
    books[bookIndex(kBookFlow, i)] = grown(flow, flown);
}

#endif
