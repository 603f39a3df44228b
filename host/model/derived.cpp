// Closed forms of the paper and the figures that say whether a case is stable and how long it runs.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "host/model/body_form.h"
#include "host/model/case.h"
#include "host/model/size_distribution.h"
#include "host/model/stability.h"

namespace vkdose {
namespace {

/// Time that the coil is expected to turn in a dose, ramps included [s].
double turningTime(const Schedule& s, double massPerTurn) {
    const double rate = massPerTurn * s.coilSpeed / (2 * kPi);
    return s.targetMass > 0 && rate > 0 ? std::min(s.rotateTime, s.targetMass / rate + s.rampTime) : s.rotateTime;
}

/// Cross-section that a body itself takes up of its turn, mean over its length [m2]; 0 where its form does not tell.
double solidSection(const RigidBody& body, double length) {
    double section = 0;
    for (const geometry::Shape& shape : body.shapes) {
        if (const auto* f = std::get_if<geometry::Flight>(&shape)) {
            const double shaft = kPi * f->innerRadius * f->innerRadius;
            const double pitch = (f->pitchStart + f->pitchEnd) / 2;
            section += shaft + f->thickness / pitch * (kPi * f->outerRadius * f->outerRadius - shaft);
        } else if (const auto* m = std::get_if<std::shared_ptr<const geometry::MeshSurface>>(&shape)) {
            const geometry::Mesh& mesh = (*m)->mesh();
            double volume = 0;
            for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
                if (std::binary_search(mesh.inner.begin(), mesh.inner.end(), i)) continue;
                const auto& t = mesh.triangles[i];
                volume += glm::dot(mesh.vertices[t[0]], glm::cross(mesh.vertices[t[1]], mesh.vertices[t[2]])) / 6;
            }
            if (mesh.closed) section += std::abs(volume) / length;
        }
    }
    return section;
}

/// The closed form of a device without a coil: a body that the drive turns about the canister's axis carries powder by
/// its advance through the section that it sweeps and does not take up itself. Of several bodies the one that carries
/// most counts.
void deriveBodies(const Case& c, Derived& d) {
    if (!c.canister || c.schedule.rotateTime == 0) return;
    for (const RigidBody& body : c.world.bodies) {
        const auto* turn = std::get_if<geometry::Turn>(&body.course.motion);
        if (turn == nullptr || body.clock != Clock::Drive || std::abs(turn->axis.z) < 0.999) continue;
        const std::vector<geometry::Triangle> mesh = trianglesOf(body);
        if (mesh.empty()) continue;
        const TurningReach reach = reachOf(mesh, turn->axis, turn->through);
        double lead = advancePerTurn(mesh, turn->axis, turn->through);
        // Of a wire the pitch, and the section within its centre line, as of [coil].
        const auto* wire = std::get_if<geometry::Coil>(&body.shapes.front());
        if (wire) lead = std::copysign(wire->pitch, lead);
        const double advance = turn->rate * turn->axis.z * lead;
        const double section = wire ? kPi * wire->radius * wire->radius
                                    : kPi * reach.radius * reach.radius - solidSection(body, reach.high - reach.low);
        const double perTurn = c.bulkDensity * advance * section;
        // Less is the rounding of a paddle's facets.
        if (section <= 0 || advance < 0.02 * reach.radius || perTurn <= d.massPerTurn) continue;
        d.massPerTurn = perTurn;
        d.pushVelocity = advance * c.schedule.coilSpeed / (2 * kPi);
        d.tipVelocity = c.schedule.coilSpeed * std::abs(turn->rate) * reach.radius;
    }
}

double predictedSteps(const Case& c, double doses, double massPerTurn) {
    const Schedule& s = c.schedule;
    double time = s.settleTime;
    if (s.rotateTime > 0) {
        double count = std::isfinite(doses) ? std::ceil(doses) : 0;
        if (s.stop.kind != StopRule::Kind::None) count += s.stop.doses;
        count = std::min(count, static_cast<double>(s.stop.maxDoses));
        time += count * (turningTime(s, massPerTurn) + s.reverseTime() + s.restTime);
    }
    return std::ceil(std::min(time, s.stop.endTime) / c.world.timeStep);
}

}  // namespace

double Schedule::fastestSpeed() const {
    double fastest = coilSpeed;
    for (const DoseStage& stage : stages) fastest = std::max(fastest, stage.speed);
    return fastest;
}

double Schedule::reverseTime() const {
    return reverseTurns > 0 ? reverseTurns * 2 * kPi / coilSpeed + rampTime : 0;
}

bool Schedule::isPlain() const {
    return targetMass == 0 && rampTime == 0 && !std::isfinite(maxTorque);
}

double contactDuration(const ContactParameters& p, double mass, double k) {
    const double decay = p.gamma / (2 * mass);
    const double square = k / mass - decay * decay;
    return square > 0 ? kPi / std::sqrt(square) : std::numeric_limits<double>::infinity();
}

Derived derive(const Case& c, const Insertion& filled) {
    Derived d;
    const PowderSizes sizes = powderSizes(c);
    d.stiffest = std::numeric_limits<double>::infinity();
    for (const MaterialPair& pair : occurringPairs(c.world)) {
        if (!haveSpheres(c.world, pair, sizes)) continue;
        /// Of spheres of these sizes, without damping if that is not wanted, on the stiffness that `k` names.
        const auto duration = [&](double SizeRange::*size, bool damped, double ContactParameters::*k) {
            const double a = sizes[std::size_t(pair.a)].*size, b = otherSide(c.world, pair, sizes, size);
            const double mass = reducedMass(c.world, pair, a, b);
            ContactParameters p = stiffest(c.dosingLaw.of(pair), mass, a, b, c.world.maxOverlapRatio);
            if (!damped) p.gamma = 0;
            return contactDuration(p, mass, p.*k);
        };
        const double shortest = duration(&SizeRange::smallest, false, &ContactParameters::k2Max);
        d.durations.push_back(
            {nameOf(c.world, pair), duration(&SizeRange::mean, true, &ContactParameters::k1), shortest});
        d.stiffest = std::min(d.stiffest, shortest);
    }
    d.timeStep = c.world.timeStep;
    d.particles = filled.particles.size();
    d.fillMass = filled.mass;
    if (c.world.coil) {
        const geometry::Coil& coil = *c.world.coil;
        d.pushVelocity = coil.pitch * c.schedule.coilSpeed / (2 * kPi);
        d.tipVelocity = c.schedule.coilSpeed * coil.radius;
        d.massPerTurn = c.bulkDensity * coil.pitch * kPi * coil.radius * coil.radius;
    } else {
        deriveBodies(c, d);
    }
    if (d.massPerTurn > 0) {
        const Schedule& s = c.schedule;
        const double turns = s.coilSpeed * (s.rotateTime - s.rampTime) / (2 * kPi);
        d.massPerDose = d.massPerTurn * turns;
        if (s.targetMass > 0) d.massPerDose = std::min(d.massPerDose, s.targetMass);
        d.doses = d.massPerDose > 0 ? d.fillMass / d.massPerDose : 0;
    }
    d.steps = predictedSteps(c, d.doses, d.massPerTurn);
    return d;
}

}  // namespace vkdose
