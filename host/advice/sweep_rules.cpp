// Warnings about bodies that move through other bodies, or through the walls of a canister.
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <tuple>

#include "host/advice/body_words.h"
#include "host/advice/cells.h"
#include "host/model/body_form.h"

namespace vkdose {
namespace {

using geometry::Pose;
using geometry::Triangle;

/// A way through a joint that is no deeper is the error of facets: `trianglesOf` leaves out 0.0021 of a radius, and the
/// radius is at most half of the length.
constexpr double kFacetError = 0.0015;
/// At most so many segments are tried for two bodies, in at least so many places of their motion.
constexpr double kMostTries = 1e7;
constexpr std::size_t kLeastPlaces = 36, kMostPlaces = 288;

bool rests(const RigidBody& body) {
    return std::holds_alternative<geometry::Rest>(body.course.motion);
}

/// When a case is at which place of its schedule, as planned: settling, then dose after dose.
class Plan {
  public:
    explicit Plan(const Subject& s) : plan_(s.c.schedule), end_(s.derived.steps * s.c.world.timeStep) {
        if (!(end_ > 0)) end_ = plan_.settleTime;
        const bool doses = plan_.rotateTime > 0;
        parts_ = {{Phase::Rotate, doses ? plan_.rotateTime : 0},
                  {Phase::Reverse, doses && plan_.reverseTurns > 0 ? plan_.reverseTime() : 0},
                  {Phase::Rest, doses ? plan_.restTime : 0}};
    }

    double end() const { return end_; }  ///< of the run [s]

    /// What a body's motion follows, at a time of the run: [s], or [rad] of the drive.
    double followed(const RigidBody& body, double time) const {
        if (body.clock == Clock::Time) return time;
        if (body.clock == Clock::Drive)
            return plan_.fastestSpeed() * (within(time, {Phase::Rotate}) - within(time, {Phase::Reverse}));
        return within(time, body.phases);
    }

  private:
    struct Part {
        Phase phase;
        double length;  ///< [s]
    };

    /// How long the run has been in these phases [s].
    double within(double time, const std::vector<Phase>& phases) const {
        const auto among = [&](Phase phase) { return std::find(phases.begin(), phases.end(), phase) != phases.end(); };
        double sum = among(Phase::Settle) ? std::min(time, plan_.settleTime) : 0, whole = 0, counted = 0;
        for (const Part& part : parts_) {
            whole += part.length;
            if (among(part.phase)) counted += part.length;
        }
        double left = std::max(time - plan_.settleTime, 0.0);
        if (!(whole > 0)) return sum;
        sum += std::floor(left / whole) * counted;
        left = std::fmod(left, whole);
        for (const Part& part : parts_) {
            if (among(part.phase)) sum += std::min(left, part.length);
            left = std::max(left - part.length, 0.0);
        }
        return sum;
    }

