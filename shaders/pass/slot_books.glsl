// The book of a contact, of one step; `move` adds it to that of its first body. Nothing that moves a particle reads it.
#ifndef VKDOSE_PASS_SLOT_BOOKS_GLSL
#define VKDOSE_PASS_SLOT_BOOKS_GLSL

#include "law/energy.glsl"
#include "pass/body.glsl"

const Exerted kNothing = Exerted(vec4(0.0), vec4(0.0), vec4(0.0));
const Response kNoResponse = Response(vec3(0.0), vec3(0.0), vec3(0.0), 0.0, 0.0, bvec3(false));

/// The normal of a contact stands there times its share.
Exerted exertedNow(Overlap o, float share, Response r, vec4 stored) {
    return Exerted(vec4(share * o.normal, r.hysteretic), vec4(r.sliding + o.normal * r.damping, o.depth),
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

/// What a contact that exerted `before` with the history `old` had stored; fields as in kBookElastic.
vec4 storedAt(ContactParams law, Exerted before, float reduced, History old) {
    return vec4(before.couple.w, sliderEnergy(law, before.rest.w, reduced, old));
}

/// `old` and `h` are the history before and after the step.
void bookPair(ContactParams law, float springDt, uint slot, Body a, Body b, Overlap o, Response r, bool touching,
              History old, History h) {
    bool known = old.slidingMax.w > 0.0;
    Exerted before = exertedBefore(slot, known), now = kNothing;
    float ra = a.sphere.radius, rb = b.sphere.radius, reduced = 2.0 * ra * rb / (ra + rb);
    vec4 storedBefore = storedAt(law, before, reduced, old), stored = vec4(0.0);
    if (touching) {
        stored = elasticEnergy(law, r.hysteretic, o.depth, reduced, h);
        now = exertedNow(o, 1.0, r, stored);
    }
    keepExerted(slot, now);
    Work x = halfStepWork(before, pairVelocity(before, a, b), a.spin - b.spin, springDt);
    Work y = halfStepWork(now, pairVelocity(now, a, b), a.spin - b.spin, springDt);
    Book booked = Book(vec4(0.0), vec4(0.0), vec4(0.0), vec4(0.0));
    if (opening())
        booked = bookLoaded(stored);
    else if (known || touching)
        booked = bookContact(before, now, known, touching, storedBefore, stored, x, y, law, reduced, r.slips);
    writeBook(slot, booked);
}

/// How a wall moves: as BodyMotion in shared/geometry.h.
struct WallMotion {
    vec3 velocity;
    vec3 spin;
    vec3 centre;
};
const WallMotion kWallAtRest = WallMotion(vec3(0.0), vec3(0.0), vec3(0.0));

/// Velocity of the wall at the contact of `e`, when the particle's centre was at `centre`.
vec3 wallVelocity(WallMotion wall, Exerted e, Body me, vec3 centre) {
    vec3 point = centre - (me.sphere.radius - 0.5 * e.rest.w) * e.normal.xyz;
    return wall.velocity + cross(wall.spin, point - wall.centre);
}

/// Velocity of the particle relative to that.
vec3 fromWall(vec3 wall, Exerted e, Body me) {
    return (me.velocity - wall) - (me.sphere.radius - 0.5 * e.rest.w) * cross(me.spin, e.normal.xyz);
}

/// What a wall that moves does to the particle in half a step by the force `e` [J].
float halfStepGiven(Exerted e, vec3 velocity, vec3 spin, float dt) {
    vec3 force = e.normal.xyz * e.normal.w + e.rest.xyz;
    return 0.5 * dt * (dot(force, velocity) + dot(e.couple.xyz, spin));
}

/// With a unit normal, and the share of the law's force that acts.
Exerted acting(Exerted e) {
    float share = length(e.normal.xyz);
    return Exerted(share > 0.0 ? vec4(e.normal.xyz / share, share * e.normal.w) : vec4(0.0), e.rest, e.couple);
}

/// The book of a contact with a wall in this step; flow.w: work of the wall.
Book bookWall(ContactParams law, float springDt, WallMotion wall, float reduced, Body me, Exerted before, Response r,
              bool known, bool touching, vec4 stored, Exerted now, vec4 storedBefore) {
    vec3 spin = me.spin - wall.spin;
    // Where both were when `before` acted.
    vec3 came = me.sphere.high - springDt * me.velocity;
    WallMotion wallBefore = WallMotion(wall.velocity, wall.spin, wall.centre - springDt * wall.velocity);
    Exerted past = acting(before), present = acting(now);
    vec3 first = wallVelocity(wallBefore, past, me, came), second = wallVelocity(wall, present, me, me.sphere.high);
    Work x = halfStepWork(past, fromWall(first, past, me), spin, springDt);
    Work y = halfStepWork(present, fromWall(second, present, me), spin, springDt);
    if (opening()) return bookLoaded(stored);
    Book b = bookContact(before, now, known, touching, storedBefore, stored, x, y, law, reduced, r.slips);
    b.flow.w = halfStepGiven(past, first, wall.spin, springDt) + halfStepGiven(present, second, wall.spin, springDt);
    return b;
}

/// `before` is what the contact exerted in the last step, under `lawBefore`; `old` and `h` its history before and after
/// this one.
void bookSurface(ContactParams law, float springDt, uint slot, Body me, Overlap o, Response r, bool touching,
                 ContactParams lawBefore, Exerted before, History old, History h) {
    bool known = old.slidingMax.w > 0.0;
    Exerted now = kNothing;
    vec4 stored = vec4(0.0);
    float reduced = 2.0 * me.sphere.radius;
    if (touching) {
        stored = elasticEnergy(law, r.hysteretic, o.depth, reduced, h);
        now = exertedNow(o, 1.0, r, stored);
    }
    keepExerted(slot, now);
    Book booked = Book(vec4(0.0), vec4(0.0), vec4(0.0), vec4(0.0));
    if (known || touching)
        booked = bookWall(law, springDt, kWallAtRest, reduced, me, before, r, known, touching, stored, now,
                          storedAt(lawBefore, before, reduced, old));
    writeBook(slot, booked);
}

/// The book of a slot that has several contacts.
Book slotBook;

void openSlotBook() { slotBook = Book(vec4(0.0), vec4(0.0), vec4(0.0), vec4(0.0)); }

void addToSlotBook(Book b) {
    slotBook.normal += b.normal;
    slotBook.sliders += b.sliders;
    slotBook.flow += b.flow;
    slotBook.elastic += b.elastic;
}

/// A place on a body that is touched: it goes on with what `before` exerted, unless that is kNothing.
void bookPlace(ContactParams law, float springDt, WallMotion wall, float reduced, uint slot, uint place, Body me,
               Overlap o, float share, Response r, bool known, Exerted before, History old, History h) {
    vec4 stored = elasticEnergy(law, r.hysteretic, o.depth, reduced, h);
    Exerted now = exertedNow(o, share, r, stored);
    history[placeHistoryIndex(slot, place, 3u)] = now.normal;
    history[placeHistoryIndex(slot, place, 4u)] = now.rest;
    history[placeHistoryIndex(slot, place, 5u)] = now.couple;
    addToSlotBook(bookWall(law, springDt, wall, reduced, me, before, r, known, true, stored, now,
                           storedAt(law, before, reduced, old)));
}

/// A place that was touched in the last step and is not any more.
void partPlace(ContactParams law, float springDt, WallMotion wall, float reduced, Body me, Exerted before,
               History old) {
    addToSlotBook(bookWall(law, springDt, wall, reduced, me, before, kNoResponse, true, false, vec4(0.0), kNothing,
                           storedAt(law, before, reduced, old)));
}

#endif
