#include "host/backend/reference/contact.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/backend/reference/rolling.h"
#include "host/backend/reference/sliding.h"
#include "host/backend/reference/torsion.h"
#include "host/law/law.h"

namespace vkdose::reference {

std::optional<Touch> touchSphere(const Body& i, const Body& j, double reach) {
    const Vec3 apart = i.position - j.position;
    const double distance = glm::length(apart);
    const double overlap = i.radius + j.radius - distance;
    if (!(overlap > -reach)) return std::nullopt;

    Touch touch{};
    touch.normal = apart / distance;
    touch.overlap = overlap;
    touch.reduced = 2 * i.radius * j.radius / (i.radius + j.radius);
    touch.smaller = std::min(i.radius, j.radius);
    touch.mass = i.mass > 0 ? i.mass * j.mass / (i.mass + j.mass) : 0;
    touch.leverI = -(i.radius - overlap / 2) * touch.normal;
    touch.leverJ = (j.radius - overlap / 2) * touch.normal;
    touch.velocity = contactVelocity(i, touch.leverI, j, touch.leverJ);
    touch.spin = i.spin - j.spin;
    return touch;
}

std::optional<Touch> touchWall(const Body& i, const Vec3& normal, double distance, const geometry::Moving& wall,
                               double reach, double back) {
    const double overlap = i.radius - distance;
    if (!(overlap > -reach)) return std::nullopt;

    Touch touch{};
    touch.normal = normal;
    touch.overlap = overlap;
    touch.reduced = 2 * i.radius;
    touch.smaller = i.radius;
    touch.mass = i.mass;
    touch.leverI = -(i.radius - overlap / 2) * normal;
    touch.leverJ = Vec3(0);
    touch.velocity = (i.velocity + glm::cross(i.spin, touch.leverI)) -
                     wall.at(i.position - back * i.velocity + touch.leverI);  // where the contact was then
    touch.spin = i.spin - wall.spin;
    return touch;
}

Vec3 contactVelocity(const Body& i, const Vec3& leverI, const Body& j, const Vec3& leverJ) {
    return (i.velocity + glm::cross(i.spin, leverI)) - (j.velocity + glm::cross(j.spin, leverJ));
}

namespace {

/// What the law says along the normal, and what that does to the springs of the other directions.
struct Normal {
    NormalAnswer answer;
    double kept;        ///< share of their length
    double stored = 0;  ///< as a user's law says [J]
    LawProperties flows{};
};

/// Of a user's law. Answers that its trial would have refused make the force no number, which ends the run.
Normal userNormal(const ContactParameters& p, const Touch& touch, double speed, History& history, LawProgram& user) {
    const LawAnswer a =
        user.answer(p.own, {touch.overlap, speed, touch.reduced / 2, touch.mass}, history.own, touch.sides);
    const auto isSize = [](double x) { return x >= 0 && std::isfinite(x); };
    const bool sound = isSize(a.stiffness) && a.stiffness > 0 && a.stiffness <= mostStiffness(p) && isSize(a.damping) &&
                       isSize(a.pull) && std::ranges::all_of(a.flows, [](double flow) { return std::isfinite(flow); });
    const double before = history.stiffness;
    history.stiffness = a.stiffness;
    history.maxOverlap = std::max(touch.overlap, 1e-9 * touch.reduced);  // above 0: the contact goes on
    return {{sound ? a.force : std::numeric_limits<double>::quiet_NaN(), a.damping, a.pull, a.stiffness * p.kt,
             a.stiffness * p.kr, a.stiffness * p.kTo, a.damping * p.gammaT, a.damping * p.gammaR, a.damping * p.gammaTo,
             true},
            springsKept(before, a.stiffness),
            a.energy,
            a.flows};
}

Normal normalOf(const ContactParameters& p, const Touch& touch, double speed, History& history, LawProgram* user) {
    if (user != nullptr) return userNormal(p, touch, speed, history, *user);
    const double kept =
        history.maxOverlap > 0 ? springsKept(p, touch.reduced, touch.mass, history.overlap, touch.overlap) : 1.0;
    return {normalAnswer(p, touch.overlap, touch.reduced, touch.mass, history.maxOverlap), kept};
}

}  // namespace

Response contactResponse(const ContactLaw& law, MaterialPair pair, const Touch& touch, double dt, History& history,
                         LawProgram* user) {
    const ContactParameters& p = law.of(pair);
    const Vec3& n = touch.normal;

    const double normalVelocity = glm::dot(touch.velocity, n);
    const auto [answer, kept, stored, flows] = normalOf(p, touch, -touch.share * normalVelocity, history, user);
    history.overlap = touch.overlap;
    history.sliding *= kept;
    history.rolling *= kept;
    history.torsion *= kept;
    // The overlap grows by `share` of the way along the normal; the same share of the force takes as much work.
    const double damping = -answer.gamma * touch.share * normalVelocity;
    const double normal = touch.share * (answer.force + damping);
    const double bearing =
        p.coulombLimit == CoulombLimit::Luding
            ? touch.share * std::max(0.0, answer.force + answer.pull)  // adhesion moves friction's zero
            : std::abs(normal);

    const Vec3 tangentialVelocity = touch.velocity - n * normalVelocity;
    bool slides = false, rolls = false, twists = false;
    const Vec3 tangential = frictionForce({answer.kt, answer.gammaT, p.mu, answer.springAlone}, bearing, n,
                                          tangentialVelocity, dt, history.sliding, &slides);

    const double lever = rollingLever(law.rollingLever, touch.reduced);
    const Vec3 rolling = frictionForce({answer.kr, answer.gammaR, p.muR, answer.springAlone}, bearing, n,
                                       rollingVelocity(lever, n, touch.spin), dt, history.rolling, &rolls);
    const double torsion = torsionForce({answer.kTo, answer.gammaTo, p.muTo, answer.springAlone}, bearing,
                                        torsionVelocity(lever, n, touch.spin), dt, history.torsion, &twists);

    Response response{};
    response.flows = flows;
    response.force = normal * n + tangential;
    const Vec3 rollingCouple = rollingTorque(lever, n, rolling), torsionCouple = lever * torsion * n;
    response.couple = rollingCouple + torsionCouple;
    response.torqueI = glm::cross(touch.leverI, tangential) + response.couple;
    response.torqueJ = glm::cross(touch.leverJ, -tangential) - response.couple;
    const bool adhesive = normalLaw(p).adheres(p, touch.overlap, answer.force);
    response.parts = {.hysteretic = answer.force,
                      .damping = touch.share * damping,
                      .sliding = tangential,
                      .rolling = rollingCouple,
                      .torsion = torsionCouple,
                      .adhesive = adhesive,
                      .slides = slides,
                      .rolls = rolls,
                      .twists = twists,
                      .law = p.law,
                      .arriving = workOfFirstTouch(p, touch.overlap, touch.reduced, answer.force),
                      .stored = stored,
                      .kt = answer.kt,
                      .kr = answer.kr,
                      .kTo = answer.kTo,
                      .share = touch.share};
    return response;
}

}  // namespace vkdose::reference
