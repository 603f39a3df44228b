#version 450
// pairs: computes the contacts between particles in this step, one listed pair per invocation.
// Reads the source half of the state, entries, history; writes history, forces and torques, which `move` gathers. A
// contact that does not touch exerts nothing and remembers nothing.
#extension GL_GOOGLE_include_directive : require
#include "shared/buffers.glsl"
#include "pass/body.glsl"
#include "pass/history.glsl"
#include "pass/sides.glsl"
#ifdef ENERGY_BOOK
#include "pass/slot_books.glsl"
#endif

void main() {
    // These are the same for all invocations. lavapipe reads them once here, but lane by lane behind a branch.
    openMember();
    dither = ditherOf(stepNumber());
    ContactParams law = lawOf(pairIndex(kFirstPowder, kFirstPowder));
    uvec4 chosen = choices();
    float density = gravity().w;
    float springDt = springStep();
    uint listed = control.listed.x;
    if (waits() || invocation() >= listed) return;
    uint slot = firstPairSlot() + invocation();

    uvec2 who = entriesAt(slot);
    Body a = readBody(who.x), b = readBody(who.y);
    if (POWDERS > 1u) law = lawOf(pairIndex(a.material, b.material));
    History h = historyOfSlot(slot);
#ifdef ENERGY_BOOK
    History old = h;
#endif
    if (PERIODS == 1u) {
        Two3 image = nearestImage(b.sphere.high, b.sphere.low, a.sphere.high, period());
        b.sphere = Sphere(image.high, image.low, b.sphere.radius);
    }
    Overlap o = sphereOverlap(a.sphere, b.sphere);
    float ra = a.sphere.radius, rb = b.sphere.radius, reduced = 2.0 * ra * rb / (ra + rb);
    bool touching = holds(law, o.depth, reduced, h.slidingMax.w);
    float leverA = ra - 0.5 * o.depth, leverB = rb - 0.5 * o.depth;
    vec3 velocity = (a.velocity - b.velocity) - cross(leverA * a.spin + leverB * b.spin, o.normal);
    float mass =
        reducedMass(sphereMass(densityOf(a.material, density), ra), sphereMass(densityOf(b.material, density), rb));
    Meeting m = Meeting(o.normal, o.depth, reduced, mass, velocity, a.spin - b.spin, 1.0);
    meetParticles(who.x, who.y);
    Response r = contactResponse(law, chosen, m, springDt, h);
    vec3 turn = cross(o.normal, r.sliding);

    keepHistory(slot, h, touching);
    writeForce(slot, touching ? vec4(r.force, o.depth / min(ra, rb)) : vec4(0.0));
    writeTorques(slot, touching ? vec4(r.couple - leverA * turn, 0.0) : vec4(0.0),
                 touching ? vec4(-r.couple - leverB * turn, 0.0) : vec4(0.0));
    writeFlow(slot, touching ? flowNow() : vec4(0.0));
#ifdef ENERGY_BOOK
    bookPair(law, springDt, slot, a, b, o, r, touching, old, h);
#endif
}