    const Schedule& plan_;
    double end_;
    std::vector<Part> parts_;
};

/// The way from a body's place at the start to that at `x` of what its motion follows.
Pose wayTo(const RigidBody& body, double x) {
    const Pose from = body.pose(0, 0), to = body.course.pose(x);
    const geometry::Rotation rotation = to.rotation * glm::conjugate(from.rotation);
    return {rotation, to.origin - rotation * from.origin};
}

/// Ways of a body all through its motion, whatever the schedule says of its end.
std::vector<Pose> waysOf(const RigidBody& body, const Plan& plan, std::size_t places) {
    const geometry::Motion& motion = body.course.motion;
    double from = 0, to = plan.followed(body, plan.end());
    if (!body.course.schedule.intervals.empty()) from = body.course.schedule.intervals.front().from;
    if (const auto* turns = std::get_if<geometry::Turn>(&motion)) {
        const double turn = 2 * kPi / std::max(std::abs(turns->rate), 1e-300);
        if (body.clock == Clock::Drive || from + turn < to) to = from + turn;
    } else if (const auto* table = std::get_if<geometry::Table>(&motion)) {
        to = from + table->rows.back().time;
    } else if (const auto* swing = std::get_if<geometry::Swing>(&motion)) {
        to = std::min(to, from + 1 / swing->frequency);
    } else if (const auto* shake = std::get_if<geometry::Shake>(&motion)) {
        to = std::min(to, from + 1 / shake->frequency);
    }
    std::vector<Pose> ways;
    for (std::size_t i = 0; i <= places; ++i)
        ways.push_back(wayTo(body, from + (to - from) * double(i) / double(places)));
    return ways;
}

/// Ways of a body at places all through a run, to be held against those of another body at the same times.
std::vector<Pose> waysInRun(const RigidBody& body, const Plan& plan, std::size_t places) {
    std::vector<Pose> ways;
    for (std::size_t i = 0; i <= places; ++i)
        ways.push_back(wayTo(body, plan.followed(body, plan.end() * double(i) / double(places))));
    return ways;
}

using Edge = std::array<Vec3, 2>;

/// The edges of triangles. That of two triangles counts once.
std::vector<Edge> edgesOf(const std::vector<Triangle>& mesh) {
    const auto before = [](const Vec3& a, const Vec3& b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); };
    std::vector<Edge> edges;
    for (const Triangle& t : mesh)
        for (std::size_t i = 0; i < 3; ++i) {
            const Vec3 &a = t[i], &b = t[(i + 1) % 3];
            edges.push_back(before(a, b) ? Edge{a, b} : Edge{b, a});
        }
    std::sort(edges.begin(), edges.end(),
              [&](const Edge& a, const Edge& b) { return before(a[0], b[0]) || (a[0] == b[0] && before(a[1], b[1])); });
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    return edges;
}

/// A body with its triangles at the start.
struct Form {
    std::vector<Triangle> mesh;
    std::vector<Edge> edges = edgesOf(mesh);
    Cells cells{mesh};
    double size() const {
        const Vec3 d = cells.high() - cells.low();
        return std::max({d.x, d.y, d.z});
    }
    explicit Form(const RigidBody& body) : mesh(trianglesOf(body)) {}
    Form(const Form& other, double factor) : mesh(other.sized(factor)) {}
    Form(const Form&) = delete;
    Form& operator=(const Form&) = delete;
    ~Form() = default;

