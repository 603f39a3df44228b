// The distance from q to the blade is the least of the distances to its sections. In cylindrical coordinates of q,
// (rho, phi, z), and with u = azimuth - phi, the section at theta lies, seen from q, at the radius rho cos u of its own
// half plane and rho |sin u| beside it. Its nearest point has the radius r and the height h + s, which are rho cos u
// and z clamped to the rectangle. The squared distance is
//   D(theta) = (rho cos u - r)^2 + (rho sin u)^2 + (z - h - s)^2,
//   dD/dtheta / 2 = hand r rho sin u - (z - h - s) h'    (r and s count as fixed, by the envelope theorem).
// Its zeros have no closed form. The derivative is followed in small steps, and halved down where it turns from
// falling to rising.

#include "geometry/flight.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "geometry/tessellator.h"

namespace vkdose::geometry {

namespace {

constexpr double kStep = kPi / 360;  // [rad]

class View {
  public:
    View(const Flight& flight, const Vec3& q)
        : f_(flight), q_(q), rho_(std::hypot(q.x, q.y)), phi_(std::atan2(q.y, q.x)) {}

    double rho() const { return rho_; }

    /// Half the derivative of the squared distance [m2].
    double rise(double theta) const {
        const double u = f_.startAngle + f_.hand * theta - phi_;
        const double across = glm::clamp(rho_ * std::cos(u), f_.innerRadius, f_.outerRadius);
        const double above = q_.z - f_.height(theta);
        const double beyond = above - glm::clamp(above, -f_.thickness / 2, f_.thickness / 2);
        return f_.hand * across * rho_ * std::sin(u) - beyond * f_.slope(theta);
    }

    FlightTouch at(double theta) const {
        const double azimuth = f_.startAngle + f_.hand * theta;
        const Vec3 outward(std::cos(azimuth), std::sin(azimuth), 0);
        const double across = glm::clamp(glm::dot(outward, q_), f_.innerRadius, f_.outerRadius);
        const double height = f_.height(theta);
        const double above = glm::clamp(q_.z - height, -f_.thickness / 2, f_.thickness / 2);
        FlightTouch touch{};
        touch.theta = theta;
        touch.point = across * outward + Vec3(0, 0, height + above);
        const Vec3 away = q_ - touch.point;
        touch.distance = glm::length(away);
        if (touch.distance == 0) return wayOut(theta);
        touch.normal = away / touch.distance;
        return touch;
    }

    /// For a centre on the blade or inside it: out of the nearer face, along its normal.
    FlightTouch wayOut(double theta) const {
        const double azimuth = f_.startAngle + f_.hand * theta, above = q_.z - f_.height(theta);
        const Vec3 outward(std::cos(azimuth), std::sin(azimuth), 0);
        const Vec3 along = rho_ * f_.hand * Vec3(-outward.y, outward.x, 0) + Vec3(0, 0, f_.slope(theta));
        const Vec3 up = glm::normalize(double(f_.hand) * glm::cross(outward, along));
        const Vec3 normal = above < 0 ? -up : up;
        const double depth = (f_.thickness / 2 - std::abs(above)) * up.z;
        FlightTouch touch{};
        touch.theta = theta;
        touch.normal = normal;
        touch.point = q_ + depth * normal;
        touch.distance = -depth;
        return touch;
    }

    /// Whether the point lies in the blade: the section in its own half plane tells. Gives that section's angle.
    std::optional<double> inside() const {
        if (rho_ <= f_.innerRadius || rho_ >= f_.outerRadius) return std::nullopt;
        const double first = std::fmod(f_.hand * (phi_ - f_.startAngle), 2 * kPi);
        for (int turn = first < 0 ? 1 : 0;; ++turn) {
            const double theta = first + 2 * kPi * turn;
            if (theta > f_.angle) return std::nullopt;
            if (std::abs(q_.z - f_.height(theta)) < f_.thickness / 2) return theta;
        }
    }

    /// The blade angle at which the blade's middle has the height z, clamped to the blade.
    double thetaAt(double z) const {
        double low = 0, high = f_.angle;
        if (z <= f_.height(low)) return low;
        if (z >= f_.height(high)) return high;
        return halved(low, high, [&](double theta) { return f_.height(theta) - z; });
    }

    /// Where `f` turns from negative to positive.
    template <class Function>
    static double halved(double low, double high, const Function& f) {
        for (int n = 0; n < 100; ++n) {
            const double middle = low + (high - low) / 2;
            if (middle <= low || middle >= high) break;
            (f(middle) < 0 ? low : high) = middle;
        }
        return low + (high - low) / 2;
    }

