// Warnings about bodies: which way they convey, what they turn through, what lies inside of them.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "geometry/inside.h"
#include "host/advice/rules.h"
#include "host/model/body_form.h"

namespace vkdose {
namespace {

using geometry::Triangle;

/// From so many particles is looked whether a place can be met.
constexpr std::size_t kMostWays = 60;

double mm(double metres) {
    return metres * 1e3;
}

std::string keyOf(std::size_t body, const char* key) {
    return fmt::format("body[{}].{}", body, key);
}

/// The turn of a body that the drive turns while powder is dosed; null for every other.
const geometry::Turn* drivenTurn(const Subject& s, const RigidBody& body) {
    if (s.c.schedule.rotateTime == 0 || body.clock != Clock::Drive) return nullptr;
    return std::get_if<geometry::Turn>(&body.course.motion);
}

/// Whether it turns about an axis along that of the canister.
bool alongCanister(const geometry::Turn& turn) {
    return std::abs(turn.axis.z) > 0.999;
}

/// The body's turns about its axis for one of the drive, as the case file gives them. Where a coil turns clockwise
/// seen from its end, the angle of the drive counts backwards.
double turnsPerTurn(const Subject& s, const geometry::Turn& turn) {
    const bool backwards = s.c.world.coil && geometry::conveyingRate(*s.c.world.coil, 1) < 0;
    return backwards ? -turn.rate : turn.rate;
}

/// Triangles in the cells of a box, to find those near a segment.
class Cells {
  public:
    explicit Cells(const std::vector<Triangle>& mesh) : mesh_(mesh), low_(1e300), high_(-1e300) {
        for (const Triangle& t : mesh)
            for (const Vec3& p : t) {
                low_ = glm::min(low_, p);
                high_ = glm::max(high_, p);
            }
        for (std::size_t i = 0; i < mesh.size(); ++i)
            forEachCell(glm::min(mesh[i][0], glm::min(mesh[i][1], mesh[i][2])),
                        glm::max(mesh[i][0], glm::max(mesh[i][1], mesh[i][2])),
                        [&](int cell) { cells_[cell].push_back(i); });
    }

    /// Whether the segment passes a triangle.
    bool passedBy(const Vec3& a, const Vec3& b) const {
        const Vec3 low = glm::min(a, b), high = glm::max(a, b);
        if (glm::any(glm::lessThan(high, low_)) || glm::any(glm::greaterThan(low, high_))) return false;
        bool passed = false;
        forEachCell(low, high, [&](int cell) {
            const auto found = cells_.find(cell);
            if (passed || found == cells_.end()) return;
            passed = std::any_of(found->second.begin(), found->second.end(),
                                 [&](std::size_t i) { return passes(a, b, mesh_[i]); });
        });
        return passed;
    }

  private:
    static constexpr int kSide = 24;

    int cell(double x, int axis) const {
        const double share = (x - low_[axis]) / std::max(high_[axis] - low_[axis], 1e-300);
        return int(std::clamp(share * kSide, 0.0, kSide - 1.0));
    }
    template <class Visit>
    void forEachCell(const Vec3& low, const Vec3& high, const Visit& visit) const {
        for (int x = cell(low.x, 0); x <= cell(high.x, 0); ++x)
            for (int y = cell(low.y, 1); y <= cell(high.y, 1); ++y)
                for (int z = cell(low.z, 2); z <= cell(high.z, 2); ++z) visit((x * kSide + y) * kSide + z);
    }
    /// By the signs of the volumes that segment and edges span.
    static bool passes(const Vec3& a, const Vec3& b, const Triangle& t) {
        const Vec3 n = glm::cross(t[1] - t[0], t[2] - t[0]);
        if (!(glm::dot(a - t[0], n) * glm::dot(b - t[0], n) < 0)) return false;
        const auto side = [&](int i, int j) {
            return glm::dot(b - a, glm::cross(t[std::size_t(i)] - a, t[std::size_t(j)] - a));
        };
        const double u = side(0, 1), v = side(1, 2), w = side(2, 0);
        return (u > 0 && v > 0 && w > 0) || (u < 0 && v < 0 && w < 0);
    }

