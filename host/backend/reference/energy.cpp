#include "host/backend/reference/energy.h"

#include "host/backend/reference/normal.h"

namespace vkdose::reference {

namespace {

/// Work that the parts of a force take from the motion [J].
struct Work {
    double hysteretic = 0, damping = 0, sliding = 0, rolling = 0, torsion = 0;
    double sum() const { return hysteretic + damping + sliding + rolling + torsion; }
};

/// The work that the force `e` takes in half a step. It uses the normal and levers of the step in which the force
/// acted, so that contacts book exactly the force that particles feel. With those of another step, the balance would
/// only be of first order in dt.
Work halfStepWork(const Exerted& e, const Body& i, const Body& j, double dt) {
    if (!e.touching) return {};
    const Vec3 velocity = contactVelocity(i, e.leverI, j, e.leverJ), spin = i.spin - j.spin;
    const double alongNormal = glm::dot(e.normal, velocity);
    const double half = -dt / 2;
    return {half * e.parts.hysteretic * alongNormal, half * e.parts.damping * alongNormal,
            half * glm::dot(e.parts.sliding, velocity), half * glm::dot(e.parts.rolling, spin),
            half * glm::dot(e.parts.torsion, spin)};
}

Work operator+(const Work& a, const Work& b) {
    return {a.hysteretic + b.hysteretic, a.damping + b.damping, a.sliding + b.sliding, a.rolling + b.rolling,
            a.torsion + b.torsion};
}

/// Energy that the normal force loses: the area between its path and the overlap axis, less the stored part. The path
/// of a new contact begins at overlap zero, and the path of a contact that parts ends there. Motion of the particles
/// before or after that within the step does not count here.
double lossByLaw(const Exerted& before, const Exerted& now, double taken) {
    const double stored = now.elastic.normal - before.elastic.normal;
    if (!before.touching) return now.parts.hysteretic * now.overlap / 2 - stored;
    if (!now.touching) return -before.parts.hysteretic * before.overlap / 2 - stored;
    return taken - stored;
}

}  // namespace

Elastic elasticEnergy(const ContactParameters& p, double hysteretic, double reduced, const History& history) {
    const double k2 = unloadingStiffness(p, reduced, history.maxOverlap);
    return {hysteretic * hysteretic / (2 * k2), p.kt * glm::dot(history.sliding, history.sliding) / 2,
            p.kr * glm::dot(history.rolling, history.rolling) / 2, p.kTo * history.torsion * history.torsion / 2};
}

void bookContact(const Exerted& before, const Exerted& now, const Body& i, const Body& j, double dt, EnergyBook& book) {
    const Work taken = halfStepWork(before, i, j, dt) + halfStepWork(now, i, j, dt);

    const double normalLoss = lossByLaw(before, now, taken.hysteretic);
    const bool adhesive = now.touching ? now.parts.adhesive : before.parts.adhesive;
    (adhesive ? book.adhesive : book.plastic) += normalLoss;
    book.numerical += taken.hysteretic - (now.elastic.normal - before.elastic.normal) - normalLoss;
    book.viscous += taken.damping;

    // A slider that sticks loses energy in its dashpot only; when the contact opens its spring snaps.
    const bool opens = !now.touching;
    const auto bookSlider = [&](double work, double stored, bool slips, double& friction) {
        (slips || opens ? friction : book.viscous) += work - stored;
    };
    bookSlider(taken.sliding, now.elastic.sliding - before.elastic.sliding, now.parts.slides, book.sliding);
    bookSlider(taken.rolling, now.elastic.rolling - before.elastic.rolling, now.parts.rolls, book.rolling);
    bookSlider(taken.torsion, now.elastic.torsion - before.elastic.torsion, now.parts.twists, book.torsion);

    book.coilWork -= dt / 2 * j.spin.z * (before.coilTorque + now.coilTorque);
}

double halfStepGiven(const Exerted& e, const Body& j, double dt) {
    if (!e.touching) return 0;
    return dt / 2 *
           (glm::dot(e.force, j.velocity + glm::cross(j.spin, e.leverJ)) +
            glm::dot(e.parts.rolling + e.parts.torsion, j.spin));
}

void bookLoaded(const Exerted& now, EnergyBook& book) {
    book.loaded += now.elastic.normal;
    book.sliding -= now.elastic.sliding;
    book.rolling -= now.elastic.rolling;
    book.torsion -= now.elastic.torsion;
}

void bookDeparture(const Exerted& before, const Body& i, const Body& j, double dt, EnergyBook& book) {
    book.left += before.elastic.sum() + halfStepWork(before, i, j, dt).sum();
}

void addElastic(const Elastic& elastic, EnergyBook& book) {
    book.elasticNormal += elastic.normal;
    book.elasticSliding += elastic.sliding;
    book.elasticRolling += elastic.rolling;
    book.elasticTorsion += elastic.torsion;
}

}  // namespace vkdose::reference
