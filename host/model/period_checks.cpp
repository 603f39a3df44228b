// Checks a domain that repeats: that it is long enough, and that walls, coil and bodies repeat with it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <variant>

#include "host/core/millimetres.h"
#include "host/model/checks.h"
#include "host/model/clearance.h"

namespace vkdose {
namespace {

const char* const kKey = "domain.periodic";

/// Whether a motion leaves a body the same from one period to the next along axis `d`, if it is so at the start: it
/// goes across that axis and turns about it alone.
struct KeepsPeriod {
    int d;
    static constexpr double kSame = 1e-9;
    bool across(const Vec3& way) const { return std::abs(way[d]) <= kSame * glm::length(way); }
    bool along(const Vec3& axis) const { return std::abs(std::abs(axis[d]) - 1) <= kSame; }

    bool operator()(const geometry::Rest&) const { return true; }
    bool operator()(const geometry::Turn& m) const { return along(m.axis); }
    bool operator()(const geometry::Swing& m) const { return along(m.axis); }
    bool operator()(const geometry::Shake& m) const { return across(m.direction); }
    bool operator()(const geometry::Slide& m) const { return across(m.velocity); }
    bool operator()(const geometry::Table& m) const {
        return std::all_of(m.rows.begin(), m.rows.end(), [&](const geometry::Table::Row& row) {
            return across(row.shift) && (row.angle == 0 || along(m.axis));
        });
    }
    bool operator()(const geometry::Free& m) const {
        const bool turns = std::any_of(m.rows.begin(), m.rows.end(), [](const auto& row) { return row.angle != 0; });
        return m.line && across(*m.line) && !turns;
    }
    bool operator()(const geometry::Hinge& m) const { return along(m.axis); }
};

/// Whether a body of planes moves within them, as a belt does, so that it is always where it was.
bool movesWithinItself(const RigidBody& body) {
    Vec3 way(0);
    if (const auto* slide = std::get_if<geometry::Slide>(&body.course.motion)) way = slide->velocity;
    if (const auto* shake = std::get_if<geometry::Shake>(&body.course.motion)) way = shake->direction;
    return way != Vec3(0) && std::all_of(body.shapes.begin(), body.shapes.end(), [&](const geometry::Shape& shape) {
               const auto* plane = std::get_if<geometry::Plane>(&shape);
               if (plane == nullptr || plane->end < geometry::kEndless) return false;
               const Vec3 normal = body.course.start.directionToWorld(plane->normal);
               return std::abs(glm::dot(normal, way)) <= KeepsPeriod::kSame * glm::length(way);
           });
}

/// The time, or the angle of the drive, that a motion takes to show all its places; 0: it never does.
double spanOf(const geometry::Motion& motion) {
    if (const auto* table = std::get_if<geometry::Table>(&motion)) return table->rows.back().time;
    return geometry::periodOf(motion).value_or(0);
}

class Ends {
  public:
    /// `reach` [m]: from a centre to all that a sphere may touch.
    Ends(CaseReader& reader, const Case& c, double smallestRadius, double reach)
        : reader_(reader), c_(c), smallest_(smallestRadius), reach_(reach) {}

    /// Whether all that powder touches is the same at both ends along axis `d`, whenever it is looked at.
    void check(int d) {
        if (differs(d, 0)) return;
        constexpr int kInstants = 16;
        for (const double span : spansToLookAt(d))
            for (int k = 1; k <= kInstants; ++k)
                if (differs(d, span * k / kInstants)) return;
    }

  private:
    /// Of the motions by which a body may come to differ. Reports those that cannot keep the period.
    std::vector<double> spansToLookAt(int d) {
        std::vector<double> spans;
        const World& world = c_.world;
        if (world.coil && d != 2) spans.push_back(2 * kPi);
        for (std::size_t b = 0; b < world.bodies.size(); ++b) {
            const geometry::Motion& motion = world.bodies[b].course.motion;
            if (std::visit(KeepsPeriod{d}, motion) || movesWithinItself(world.bodies[b])) continue;
            const double span = world.bodies[b].movesFreely() ? 0 : spanOf(motion);
            if (span > 0)
                spans.push_back(span);
            else
                reader_.fault(
                    fmt::format("body[{}]", b),
                    fmt::format("moves along {}, in which the domain repeats, and would leave its place there "
                                "for good",
                                kAxis[d]),
                    "let it move across that direction, or leave the direction out of domain.periodic");
        }
        return spans;
    }

