// The book of a contact, of one step; `move` adds it to that of its first body. Nothing that moves a particle reads it.
#ifndef VKDOSE_PASS_SLOT_BOOKS_GLSL
#define VKDOSE_PASS_SLOT_BOOKS_GLSL

#include "law/energy.glsl"
#include "pass/body.glsl"

const Exerted kNothing = Exerted(vec4(0.0), vec4(0.0), vec4(0.0));
const Response kNoResponse = Response(vec3(0.0), vec3(0.0), vec3(0.0), 0.0, 0.0, bvec3(false));
const Overlap kNoOverlap = Overlap(0.0, vec3(0.0));

Exerted exertedNow(Overlap o, Response r, vec4 stored) {
    return Exerted(vec4(o.normal, r.hysteretic), vec4(r.sliding + o.normal * r.damping, o.depth),
                   vec4(r.couple, stored.x));
}

void writeBook(uint slot, Book b) {
    books[slotBookIndex(kBookNormal, slot)] = b.normal;
    books[slotBookIndex(kBookSliders, slot)] = b.sliders + vec4(0.0, 0.0, 0.0, b.flow.x);
    books[slotBookIndex(kBookElastic, slot)] = b.elastic;
}

Exerted exertedBefore(uint slot, bool known) {
    Exerted e = Exerted(readHistory(2u, slot), readHistory(3u, slot), readHistory(4u, slot));
    return known ? e : kNothing;
}

void keepExerted(uint slot, Exerted e) {
    history[historyIndex(2u, slot)] = e.normal;
    history[historyIndex(3u, slot)] = e.rest;
    history[historyIndex(4u, slot)] = e.couple;
}

vec3 pairVelocity(Exerted e, Body a, Body b) {
    float leverA = a.sphere.radius - 0.5 * e.rest.w, leverB = b.sphere.radius - 0.5 * e.rest.w;
    return (a.velocity - b.velocity) - cross(leverA * a.spin + leverB * b.spin, e.normal.xyz);
}

/// `old` and `h` are the history before and after the step.
void bookPair(ContactParams law, float springDt, uint slot, Body a, Body b, Overlap o, Response r, bool touching,
              History old, History h) {
    bool known = old.slidingMax.w > 0.0;
    Exerted before = exertedBefore(slot, known), now = kNothing;
    float ra = a.sphere.radius, rb = b.sphere.radius, reduced = 2.0 * ra * rb / (ra + rb);
    vec4 storedBefore = elasticEnergy(law, 0.0, reduced, old), stored = vec4(0.0);
    storedBefore.x = before.couple.w;
    if (touching) {
        stored = elasticEnergy(law, r.hysteretic, reduced, h);
        now = exertedNow(o, r, stored);
    }
    keepExerted(slot, now);
    Work x = halfStepWork(before, pairVelocity(before, a, b), a.spin - b.spin, springDt);
    Work y = halfStepWork(now, pairVelocity(now, a, b), a.spin - b.spin, springDt);
    Book booked = Book(vec4(0.0), vec4(0.0), vec4(0.0), vec4(0.0));
    if (opening())
        booked = bookLoaded(stored);
    else if (known || touching)
        booked = bookContact(before, now, known, touching, storedBefore, stored, x, y, law.normal.z, r.slips);
    writeBook(slot, booked);
}

/// Velocity of the particle relative to a wall that turns at `rate` about the z axis, at the contact of `e`, when the
/// particle's centre was at `centre`.
vec3 wallVelocity(Exerted e, Body me, vec3 centre, float rate) {
    float lever = me.sphere.radius - 0.5 * e.rest.w;
    vec3 point = centre - lever * e.normal.xyz;
    return (me.velocity - rate * vec3(-point.y, point.x, 0.0)) - lever * cross(me.spin, e.normal.xyz);
}

Book bookWall(ContactParams law, float springDt, float rate, float reduced, Body me, Exerted before, Response r,
              bool known, bool touching, vec4 stored, Exerted now, History old) {
    vec4 storedBefore = elasticEnergy(law, 0.0, reduced, old);
    storedBefore.x = before.couple.w;
    vec3 spin = me.spin - vec3(0.0, 0.0, rate);
    vec3 came = me.sphere.high - springDt * me.velocity;  // where it was when `before` acted
    Work x = halfStepWork(before, wallVelocity(before, me, came, rate), spin, springDt);
    Work y = halfStepWork(now, wallVelocity(now, me, me.sphere.high, rate), spin, springDt);
    if (opening()) return bookLoaded(stored);
    return bookContact(before, now, known, touching, storedBefore, stored, x, y, law.normal.z, r.slips);
}

/// `before` is what the contact exerted in the last step, `old` and `h` its history before and after this one.
void bookSurface(ContactParams law, float springDt, uint slot, Body me, Overlap o, Response r, bool touching,
                 Exerted before, History old, History h) {
    bool known = old.slidingMax.w > 0.0;
    Exerted now = kNothing;
    vec4 stored = vec4(0.0);
    float reduced = 2.0 * me.sphere.radius;
    if (touching) {
        stored = elasticEnergy(law, r.hysteretic, reduced, h);
        now = exertedNow(o, r, stored);
    }
    keepExerted(slot, now);
    Book booked = Book(vec4(0.0), vec4(0.0), vec4(0.0), vec4(0.0));
    if (known || touching)
        booked = bookWall(law, springDt, 0.0, reduced, me, before, r, known, touching, stored, now, old);
    writeBook(slot, booked);
}

Book coilBook;

void openCoilBook() { coilBook = Book(vec4(0.0), vec4(0.0), vec4(0.0), vec4(0.0)); }

void bookCoil(ContactParams law, float springDt, float rate, float reduced, uint i, uint turn, Body me, Overlap o,
              Response r, bool known, bool touching, History old, History h) {
    uint at = coilHistoryIndex(turn, 2u, i);
    Exerted before = kNothing, now = kNothing;
    if (known)
        before =
            Exerted(coilHistoryAt(at), coilHistoryAt(at + push.particles), coilHistoryAt(at + 2u * push.particles));
    vec4 stored = vec4(0.0);
    if (touching) {
        stored = elasticEnergy(law, r.hysteretic, reduced, h);
        now = exertedNow(o, r, stored);
        coilHistory[at] = now.normal;
        coilHistory[at + push.particles] = now.rest;
        coilHistory[at + 2u * push.particles] = now.couple;
    }
    Book b = bookWall(law, springDt, rate, reduced, me, before, r, known, touching, stored, now, old);
    coilBook.normal += b.normal;
    coilBook.sliders += b.sliders;
    coilBook.flow += b.flow;
    coilBook.elastic += b.elastic;
}

/// Turns that touched at the last step (`was`) and do not any more (not in `met`).
void partCoil(ContactParams law, float springDt, float rate, float reduced, uint i, Body me, vec4 was, uint met) {
    for (uint t = 0u; t < kMaxTurns; ++t) {
        if (was[t] == kNoTurn || (met & (1u << t)) != 0u) continue;
        uint at = coilHistoryIndex(t, 0u, i);
        History old = History(coilHistoryAt(at), coilHistoryAt(at + push.particles));
        bookCoil(law, springDt, rate, reduced, i, t, me, kNoOverlap, kNoResponse, true, false, old, old);
    }
}

void closeCoilBook(uint slot) { writeBook(slot, coilBook); }

#endif