    /// The triangles so many times as large, about the middle of the body.
    std::vector<Triangle> sized(double factor) const {
        const Vec3 middle = (cells.low() + cells.high()) / 2.0;
        std::vector<Triangle> all = mesh;
        for (Triangle& t : all)
            for (Vec3& p : t) p = middle + factor * (p - middle);
        return all;
    }
};

/// Whether an edge of `moved`, brought along `way`, passes `still`.
bool edgesPass(const Form& moved, const Pose& way, const Form& still, double least) {
    return std::any_of(moved.edges.begin(), moved.edges.end(), [&](const Edge& e) {
        return still.cells.passedBy(way.toWorld(e[0]), way.toWorld(e[1]), least);
    });
}

/// Whether two bodies pass one another where one has gone along ways of `first` and the other along those of `second`.
/// Two that move as one cannot.
bool meet(const Form& a, const std::vector<Pose>& first, const Form& b, const std::vector<Pose>& second) {
    const double size = std::max(a.size(), b.size());
    std::vector<Pose> ways;  // of the first, as the second sees it
    for (std::size_t i = 0; i < first.size(); ++i)
        ways.push_back({glm::conjugate(second[i].rotation) * first[i].rotation, second[i].toBody(first[i].origin)});
    const bool asOne = std::all_of(ways.begin(), ways.end(), [&](const Pose& w) {
        return glm::length(w.toWorld(a.cells.low()) - ways[0].toWorld(a.cells.low())) < 1e-6 * size &&
               glm::length(w.toWorld(a.cells.high()) - ways[0].toWorld(a.cells.high())) < 1e-6 * size;
    });
    if (asOne) return false;
    return std::any_of(ways.begin(), ways.end(), [&](const Pose& way) {
        const geometry::Rotation back = glm::conjugate(way.rotation);
        return edgesPass(a, way, b, kFacetError * size) ||
               edgesPass(b, Pose{back, -(back * way.origin)}, a, kFacetError * size);
    });
}

std::size_t placesFor(const Form& a, const Form& b) {
    const auto tries = double(a.edges.size() + b.edges.size());
    return std::clamp(std::size_t(kMostTries / std::max(tries, 1.0)), kLeastPlaces, kMostPlaces);
}

/// A body that moves otherwise than about the canister's axis: a place of it that is before a wall and then behind it.
Found sweptWall(const Subject& s) {
    const Plan plan(s);
    for (std::size_t b = 0; b < s.c.world.bodies.size(); ++b) {
        const RigidBody& body = s.c.world.bodies[b];
        const geometry::Turn* turn = drivenTurn(s, body);
        if (rests(body) || (turn != nullptr && alongCanister(*turn))) continue;
        const std::vector<Pose> ways = waysOf(body, plan, kLeastPlaces);
        const double least = 1e-3 * s.c.canister->width;
        double deepest = 0;
        for (const Triangle& t : trianglesOf(body))
            for (const Vec3& p : t) {
                double low = 0, high = 0;
                for (const Pose& way : ways) {
                    const double behind = behindWall(*s.c.canister, way.toWorld(p));
                    low = std::min(low, behind);  // NaN changes nothing
                    high = std::max(high, behind);
                }
                if (low < -least) deepest = std::max(deepest, high);
            }
        if (deepest > least)
            return Finding{
                keyOf(b, "motion"),
                fmt::format("body \"{}\" moves through the wall of the canister, by {:.3g} mm", body.name, mm(deepest)),
                "give a smaller body or motion, or the place that it should have"};
    }
    return {};
}

}  // namespace

Found bodiesCross(const Subject& s) {
    const std::vector<RigidBody> bodies = allBodies(s.c.world);
    if (std::all_of(bodies.begin(), bodies.end(), rests)) return {};
    const Plan plan(s);
    std::vector<std::unique_ptr<Form>> forms;
    for (const RigidBody& body : bodies) forms.push_back(std::make_unique<Form>(body));
    const auto moves = [&](std::size_t b) {
        return !rests(bodies[b]) && (bodies[b].clock != Clock::Drive || drivenTurn(s, bodies[b]) != nullptr);
    };
    for (std::size_t a = 0; a < bodies.size(); ++a) {
        for (std::size_t b = 0; moves(a) && b < bodies.size(); ++b) {
            const bool still = rests(bodies[b]);
            if (b == a || (!still && b < a) || forms[a]->mesh.empty() || forms[b]->mesh.empty()) continue;
            const std::size_t places = placesFor(*forms[a], *forms[b]);
            const std::vector<Pose> first =
                still ? waysOf(bodies[a], plan, places) : waysInRun(bodies[a], plan, places);
            const std::vector<Pose> second =
                still ? std::vector<Pose>(first.size()) : waysInRun(bodies[b], plan, places);
            if (!meet(*forms[a], first, *forms[b], second)) continue;
            // A lid that fits its cell, and is lowered in it, only touches: a little smaller or larger it would not.
            const auto meetsAs = [&](double factor) { return meet(Form(*forms[a], factor), first, *forms[b], second); };
            if (!meetsAs(1 - 2 * kFacetError) || !meetsAs(1 + 2 * kFacetError)) continue;
            const bool turns = std::holds_alternative<geometry::Turn>(bodies[a].course.motion);
            // The coil is the last, and has no such key.
            return Finding{keyOf(a < s.c.world.bodies.size() ? a : b, "at"),
                           fmt::format("body \"{}\" {} through body \"{}\"; powder between them would be crushed",
                                       bodies[a].name, turns ? "turns" : "moves", bodies[b].name),
                           "move one of them, or make one smaller"};
        }
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
    return sweptWall(s);
}

}  // namespace vkdose