    /// Reports the first place where the two ends differ at the instant `t` of all clocks.
    bool differs(int d, double t) {
        const World& world = c_.world;
        BodyClock clock;
        clock.steps = std::uint64_t(std::llround(t / world.timeStep));
        const std::vector<BodyClock> clocks(world.bodies.size(), clock);
        const Clearance around(world, t, t, clocks);
        const int e = (d + 1) % 3, f = (d + 2) % 3;
        const Vec3 size = world.domain.high - world.domain.low;
        constexpr double kMostPoints = 4000;
        const double step = std::max(reach_, std::sqrt(size[e] * size[f] / kMostPoints));
        Vec3 x = world.domain.low;
        for (x[e] = world.domain.low[e]; x[e] <= world.domain.high[e]; x[e] += step)
            for (x[f] = world.domain.low[f]; x[f] <= world.domain.high[f]; x[f] += step)
                for (const double off : {-1.0, -0.5, 0.0, 0.5, 1.0}) {
                    x[d] = world.domain.low[d] + off * reach_;
                    if (differsAt(around, d, x)) return true;
                }
        return false;
    }

    bool differsAt(const Clearance& around, int d, const Vec3& x) {
        constexpr double kSame = 1e-3;  // of the smallest radius
        Vec3 there = x;
        there[d] += c_.world.period[d];
        const Obstacle low = around.nearest(x, reach_), high = around.nearest(there, reach_);
        if (std::abs(low.distance - high.distance) <= kSame * smallest_) return false;
        const bool atLow = low.distance < high.distance;
        const Obstacle &near = atLow ? low : high, &far = atLow ? high : low;
        const Vec3 at = atLow ? x : there;
        reader_.fault(
            kKey,
            fmt::format("repeats along {}, but {} does not: it is {:.4g} mm from ({:.4g}, {:.4g}, {:.4g}) mm, and what "
                        "is nearest to the place one period away is {}{:.4g} mm from that",
                        kAxis[d], near.what, mm(near.distance), mm(at.x), mm(at.y), mm(at.z),
                        far.what.empty() ? "more than " : "", mm(far.distance)),
            fmt::format("let it go beyond both ends by {:.4g} mm or more and be the same there, or keep it so far from "
                        "both; the period is {:.6g} mm",
                        mm(reach_), mm(c_.world.period[d])));
        return true;
    }

    static constexpr char kAxis[] = "xyz";
    CaseReader& reader_;
    const Case& c_;
    double smallest_;  ///< radius [m]
    double reach_;     ///< [m]
};

}  // namespace

void checkPeriod(CaseReader& reader, const Case& c, const SizeRange& radii) {
    if (!c.world.repeats()) return;
    if (c.canister) {
        reader.fault(kKey, "has no use with a canister, which ends at its walls",
                     "write boundaries = \"list\" or \"none\" and give the walls as bodies");
        return;
    }
    const double contact = std::max(longestReach(c.world, c.settlingLaw, radii.largest),
                                    longestReach(c.world, c.dosingLaw, radii.largest));
    const double shortest = 2 * (2 * radii.largest + contact + c.world.skin);
    for (int d = 0; d < 3; ++d) {
        if (c.world.period[d] == 0) continue;
        if (c.world.period[d] >= shortest)
            Ends(reader, c, radii.smallest, radii.largest + contact).check(d);
        else
            reader.fault(kKey,
                         fmt::format("repeats every {:.4g} mm along {}: a sphere would meet another one and its image",
                                     mm(c.world.period[d]), "xyz"[d]),
                         fmt::format("let the domain be {:.4g} mm long there or more, which is twice the largest "
                                     "diameter and twice time.skin_mm",
                                     mm(shortest)));
    }
}

}  // namespace vkdose