    const std::vector<Triangle>& mesh_;
    Vec3 low_, high_;
    std::map<int, std::vector<std::size_t>> cells_;
};

/// Whether an edge of `moved`, turned by `angle`, passes `cells`.
bool edgesPass(const std::vector<Triangle>& moved, const geometry::Turn& turn, double angle, const Cells& cells) {
    const geometry::Rotation rotation = glm::angleAxis(angle, turn.axis);
    const auto at = [&](const Vec3& p) { return turn.through + rotation * (p - turn.through); };
    return std::any_of(moved.begin(), moved.end(), [&](const Triangle& t) {
        const Vec3 a = at(t[0]), b = at(t[1]), c = at(t[2]);
        return cells.passedBy(a, b) || cells.passedBy(b, c) || cells.passedBy(c, a);
    });
}

/// Whether the body `moving` passes the resting body `still` somewhere in its turn.
bool cross(const std::vector<Triangle>& moving, const geometry::Turn& turn, const std::vector<Triangle>& still) {
    constexpr int kPlaces = 36;
    const Cells ofStill(still), ofMoving(moving);
    for (int i = 0; i < kPlaces; ++i) {
        const double angle = 2 * kPi * i / kPlaces;
        if (edgesPass(moving, turn, angle, ofStill) || edgesPass(still, turn, -angle, ofMoving)) return true;
    }
    return false;
}

}  // namespace

Found bodiesCross(const Subject& s) {
    const std::vector<RigidBody>& bodies = s.c.world.bodies;
    for (std::size_t a = 0; a < bodies.size(); ++a) {
        const geometry::Turn* turn = drivenTurn(s, bodies[a]);
        if (turn == nullptr) continue;
        for (const RigidBody& still : bodies) {
            if (!std::holds_alternative<geometry::Rest>(still.course.motion)) continue;
            if (!cross(trianglesOf(bodies[a]), *turn, trianglesOf(still))) continue;
            return Finding{keyOf(a, "at"),
                           fmt::format("body \"{}\" turns through body \"{}\"; powder between them would be crushed",
                                       bodies[a].name, still.name),
                           "move one of them, or make one smaller"};
        }
    }
    return {};
}

Found bodySeam(const Subject& s) {
    const std::vector<RigidBody>& bodies = s.c.world.bodies;
    if (s.c.sharedPlaces.empty()) return {};
    std::vector<Triangle> still;
    for (const RigidBody& body : bodies) {
        const bool rests = std::holds_alternative<geometry::Rest>(body.course.motion);
        const std::vector<Triangle> mesh = rests ? trianglesOf(body) : std::vector<Triangle>();
        still.insert(still.end(), mesh.begin(), mesh.end());
    }
    const Cells cells(still);
    const std::vector<Vec3>& powder = s.filled.particles.position;
    // The outer side of a vessel has seams that no powder meets. A place that a straight way leads to is met.
    const auto met = [&](const Vec3& place) {
        const std::size_t step = powder.size() / kMostWays + 1;
        for (std::size_t i = 0; i < powder.size(); i += step)
            if (!cells.passedBy(place, powder[i])) return true;
        return false;
    };
    for (const SharedPlace& place : s.c.sharedPlaces) {
        if (!met(place.centre)) continue;
        const std::string first = bodies[place.first].name;
        const bool wall = place.second >= bodies.size();
        const std::string second = wall ? "" : bodies[place.second].name;
        return Finding{keyOf(place.first, "at"),
                       fmt::format("body \"{}\" and {} meet in a seam: a sphere at ({:.3g}, {:.3g}, {:.3g}) mm touches "
                                   "both in one place and has two contacts there",
                                   first, wall ? "a wall" : fmt::format("body \"{}\"", second), mm(place.centre.x),
                                   mm(place.centre.y), mm(place.centre.z)),
                       wall ? "let it end before the wall, or pass through it"
                            : fmt::format("join the two in one mesh (vkdose export-body CASE {} {} --out both.stl), or "
                                          "move them apart",
                                          first, second)};
    }
    return {};
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

Found bodyInWall(const Subject& s) {
    if (!s.c.canister) return {};
    const Canister& can = *s.c.canister;
    for (std::size_t b = 0; b < s.c.world.bodies.size(); ++b) {
        const RigidBody& body = s.c.world.bodies[b];
        const geometry::Turn* turn = drivenTurn(s, body);
        if (turn == nullptr || !alongCanister(*turn)) continue;
        const double aside = std::hypot(turn->through.x, turn->through.y);
        double excess = 0;
        bool inHole = false;
        for (const Triangle& t : trianglesOf(body))
            for (const Vec3& p : t) {
                const Vec3 arm = p - turn->through;
                const double reach = aside + std::hypot(arm.x, arm.y);
                const bool beyond = p.z > can.length;
                const double room = (beyond ? can.outletDiameter : can.width) / 2;
                if (p.z < 0 || reach - room <= excess) continue;
                excess = reach - room;
                inHole = beyond;
            }
        // A touch is none; a mesh of facets has that much error.
        if (!(excess > 1e-3 * can.width)) continue;
        return Finding{keyOf(b, "at"),
                       fmt::format("body \"{}\" turns through the {}, by {:.3g} mm", body.name,
                                   inHole ? "rim of the outlet or the throat" : "wall of the canister", mm(excess)),
                       inHole ? "give a wider outlet, a smaller body, or the place and axis that it should have"
                              : "give a wider canister, a smaller body, or the place and axis that it should have"};
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

Found bodyOutOfScale(const Subject& s) {
    for (std::size_t b = 0; b < s.c.world.bodies.size(); ++b) {
        const RigidBody& body = s.c.world.bodies[b];
        if (body.shapes.size() != 1 ||
            !std::holds_alternative<std::shared_ptr<const geometry::MeshSurface>>(body.shapes.front()))
            continue;
        Vec3 low(1e300), high(-1e300);
        for (const Triangle& t : trianglesOf(body))
            for (const Vec3& p : t) {
                low = glm::min(low, p);
                high = glm::max(high, p);
            }
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
