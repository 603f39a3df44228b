// Part of pass/step: contacts with the fixed surfaces.

struct WallForce {
    vec3 force;
    vec3 couple;
};

/// Contact with a wall or the coil whose history is in `slot`; `wall` and `wallSpin` are the motion of the wall.
WallForce meetWall(uint i, Body me, Overlap o, ContactParams law, vec3 wall, vec3 wallSpin, uint slot, bool known,
                   inout Sum sum) {
    uint at0 = wallHistoryIndex(slot, 0u, i), at1 = wallHistoryIndex(slot, 1u, i);
    vec4 old0 = readWallHistory(at0), old1 = readWallHistory(at1);
    History h = History(known ? old0 : vec4(0.0), known ? old1 : vec4(0.0));
    float lever = me.sphere.radius - 0.5 * o.depth;
    Meeting m = Meeting(o.normal, o.depth, 2.0 * me.sphere.radius,
                        (me.velocity - wall) - lever * cross(me.spin, o.normal), me.spin - wallSpin);
#ifdef ENERGY_BOOK
    History old = h;
#endif
    Response r = contactResponse(law, choices, m, springDt, h);
    wallHistory[at0] = h.slidingMax;
    wallHistory[at1] = h.rollingTorsion;
#ifdef ENERGY_BOOK
    bookWall(i, slot, me, law, wallSpin.z, o, r, known, true, old, h);
#endif
    sum.force += r.force;
    sum.torque += r.couple - lever * cross(o.normal, r.sliding);
    sum.overlap = max(sum.overlap, o.depth / me.sphere.radius);
    return WallForce(r.force, r.couple);
}

// The kind is known when the pipeline is made, so that all but one branch of surfaceGap fold away, and the parameters
// are read outside any branch. One line per surface, because drivers differ in which loops they unroll.
#define PROBE(s)                                                                                           \
    if (s < SURFACES)                                                                                      \
        candidates |= surfaceGap((KINDS >> (4u * s)) & 15u, members[member].surface[s], me.sphere) < kSlack \
                          ? 1u << s                                                                        \
                          : 0u;

uint surfaceCandidates(Body me) {
    const float kSlack = 1e-7;  // [m], above the rounding of surfaceGap
    uint candidates = 0u;
    PROBE(0u)
    PROBE(1u)
    PROBE(2u)
    PROBE(3u)
    PROBE(4u)
    PROBE(5u)
    PROBE(6u)
    PROBE(7u)
    for (uint s = kUnrolledSurfaces; s < SURFACES; ++s) {
        SurfaceParams p = members[member].surface[s];
        if (surfaceGap(uint(p.pointHigh.w), p, me.sphere) < kSlack) candidates |= 1u << s;
    }
    return me.sphere.radius > 0.0 ? candidates : 0u;
}

uint touchSurfaces(uint i, Body me, uint mark, inout Sum sum) {
    uint met = 0u;
    for (uint candidates = surfaceCandidates(me); candidates != 0u; candidates &= candidates - 1u) {
        uint s = findLSB(candidates);
        SurfaceParams p = members[member].surface[s];
        Overlap o = surfaceOverlap(uint(p.pointHigh.w), p, me.sphere);
        if (o.depth > 0.0) {
            met |= 1u << s;
            meetWall(i, me, o, wallLaw, vec3(0.0), vec3(0.0), s, (mark & (1u << s)) != 0u, sum);
        }
    }
    return met;
}