  private:
    const Flight& f_;
    Vec3 q_;
    double rho_, phi_;
};

}  // namespace

double Flight::height(double theta) const {
    return zStart + (pitchStart * theta + (pitchEnd - pitchStart) * theta * theta / (2 * angle)) / (2 * kPi);
}

double Flight::slope(double theta) const {
    return (pitchStart + (pitchEnd - pitchStart) * theta / angle) / (2 * kPi);
}

std::vector<FlightTouch> touches(const Flight& flight, const Vec3& q, double reach) {
    const View view(flight, q);
    std::vector<FlightTouch> found;
    if (view.rho() >= flight.outerRadius + reach || view.rho() <= flight.innerRadius - reach) return found;
    const double span = reach + flight.thickness / 2;
    if (q.z <= flight.zStart - span || q.z >= flight.height(flight.angle) + span) return found;
    if (const auto theta = view.inside()) return {view.wayOut(*theta)};
    const double from = view.thetaAt(q.z - span), to = view.thetaAt(q.z + span);

    const auto keep = [&](double theta) {
        const FlightTouch touch = view.at(theta);
        if (touch.distance < reach) found.push_back(touch);
    };
    const int steps = 1 + int((to - from) / kStep);
    double last = from, before = view.rise(from);
    // Only the ends of the blade itself are minima. Where the search ends on the blade, it is out of reach.
    if (before >= 0 && from == 0) keep(0);
    for (int n = 1; n <= steps; ++n) {
        const double theta = from + (to - from) * n / steps, rise = view.rise(theta);
        if (before < 0 && rise >= 0) keep(View::halved(last, theta, [&](double t) { return view.rise(t); }));
        last = theta;
        before = rise;
    }
    if (before < 0 && to == flight.angle) keep(to);
    return found;
}

std::vector<Feature> Flight::places(const Vec3& centre, double radius) const {
    std::vector<Feature> found;
    for (const FlightTouch& touch : touches(*this, centre, radius)) {
        const Closest& closest = touch;
        found.push_back({closest, std::uint32_t(std::lround(touch.theta / (2 * kPi))), 0});
    }
    return found;
}

ShapeForm Flight::form() const {
    ShapeForm form{.solid = true, .curve = outerRadius};
    if (angle < 2 * kPi * kMostSlender)
        form.facet = 2 * kPi * std::max({outerRadius, pitchStart, pitchEnd}) / kPiecesAround;
    return form;
}

namespace {

/// A section of the blade: along the lower face outwards, along the upper one back.
Tessellator::Corners sectionOf(const Flight& f, double theta, int across) {
    const double azimuth = f.startAngle + f.hand * theta;
    const Vec3 outward(std::cos(azimuth), std::sin(azimuth), 0);
    Tessellator::Corners corners;
    for (const int face : {-1, 1})
        for (int i = 0; i <= across; ++i) {
            const double share = double(face < 0 ? i : across - i) / across;
            const double radius = f.innerRadius + share * (f.outerRadius - f.innerRadius);
            corners.push_back(radius * outward + Vec3(0, 0, f.height(theta) + face * f.thickness / 2));
        }
    return corners;
}

/// Closes the blade at a section.
void putEnd(Tessellator& into, const Tessellator::Corners& corners, int across, bool turned) {
    const int last = 2 * across + 1;
    for (int i = 0; i < across; ++i) {
        const Vec3 &a = corners[i], &b = corners[i + 1], &c = corners[last - i - 1], &d = corners[last - i];
        if (turned) {
            into.put(a, c, b);
            into.put(a, d, c);
        } else {
            into.put(a, b, c);
            into.put(a, c, d);
        }
    }
}

}  // namespace

/// Sections of the blade, each a rectangle whose sides are cut along the radius, joined to a tube with two ends.
void Flight::cut(Tessellator& into) const {
    const double outermost = std::hypot(2 * kPi * outerRadius, std::max(pitchStart, pitchEnd));
    const int along = into.pieces(outermost * angle / (2 * kPi), 1);
    const int across = into.straightPieces(outerRadius - innerRadius);
    std::vector<Tessellator::Corners> sections;
    for (int k = 0; k <= along; ++k) sections.push_back(sectionOf(*this, angle * k / along, across));
    into.strips(sections, hand < 0);
    putEnd(into, sections.front(), across, hand < 0);
    putEnd(into, sections.back(), across, hand > 0);
}

}  // namespace vkdose::geometry
