// Part of pass/contacts: two particles.

void meetParticles(uint slot) {
    uvec2 who = readEntry(slot);
    Body a = readBody(who.x), b = readBody(who.y);
    History h = History(readHistory(0u, slot), readHistory(1u, slot));
#ifdef ENERGY_BOOK
    History old = h;
#endif
    Overlap o = sphereOverlap(a.sphere, b.sphere);
    bool touching = o.depth > 0.0;
    float ra = a.sphere.radius, rb = b.sphere.radius;
    float leverA = ra - 0.5 * o.depth, leverB = rb - 0.5 * o.depth;
    vec3 velocity = (a.velocity - b.velocity) - cross(leverA * a.spin + leverB * b.spin, o.normal);
    Meeting m = Meeting(o.normal, o.depth, 2.0 * ra * rb / (ra + rb), velocity, a.spin - b.spin);
    Response r = contactResponse(pairLaw, choices, m, springDt, h);
    vec3 turn = cross(o.normal, r.sliding);

    history[historyIndex(0u, slot)] = touching ? h.slidingMax : vec4(0.0);
    history[historyIndex(1u, slot)] = touching ? h.rollingTorsion : vec4(0.0);
    forces[slot] = touching ? vec4(r.force, o.depth / min(ra, rb)) : vec4(0.0);
    torques[slot] = touching ? vec4(r.couple - leverA * turn, 0.0) : vec4(0.0);
    torques[slotCount() + slot] = touching ? vec4(-r.couple - leverB * turn, 0.0) : vec4(0.0);
#ifdef ENERGY_BOOK
    bookPair(slot, a, b, o, r, touching, old, h);
#endif
}
