// Warnings about bodies: which way they convey, where they end and meet, what lies inside of them.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "geometry/inside.h"
#include "host/advice/body_words.h"
#include "host/advice/cells.h"
#include "host/model/body_form.h"

namespace vkdose {
namespace {

using geometry::Triangle;

/// From so many particles is looked whether a place can be met.
constexpr std::size_t kMostWays = 60;

/// The box around the corners; if there are none, low is above high.
Box extentOf(const std::vector<Triangle>& mesh) {
    Box box{Vec3(1e300), Vec3(-1e300)};
    for (const Triangle& t : mesh)
        for (const Vec3& p : t) {
            box.low = glm::min(box.low, p);
            box.high = glm::max(box.high, p);
        }
    return box;
}

/// The body's turns about its axis for one of the drive, as the case file gives them. Where a coil turns clockwise
/// seen from its end, the angle of the drive counts backwards.
double turnsPerTurn(const Subject& s, const geometry::Turn& turn) {
    const bool backwards = s.c.world.coil && geometry::conveyingRate(*s.c.world.coil, 1) < 0;
    return backwards ? -turn.rate : turn.rate;
}

}  // namespace

Found bodySeam(const Subject& s) {
    const std::vector<RigidBody>& bodies = s.c.world.bodies;
    if (s.c.sharedPlaces.empty()) return {};
    std::vector<Triangle> all;
    for (const RigidBody& body : bodies) {
        const std::vector<Triangle> mesh = trianglesOf(body);
        all.insert(all.end(), mesh.begin(), mesh.end());
    }
    const Cells cells(all);
    const std::vector<Vec3>& powder = s.filled.particles.position;
    // The outer side of a vessel has seams that no powder meets. A place that a straight way leads to is met. A gap
    // less wide than the radius of the smallest sphere is no way: none fits through one twice as wide.
    const auto met = [&](const Vec3& place) {
        const std::size_t step = powder.size() / kMostWays + 1;
        for (std::size_t i = 0; i < powder.size(); i += step)
            if (cells.isOpen(place, powder[i], s.f.smallest / 2)) return true;
        return false;
    };
    const SharedPlace* worst = nullptr;  // the first area, or else the first seam
    for (const SharedPlace& place : s.c.sharedPlaces) {
        if (worst != nullptr && (worst->area || !place.area)) continue;
        if (met(place.centre)) worst = &place;
    }
    if (worst == nullptr) return {};
    const std::string first = bodies[worst->first].name;
    const bool wall = worst->second >= bodies.size();
    const std::string second = wall ? "" : bodies[worst->second].name;
    return Finding{keyOf(worst->first, "at"),
                   fmt::format("body \"{}\" and {} {}: a sphere at ({:.3g}, {:.3g}, {:.3g}) mm touches both in one "
                               "place and has two contacts there",
                               first, wall ? "a wall" : fmt::format("body \"{}\"", second),
                               worst->area ? "coincide" : "meet in a seam", mm(worst->centre.x), mm(worst->centre.y),
                               mm(worst->centre.z)),
                   wall ? "let it end before the wall, or pass through it"
                        : fmt::format("join the two in one mesh (vkdose export-body CASE {} {} --out both.stl), or "
                                      "move them apart",
                                      first, second)};
}

Found bodyBackwards(const Subject& s) {
    for (std::size_t b = 0; b < s.c.world.bodies.size(); ++b) {
        const RigidBody& body = s.c.world.bodies[b];
        const geometry::Turn* turn = drivenTurn(s, body);
        if (!s.c.canister || turn == nullptr || !alongCanister(*turn)) continue;
        const std::vector<Triangle> mesh = trianglesOf(body);
        const double turns = turnsPerTurn(s, *turn);
        const double advance = turns * turn->axis.z * advancePerTurn(mesh, turn->axis, turn->through);
        // Less than this is the rounding of a paddle's facets.
        if (!(advance < -0.02 * reachOf(mesh, turn->axis, turn->through).radius)) continue;
        return Finding{keyOf(b, "motion.turns_per_turn"),
                       fmt::format("body \"{}\" carries powder to the rear wall, away from the outlet, by {:.3g} mm a "
                                   "turn",
                                   body.name, -mm(advance)),
                       fmt::format("give {:.4g}, or the other hand", -turns)};
    }
    return {};
}

Found shortBody(const Subject& s) {
    if (!s.c.canister || s.c.world.coil) return {};
    double end = -1e300;
    std::size_t last = 0;
    for (std::size_t b = 0; b < s.c.world.bodies.size(); ++b) {
        const RigidBody& body = s.c.world.bodies[b];
        const geometry::Turn* turn = drivenTurn(s, body);
        if (turn == nullptr || !alongCanister(*turn)) continue;
        for (const Triangle& t : trianglesOf(body))
            for (const Vec3& p : t)
                if (p.z > end) {
                    end = p.z;
                    last = b;
                }
    }
    const double missing = s.c.canister->length - end;
    if (end < -1e299 || missing <= 1e-6) return {};
    return Finding{keyOf(last, "at"),
                   fmt::format("no body that the drive turns reaches the outlet; \"{}\" ends {:.3g} mm before the "
                               "front wall",
                               s.c.world.bodies[last].name, mm(missing)),
                   fmt::format("move it by {:.3g} mm along z, or give a longer one", mm(missing))};
}

Found mendedMesh(const Subject& s) {
    if (s.c.mendedMeshes.empty()) return {};
    const auto& [b, mended] = s.c.mendedMeshes.front();
    const std::size_t more = s.c.mendedMeshes.size() - 1;
    return Finding{
        keyOf(b, "mesh"),
        fmt::format("the mesh of body \"{}\" was mended: {}{}", s.c.world.bodies[b].name, mended,
                    more == 0 ? "" : fmt::format("; so were {} more of the case", more)),
        "spheres touch it as if it had been drawn so; look at these places, which are in the unit of the file"};
}

Found bodyOutOfScale(const Subject& s) {
    for (std::size_t b = 0; b < s.c.world.bodies.size(); ++b) {
        const RigidBody& body = s.c.world.bodies[b];
        if (body.shapes.size() != 1 ||
            !std::holds_alternative<std::shared_ptr<const geometry::MeshSurface>>(body.shapes.front()))
            continue;
        const auto [low, high] = extentOf(trianglesOf(body));
        const double size = std::max({high.x - low.x, high.y - low.y, high.z - low.z});
        const double device =
            s.c.canister
                ? std::max({s.c.canister->length, s.c.canister->width, s.c.canister->height})
                : glm::length(s.c.filling.list ? high - low : s.c.filling.region.high - s.c.filling.region.low);
        const bool tiny = size < 2 * s.f.mean;
        if (!tiny && !(size > 8 * device)) continue;
        return Finding{keyOf(b, "unit"),
                       fmt::format("the mesh of body \"{}\" is {:.3g} mm long, {}", body.name, mm(size),
                                   tiny ? fmt::format("less than a mean sphere of {:.3g} mm", mm(2 * s.f.mean))
                                        : fmt::format("{:.2g} times the device", size / device)),
                       "a mesh knows no unit; give the one that it was drawn in, as a rule \"mm\""};
    }
    return {};
}

namespace {

/// A place in m that was probably meant in mm: more than a metre, and many times the size of the device, from the
/// powder.
bool isFar(const Subject& s, const Vec3& low, const Vec3& high) {
    constexpr double kTimes = 20;
    Vec3 from(1e300), to(-1e300);
    const auto include = [&](const Vec3& p) {
        from = glm::min(from, p);
        to = glm::max(to, p);
    };
    for (const Vec3& p : s.filled.particles.position) include(p);
    if (s.c.canister) {
        include({-s.c.canister->width / 2, -s.c.canister->width / 2, 0});
        include({s.c.canister->width / 2, s.c.canister->height, s.c.canister->length});
    }
    const double away = glm::length(glm::max(glm::max(from - high, low - to), Vec3(0)));
    return away > 1 && away > kTimes * glm::length(to - from);
}

std::string inMillimetres(const Vec3& at) {
    return fmt::format("places are given in m; if those are mm, give [{:.4g}, {:.4g}, {:.4g}]", at.x / 1e3, at.y / 1e3,
                       at.z / 1e3);
}

/// A body that moves and is far from all powder, or about a place that is.
Found misplaced(const Subject& s, std::size_t b) {
    const RigidBody& body = s.c.world.bodies[b];
    if (std::holds_alternative<geometry::Rest>(body.course.motion)) return {};
    const auto [low, high] = extentOf(trianglesOf(body));
    const Vec3 at = body.course.start.origin;
    if (low.x <= high.x && isFar(s, low, high))
        return Finding{keyOf(b, "at"),
                       fmt::format("body \"{}\" stands at ({:.4g}, {:.4g}, {:.4g}) m, far from all powder", body.name,
                                   at.x, at.y, at.z),
                       inMillimetres(at)};
    const auto* turn = std::get_if<geometry::Turn>(&body.course.motion);
    const auto* swing = std::get_if<geometry::Swing>(&body.course.motion);
    if (turn == nullptr && swing == nullptr) return {};
    const Vec3 through = turn != nullptr ? turn->through : swing->through;
    const Vec3 axis = turn != nullptr ? turn->axis : swing->axis;
    // Of the axis the place nearest to the body counts.
    const Vec3 nearest = through + glm::dot(at - through, axis) * axis;
    if (!isFar(s, nearest, nearest)) return {};
    return Finding{
        keyOf(b, "motion.through"),
        fmt::format("body \"{}\" turns about an axis through ({:.4g}, {:.4g}, {:.4g}) m, far from all powder",
                    body.name, through.x, through.y, through.z),
        inMillimetres(through)};
}

}  // namespace

Found bodyOutside(const Subject& s) {
    const Box& room = s.c.world.domain;
    for (std::size_t b = 0; b < s.c.world.bodies.size(); ++b) {
        const RigidBody& body = s.c.world.bodies[b];
        if (Found found = misplaced(s, b)) return found;
        if (!std::holds_alternative<geometry::Rest>(body.course.motion)) continue;
        const std::vector<Triangle> mesh = trianglesOf(body);  // none of a shape without an end
        const auto [low, high] = extentOf(mesh);
        const bool apart = glm::any(glm::greaterThan(low, room.high)) || glm::any(glm::lessThan(high, room.low));
        if (mesh.empty() || !apart) continue;
        const Vec3 at = body.course.start.origin;
        const bool far = glm::length(at) > 1;
        return Finding{
            keyOf(b, "at"),
            fmt::format("no sphere can touch body \"{}\": it stands at ({:.4g}, {:.4g}, {:.4g}) m, outside of "
                        "the domain",
                        body.name, at.x, at.y, at.z),
            far ? inMillimetres(at) : "move the body, or widen [domain]"};
    }
    return {};
}

Found bodyPhases(const Subject& s) {
    const Schedule& plan = s.c.schedule;
    const bool doses = plan.rotateTime > 0;
    struct Part {
        double time;  ///< in all of settling or in one dose [s]
        const char* key;
    };
    const std::map<Phase, Part> parts{
        {Phase::Settle, {plan.settleTime, "settle.time_s"}},
        {Phase::Rotate, {plan.rotateTime, "dose.rotate_s"}},
        {Phase::Reverse, {doses && plan.reverseTurns > 0 ? plan.reverseTime() : 0, "dose.reverse_turns"}},
        {Phase::Rest, {doses ? plan.restTime : 0, "dose.rest_s"}}};
    for (std::size_t b = 0; b < s.c.world.bodies.size(); ++b) {
        const RigidBody& body = s.c.world.bodies[b];
        double time = 0;
        for (const Phase phase : body.phases) {
            const Part& part = parts.at(phase);
            if (part.time == 0)
                return Finding{keyOf(b, "motion.during"),
                               fmt::format("body \"{}\" is to move in the phase {}, of which the run has none",
                                           body.name, phaseName(phase)),
                               fmt::format("give {}, or leave that phase out", part.key)};
            if (phase != Phase::Settle) time += part.time;
        }
        if (!body.anew || body.phases.front() == Phase::Settle) continue;
        const double table = std::get<geometry::Table>(body.course.motion).rows.back().time;
        if (table <= time * (1 + 1e-9)) continue;
        return Finding{keyOf(b, "motion.anew"),
                       fmt::format("the table of body \"{}\" takes {:.4g} s, its phases in a dose {:.4g} s, so that it "
                                   "does not start anew in every dose",
                                   body.name, table, time),
                       fmt::format("give a table of at most {:.4g} s, or more phases", time)};
    }
    return {};
}

namespace {

/// Whether each end of a round wall is the rim of another round wall or disc of the body: together they are closed.
bool isClosedRound(const RigidBody& body, const geometry::Cone& wall) {
    const auto rims = [](const geometry::Cone& c) {
        return std::array{std::pair(c.base, c.baseRadius), std::pair(c.base + c.length * c.axis, c.endRadius)};
    };
    const auto has = [&](const geometry::Shape& shape, const Vec3& centre, double radius) {
        const auto* other = std::get_if<geometry::Cone>(&shape);
        if (other == nullptr || other == &wall) return false;
        const double same = 1e-9 * (radius + glm::length(centre));
        for (const auto& [at, r] : rims(*other))
            if (glm::length(at - centre) <= same && std::abs(r - radius) <= same) return true;
        return false;
    };
    for (const auto& [centre, radius] : rims(wall)) {
        if (radius == 0) continue;  // a tip, or the middle of a disc
        const auto meets = [&, c = centre, r = radius](const geometry::Shape& shape) { return has(shape, c, r); };
        if (std::none_of(body.shapes.begin(), body.shapes.end(), meets)) return false;
    }
    return true;
}

/// Whether all of the powder starts inside of a body that is closed: then it is a vessel, whose wall is thin.
bool holdsPowder(const Subject& s, const RigidBody& body) {
    const std::vector<Triangle> triangles = trianglesOf(body);
    const auto [low, high] = extentOf(triangles);
    const std::vector<Vec3>& powder = s.filled.particles.position;
    return std::all_of(powder.begin(), powder.end(), [&, lowest = low, highest = high](const Vec3& p) {
        return glm::all(glm::greaterThan(p, lowest)) && glm::all(glm::lessThan(p, highest));
    });
}

/// Whether one of the body's shapes is a surface without anything behind it: a mesh that is not closed, or the wall of
/// a round shape without ends.
bool isThin(const Subject& s, const RigidBody& body) {
    bool closed = false;
    for (const geometry::Shape& shape : body.shapes) {
        const auto* wall = std::get_if<geometry::Cone>(&shape);
        const auto* mesh = std::get_if<std::shared_ptr<const geometry::MeshSurface>>(&shape);
        if (wall == nullptr && mesh == nullptr) continue;
        if (wall != nullptr ? !isClosedRound(body, *wall) : !geometry::isClosed((*mesh)->mesh())) return true;
        closed = true;
    }
    return closed && holdsPowder(s, body);
}

/// An upper bound of the speed of the body's points, by its motion [m/s].
double largestSpeed(const Subject& s, const RigidBody& body) {
    const geometry::Motion& motion = body.course.motion;
    const auto* free = std::get_if<geometry::Free>(&motion);
    if (free != nullptr && free->rows.size() < 2) return glm::length(free->velocity);
    if (const geometry::Hinge* hinge = body.hinge()) return std::abs(hinge->rate) * hingeLever(body);
    const std::vector<Triangle> mesh = trianglesOf(body);
    // Of a body without an end, what is in the domain counts.
    const auto [low, high] = mesh.empty() ? s.c.world.domain : extentOf(mesh);
    const geometry::Course always{body.course.start, motion, {}};
    const auto* table = std::get_if<geometry::Table>(&motion);
    const auto timesOf = [](const auto& rows) { return std::pair(rows.front().time, rows.back().time); };
    const auto [from, to] = table != nullptr  ? timesOf(table->rows)
                            : free != nullptr ? timesOf(free->rows)
                                              : std::pair(0.0, 1.0);
    const double span = to - from;
    const double way = geometry::wayBound(always, always.start.toBody((low + high) / 2.0), glm::length(high - low) / 2,
                                          from, span);  // [m], of a body that the drive moves in so many rad
    const double thrown = free == nullptr ? 0 : glm::length(free->velocity);
    return thrown + way / span * (body.clock == Clock::Drive ? s.c.schedule.coilSpeed : 1);
}

}  // namespace

Found thinBody(const Subject& s) {
    if (s.c.world.maxOverlapRatio < 1) return {};
    const std::vector<RigidBody>& bodies = s.c.world.bodies;
    const auto thin =
        std::find_if(bodies.begin(), bodies.end(), [&](const RigidBody& body) { return isThin(s, body); });
    if (thin == bodies.end()) return {};
    return Finding{"contact.max_overlap_ratio",
                   fmt::format("the surfaces of body \"{}\" have no thickness: a sphere that is pressed in deeper than "
                               "its radius comes out on the other side, and the run goes on",
                               thin->name),
                   "give less than 1, as 0.95: such a sphere then ends the run"};
}

Found bodyTooFast(const Subject& s) {
    constexpr double kFarInAStep = 0.1;  // of the smallest radius
    for (std::size_t b = 0; b < s.c.world.bodies.size(); ++b) {
        const RigidBody& body = s.c.world.bodies[b];
        const double speed = largestSpeed(s, body), far = speed * s.c.world.timeStep / s.f.smallest;
        if (!(far > kFarInAStep) || misplaced(s, b)) continue;  // the place, which is told, makes the speed
        return Finding{keyOf(b, "motion.kind"),
                       fmt::format("body \"{}\" moves at up to {:.3g} m/s and goes {:.2g} radii of the smallest sphere "
                                   "in a time step: it enters spheres before they touch it, or passes them",
                                   body.name, speed, far),
                       fmt::format("stay below {:.3g} m/s, or give a shorter time.step_s", speed * kFarInAStep / far)};
    }
    return {};
}

Found sphereInBody(const Subject& s) {
    const Particles& p = s.filled.particles;
    for (std::size_t b = 0; b < s.c.world.bodies.size(); ++b) {
        const RigidBody& body = s.c.world.bodies[b];
        for (const geometry::Shape& shape : body.shapes) {
            const auto* mesh = std::get_if<std::shared_ptr<const geometry::MeshSurface>>(&shape);
            if (mesh == nullptr || !geometry::isClosed((*mesh)->mesh())) continue;
            const geometry::Inside inside((*mesh)->mesh());
            const geometry::Pose pose = body.pose(0, 0);
            std::size_t count = 0, first = 0;
            for (std::size_t i = 0; i < p.size(); ++i)
                if (inside(pose.toBody(p.position[i])) && count++ == 0) first = i;
            // A closed mesh with all of the powder inside is a vessel.
            if (count == 0 || count == p.size()) continue;
            return Finding{keyOf(b, "at"),
                           fmt::format("{} of {} spheres start inside of body \"{}\", the first at ({:.3g}, {:.3g}, "
                                       "{:.3g}) mm; its mesh is closed, so that they stay there",
                                       count, p.size(), body.name, mm(p.position[first].x), mm(p.position[first].y),
                                       mm(p.position[first].z)),
                           "move the body, or let the powder start beside it"};
        }
    }
    return {};
}

}  // namespace vkdose
