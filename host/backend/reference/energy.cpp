#include "host/backend/reference/energy.h"

#include <algorithm>

#include "host/law/law.h"

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
    return {half * e.parts.share * e.parts.hysteretic * alongNormal, half * e.parts.damping * alongNormal,
            half * glm::dot(e.parts.sliding, velocity), half * glm::dot(e.parts.rolling, spin),
            half * glm::dot(e.parts.torsion, spin)};
}

Work operator+(const Work& a, const Work& b) {
    return {a.hysteretic + b.hysteretic, a.damping + b.damping, a.sliding + b.sliding, a.rolling + b.rolling,
            a.torsion + b.torsion};
}

/// Energy that the normal force loses.
double lossByLaw(const Exerted& before, const Exerted& now, double taken) {
    const NormalStep step{before.touching,
                          now.touching,
                          before.parts.hysteretic,
                          before.overlap,
                          now.parts.arriving,
                          taken,
                          now.elastic.normal - before.elastic.normal};
    return normalLaw((now.touching ? now : before).parts.law).lost(step);
}

}  // namespace

Elastic elasticEnergy(const ContactParameters& p, const Parts& parts, double overlap, double reduced,
                      const History& history) {
    const double normal = parts.law == NormalLaw::User
                              ? parts.stored
                              : storedEnergy(p, overlap, reduced, parts.hysteretic, history.maxOverlap);
    return {normal, parts.kt * glm::dot(history.sliding, history.sliding) / 2,
            parts.kr * glm::dot(history.rolling, history.rolling) / 2,
            parts.kTo * history.torsion * history.torsion / 2};
}

void bookContact(const Exerted& before, const Exerted& now, const Body& i, const Body& j, double dt, EnergyBook& book) {
    const Work taken = halfStepWork(before, i, j, dt) + halfStepWork(now, i, j, dt);

    const double normalLoss = lossByLaw(before, now, taken.hysteretic);
    const bool adhesive = now.touching ? now.parts.adhesive : before.parts.adhesive;
    (adhesive ? book.adhesive : book.plastic) += normalLoss;
    book.numerical += taken.hysteretic - (now.elastic.normal - before.elastic.normal) - normalLoss;
    book.viscous += taken.damping;

    // A slider that sticks loses energy in its dashpot only; when the contact opens its spring snaps.
    // What a spring loses because the overlap changes its stiffness (springsKept) goes to no motion; friction has it
    // too.
    const bool opens = !now.touching;
    const auto bookSlider = [&](double work, double had, double has, double lost, bool slips, double& friction) {
        if (slips || opens) {
            friction += work - (has - had);
            return;
        }
        book.viscous += work - (has - had) - had * lost;
        friction += had * lost;
    };
    const auto lost = [&](double Parts::*stiffness) {  // share of the spring's energy
        const double was = before.parts.*stiffness, is = now.parts.*stiffness;
        return was > 0 && is > 0 ? 1 - std::min(was / is, is / was) : 0;
    };
    const Elastic &had = before.elastic, &has = now.elastic;
    bookSlider(taken.sliding, had.sliding, has.sliding, lost(&Parts::kt), now.parts.slides, book.sliding);
    bookSlider(taken.rolling, had.rolling, has.rolling, lost(&Parts::kr), now.parts.rolls, book.rolling);
    bookSlider(taken.torsion, had.torsion, has.torsion, lost(&Parts::kTo), now.parts.twists, book.torsion);
}

double halfStepGiven(const Exerted& e, const Body& j, double dt) {
    if (!e.touching) return 0;
    const Vec3 force = (e.parts.share * e.parts.hysteretic + e.parts.damping) * e.normal + e.parts.sliding;
    return dt / 2 *
           (glm::dot(force, j.velocity + glm::cross(j.spin, e.leverJ)) +
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
