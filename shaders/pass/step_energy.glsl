// Part of pass/step, in its variant ENERGY_BOOK: the energy book. Only adds to it; nothing that moves a particle reads it.

Book book;

void addToBook(float share, Book b) {
    book.normal += share * b.normal;
    book.sliders += share * b.sliders;
    book.flow += share * b.flow;
    book.elastic += share * b.elastic;
}

Exerted exertedNow(Overlap o, Response r, vec4 stored) {
    return Exerted(vec4(o.normal, r.hysteretic), vec4(r.sliding + o.normal * r.damping, o.depth),
                   vec4(r.couple, stored.x));
}

const Exerted kNothing = Exerted(vec4(0.0), vec4(0.0), vec4(0.0));

vec3 pairVelocity(Exerted e, Body a, Body b) {
    float leverA = a.sphere.radius - 0.5 * e.rest.w, leverB = b.sphere.radius - 0.5 * e.rest.w;
    return (a.velocity - b.velocity) - cross(leverA * a.spin + leverB * b.spin, e.normal.xyz);
}

/// A pair books half on each side. `old` and `h` are its history before and after the step.
void bookPair(uint i, uint list, uint slot, Body a, Body b, Overlap o, Response r, bool known, bool touching, History old,
              History h) {
    Exerted before = kNothing, now = kNothing;
    if (known)
        before = Exerted(readHistory(list, slot, 2u, i), readHistory(list, slot, 3u, i), readHistory(list, slot, 4u, i));
    float ra = a.sphere.radius, rb = b.sphere.radius, reduced = 2.0 * ra * rb / (ra + rb);
    vec4 storedBefore = elasticEnergy(pairLaw, 0.0, reduced, old), stored = vec4(0.0);
    storedBefore.x = before.couple.w;
    if (touching) {
        stored = elasticEnergy(pairLaw, r.hysteretic, reduced, h);
        now = exertedNow(o, r, stored);
        history[historyIndex(list, slot, 2u, i)] = now.normal;
        history[historyIndex(list, slot, 3u, i)] = now.rest;
        history[historyIndex(list, slot, 4u, i)] = now.couple;
    }
    Work x = halfStepWork(before, pairVelocity(before, a, b), a.spin - b.spin, springDt);
    Work y = halfStepWork(now, pairVelocity(now, a, b), a.spin - b.spin, springDt);
    if (push.opening == 1u)
        addToBook(0.5, bookLoaded(stored));
    else if (known || touching)
        addToBook(0.5, bookContact(before, now, known, touching, storedBefore, stored, x, y, pairLaw.normal.z, r.slips));
}

/// Motion of the particle against a wall that turns at `rate` about the z axis, at the contact of `e`, when the
/// particle's centre was at `centre`.
vec3 wallVelocity(Exerted e, Body me, vec3 centre, float rate) {
    float lever = me.sphere.radius - 0.5 * e.rest.w;
    vec3 point = centre - lever * e.normal.xyz;
    return (me.velocity - rate * vec3(-point.y, point.x, 0.0)) - lever * cross(me.spin, e.normal.xyz);
}

void bookWall(uint i, uint slot, Body me, ContactParams law, float rate, Overlap o, Response r, bool known,
              bool touching, History old, History h) {
    uint at = wallHistoryIndex(slot, 2u, i);
    Exerted before = kNothing, now = kNothing;
    if (known)
        before = Exerted(readWallHistory(at), readWallHistory(at + push.particles),
                         readWallHistory(at + 2u * push.particles));
    float reduced = 2.0 * me.sphere.radius;
    vec4 storedBefore = elasticEnergy(law, 0.0, reduced, old), stored = vec4(0.0);
    storedBefore.x = before.couple.w;
    if (touching) {
        stored = elasticEnergy(law, r.hysteretic, reduced, h);
        now = exertedNow(o, r, stored);
        wallHistory[at] = now.normal;
        wallHistory[at + push.particles] = now.rest;
        wallHistory[at + 2u * push.particles] = now.couple;
    }
    vec3 spin = me.spin - vec3(0.0, 0.0, rate);
    vec3 came = me.sphere.high - springDt * me.velocity;  // where it was when `before` acted
    Work x = halfStepWork(before, wallVelocity(before, me, came, rate), spin, springDt);
    Work y = halfStepWork(now, wallVelocity(now, me, me.sphere.high, rate), spin, springDt);
    if (push.opening == 1u)
        addToBook(1.0, bookLoaded(stored));
    else
        addToBook(1.0, bookContact(before, now, known, touching, storedBefore, stored, x, y, law.normal.z, r.slips));
}

const Response kNoResponse =
    Response(vec3(0.0), vec3(0.0), vec3(0.0), 0.0, 0.0, bvec3(false));
const Overlap kNoOverlap = Overlap(0.0, vec3(0.0));

/// A pair that touched at the last step and has parted.
void partPair(uint i, Body me, uint list, uint slot) {
    uint j = readRow(list, slot, i);
    Body other = readBody(j);
    History old = History(readHistory(list, slot, 0u, i), readHistory(list, slot, 1u, i));
    Body a = me, b = other;
    if (i > j) {
        a = other;
        b = me;
    }
    bookPair(i, list, slot, a, b, kNoOverlap, kNoResponse, true, false, old, old);
}

/// Walls and turns that touched at the last step (`was`) and do not any more (`is`).
void partWalls(uint i, Body me, uint was, uint is) {
    for (uint parted = was & ~is; parted != 0u; parted &= parted - 1u) {
        uint bit = findLSB(parted);
        bool turning = bit >= kMaxSurfaces;
        uint slot = turning ? SURFACES + bit - kMaxSurfaces : bit;
        ContactParams law = wallLaw;
        if (turning) law = coilLaw;
        uint at = wallHistoryIndex(slot, 0u, i);
        History old = History(readWallHistory(at), readWallHistory(at + push.particles));
        bookWall(i, slot, me, law, turning ? coil.motion.x : 0.0, kNoOverlap, kNoResponse, true, false, old, old);
    }
}

void openBook(uint i) {
    book = Book(books[bookIndex(kBookNormal, i)], books[bookIndex(kBookSliders, i)], books[bookIndex(kBookFlow, i)],
                vec4(0.0));
}

/// Adds the coil's work, what came with the load and what leaves with the particle. The velocities are those before
/// and after the kick.
void closeBook(uint i, Body me, vec3 velocity, vec3 spin, float mass, vec3 gravity, float coilTorque, bool leaves) {
    bool opening = push.opening == 1u;
    book.sliders.w -= 0.5 * springDt * coil.motion.x * (book.flow.z + coilTorque);
    book.flow.z = coilTorque;
    float r = me.sphere.radius;
    vec3 v = opening ? 2.0 * me.velocity - velocity : me.velocity, w = opening ? 2.0 * me.spin - spin : me.spin;
    float motion = mass * (0.5 * dot(v, velocity) + 0.2 * r * r * dot(w, spin) - dot(gravity, me.sphere.high));
    if (opening) book.flow.x += motion;
    if (leaves) {
        book.flow.y += motion + dot(book.elastic, vec4(1.0));
        book.flow.z = 0.0;
        book.elastic = vec4(0.0);
    }
    books[bookIndex(kBookNormal, i)] = book.normal;
    books[bookIndex(kBookSliders, i)] = book.sliders;
    books[bookIndex(kBookFlow, i)] = book.flow;
    books[bookIndex(kBookElastic, i)] = book.elastic;
}
