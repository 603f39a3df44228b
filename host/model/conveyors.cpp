#include "host/model/conveyors.h"

#include <algorithm>
#include <cmath>

#include "host/model/body_form.h"

namespace vkdose {
namespace {

constexpr double kParallel = 0.999;  ///< cosine of the angle between two axes that count as parallel
/// A thing that carries less in a turn, over its radius, is a paddle: its facets are rounded.
constexpr double kPaddle = 0.02;

/// The body itself, over the length of its axis [m2]; 0 of a wire, as in the paper's form, and where no form tells.
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

/// Radius, of a wire that of its centre line, and pitch of a helix around the z axis of its body [m].
struct Helix {
    double radius = 0, pitch = 0;
};
std::optional<Helix> helixOf(const RigidBody& body) {
    for (const geometry::Shape& shape : body.shapes) {
        if (const auto* f = std::get_if<geometry::Flight>(&shape))
            return Helix{f->outerRadius, (f->pitchStart + f->pitchEnd) / 2};
        if (const auto* w = std::get_if<geometry::Coil>(&shape)) return Helix{w->radius, w->pitch};
    }
    return std::nullopt;
}

/// Whether the z axis of the body's frame is the line about which it turns, but for a thousandth of `radius`.
bool turnsAboutItself(const RigidBody& body, const geometry::Turn& turn, double radius) {
    const geometry::Pose& start = body.course.start;
    if (std::abs(glm::dot(start.directionToWorld(Vec3(0, 0, 1)), turn.axis)) < kParallel) return false;
    return glm::length(glm::cross(start.origin - turn.through, turn.axis)) < 1e-3 * radius;
}

/// Whether the powder that is carried this way from `middle` can come to where it is dosed.
bool leadsOut(const Case& c, const Vec3& out, const Vec3& middle) {
    if (c.canister) return out.z > kParallel;
    return std::any_of(c.world.regions.begin(), c.world.regions.end(), [&](const CountRegion& r) {
        if (!r.deletes) return false;
        // A half space beside the axis lies neither ahead nor behind.
        if (r.kind == CountRegion::Kind::Beyond) return glm::dot(r.normal, out) > -0.5;
        return glm::dot((r.low + r.high) / 2.0 - middle, out) > 0;
    });
}

std::optional<Conveyor> conveyorOf(const Case& c, const RigidBody& body) {
    const auto* turn = std::get_if<geometry::Turn>(&body.course.motion);
    if (turn == nullptr || turn->rate == 0) return std::nullopt;
    const std::vector<geometry::Triangle> mesh = trianglesOf(body);
    if (mesh.empty()) return std::nullopt;
    const TurningReach reach = reachOf(mesh, turn->axis, turn->through);
    Conveyor one;
    one.name = body.name;
    one.through = turn->through;
    one.radius = reach.radius;
    double lead = advancePerTurn(mesh, turn->axis, turn->through);  // along the axis, by the right hand
    if (std::abs(lead) < kPaddle * reach.radius) return std::nullopt;
    if (const auto helix = helixOf(body)) {
        if (!turnsAboutItself(body, *turn, helix->radius)) return std::nullopt;
        one.radius = helix->radius;
        lead = std::copysign(helix->pitch, lead);
    }
    one.section = kPi * one.radius * one.radius - solidSection(body, reach.high - reach.low);
    if (one.section <= 0) return std::nullopt;
    const bool along = lead * turn->rate > 0;
    one.out = along ? turn->axis : -turn->axis;
    one.end = glm::dot(turn->through, one.out) + (along ? reach.high : -reach.low);
    one.lead = std::abs(lead);
    one.turns = body.clock == Clock::Drive ? std::abs(turn->rate) : std::abs(turn->rate) / (2 * kPi);
    const Vec3 middle = turn->through + (reach.low + reach.high) / 2 * turn->axis;
    return leadsOut(c, one.out, middle) ? std::optional(one) : std::nullopt;
}

/// Whether a body that moves by time does so in all doses, or in a run without doses to its end; and whether in rests
/// too.
struct Steadiness {
    bool steady = false, inRests = false;
};
Steadiness steadinessOf(const Case& c, const RigidBody& body) {
    const Schedule& s = c.schedule;
    if (body.clock == Clock::Time) {
        const auto& intervals = body.course.schedule.intervals;
        if (intervals.empty()) return {true, true};
        const bool begun = s.rotateTime == 0 || intervals.front().from <= 0 ||
                           (!s.untilRest && intervals.front().from <= s.settleTime);
        return {begun && intervals.front().to >= geometry::kEndless, true};
    }
    if (body.clock != Clock::Phases) return {};
    const auto in = [&](Phase phase) {
        return std::find(body.phases.begin(), body.phases.end(), phase) != body.phases.end();
    };
    if (s.rotateTime == 0) return {in(Phase::Settle), true};  // the whole run
    const bool even = s.restTime == 0 || s.reverseTime() == 0 || in(Phase::Rest) == in(Phase::Reverse);
    const bool inRests = (s.restTime > 0 && in(Phase::Rest)) || (s.reverseTime() > 0 && in(Phase::Reverse));
    return {in(Phase::Rotate) && even, inRests};
}

/// Those of one clock that carry powder out together.
Conveyance together(std::vector<Conveyor> all) {
    Conveyance sum;
    const auto carries = [](const Conveyor& a) { return a.section * a.lead * a.turns; };
    const auto most = std::max_element(all.begin(), all.end(),
                                       [&](const Conveyor& a, const Conveyor& b) { return carries(a) < carries(b); });
    if (most == all.end()) return sum;
    std::rotate(all.begin(), most, std::next(most));
    const Conveyor first = all.front();
    for (const Conveyor& one : all)
        if (glm::dot(one.out, first.out) > kParallel && std::abs(one.end - first.end) <= first.lead)
            sum.conveyors.push_back(one);
    return sum;
}

}  // namespace

double sharedArea(double radiusA, double radiusB, double distance) {
    const double small = std::min(radiusA, radiusB);
    if (distance >= radiusA + radiusB) return 0;
    if (distance <= std::abs(radiusA - radiusB)) return kPi * small * small;
    // Of each circle the segment beyond the line through the two points where they meet.
    const auto segment = [&](double radius, double other) {
        const double way = (distance * distance + radius * radius - other * other) / (2 * distance);
        return radius * radius * std::acos(way / radius) - way * std::sqrt(radius * radius - way * way);
    };
    return segment(radiusA, radiusB) + segment(radiusB, radiusA);
}

double Conveyance::volume() const {
    double sum = 0;
    for (std::size_t i = 0; i < conveyors.size(); ++i) {
        const Conveyor& a = conveyors[i];
        sum += a.section * a.lead * a.turns;
        for (std::size_t k = i + 1; k < conveyors.size(); ++k) {
            const Conveyor& b = conveyors[k];
            const double apart = glm::length(glm::cross(b.through - a.through, a.out));
            sum -= sharedArea(a.radius, b.radius, apart) * (a.lead * a.turns + b.lead * b.turns) / 2;
        }
    }
    return sum;
}

std::vector<std::string> Conveyance::names() const {
    std::vector<std::string> names;
    for (const Conveyor& one : conveyors) names.push_back(one.name);
    return names;
}

std::optional<Conveyance> conveyanceOf(const Case& c) {
    std::vector<Conveyor> driven, always, rotating;
    for (const RigidBody& body : c.world.bodies) {
        const bool byDrive = body.clock == Clock::Drive && c.schedule.rotateTime > 0;
        const Steadiness own = steadinessOf(c, body);
        if (!byDrive && !own.steady) continue;
        if (const auto one = conveyorOf(c, body)) (byDrive ? driven : own.inRests ? always : rotating).push_back(*one);
    }
    Conveyance best;
    double most = 0;
    for (std::vector<Conveyor>* list : {&driven, &always, &rotating}) {
        Conveyance sum = together(*list);
        sum.byDrive = list == &driven;
        sum.inRests = list == &always;
        // Of a drive that stands nothing is carried; its turn counts as a second then.
        const double speed = c.schedule.coilSpeed > 0 ? c.schedule.coilSpeed / (2 * kPi) : 1;
        const double flow = sum.volume() * (sum.byDrive ? speed : 1);
        if (!(flow > most)) continue;
        most = flow;
        best = std::move(sum);
    }
    return most > 0 ? std::optional(best) : std::nullopt;
}

}  // namespace vkdose
