// Closest points on the wire's centre line.
//
// Write the query point in cylindrical coordinates (rho, theta, z) and let u = psi(s) - theta be the wire's phase as
// seen from it. Half the squared distance to the centre line is, up to a constant,
//   D(s) = -rho radius cos u + (s - h)^2 / 2,  h = z - zStart,  u = u0 + kappa s,  kappa = hand 2 pi / pitch,
// and its derivative times kappa is
//   f(u) = u + eps sin u - M,  eps = rho radius kappa^2,  M = u0 + kappa h (the phase at the point's own height).
// A minimum needs f = 0 with f' = 1 + eps cos u > 0: at most one in every window |u - 2 pi k| < w, where
// w = acos(-1/eps), or pi if eps <= 1 (then f grows everywhere and there is one minimum altogether).
// In a window, with v = u - 2 pi k and m = M - 2 pi k, f is odd in (v, m) and concave for v > 0, so Newton started at
// v = m / (1 + eps) <= root climbs to the root without passing it.

#include "geometry/coil.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>

namespace vkdose::geometry {

namespace {

/// Minima of different turns are always further apart in phase than this. Two results closer than this are the same
/// minimum [rad].
constexpr double kSameMinimum = 1e-8;

/// A query point in the wire's frame.
struct View {
    double rho;
    double height;  ///< h, the point's own wire coordinate [m]
    double kappa;   ///< [rad/m]
    double eps;
    double u0;     ///< phase of the wire's start, seen from the point [rad]
    double phase;  ///< M [rad]
};

View viewFrom(const Coil& coil, double angle, const Vec3& q) {
    View view{};
    view.rho = std::hypot(q.x, q.y);
    view.height = q.z - coil.zStart;
    view.kappa = coil.hand * 2 * kPi / coil.pitch;
    view.eps = view.rho * coil.radius * view.kappa * view.kappa;
    view.u0 = std::remainder(angle + coil.startAngle - std::atan2(q.y, q.x), 2 * kPi);
    view.phase = view.u0 + view.kappa * view.height;
    return view;
}

/// Root v of v + eps sin v = m inside the window; the caller has made sure there is one.
double rootInWindow(double eps, double m) {
    // Newton converges quadratically as a rule. Towards the window's edge, where f' vanishes, a step only halves the
    // error, so many steps are allowed.
    constexpr int kMaxSteps = 200;
    const double target = std::abs(m);
    double v = target / (1 + eps);
    for (int step = 0; step < kMaxSteps; ++step) {
        const double shortfall = target - (v + eps * std::sin(v));
        const double slope = 1 + eps * std::cos(v);
        // In exact arithmetic the climb goes on. Only rounding can stop it, take it past the root or make the slope
        // zero.
        if (shortfall <= 0 || slope <= 0 || v + shortfall / slope <= v) return std::copysign(v, m);
        v += shortfall / slope;
    }
    throw std::logic_error("closest point on the coil: Newton did not converge");
}

CoilTouch touchAt(const Coil& coil, double angle, const Vec3& q, double s) {
    const double wireAngle = coil.hand * 2 * kPi * s / coil.pitch;
    const double psi = angle + coil.startAngle + wireAngle;
    const Vec3 outward(std::cos(psi), std::sin(psi), 0);
    const Vec3 centre = coil.radius * outward + Vec3(0, 0, coil.zStart + s);
    const double away = glm::length(q - centre);
    const Vec3 normal = away > 0 ? (q - centre) / away : outward;  // on the centre line all directions are equal

    CoilTouch touch{};
    touch.point = centre + coil.wireRadius * normal;
    touch.normal = normal;
    touch.distance = away - coil.wireRadius;
    touch.wireAngle = wireAngle;
    return touch;
}

/// Appends the wire coordinates of every interior minimum between s = low and s = high, in no particular order.
void interiorMinima(const View& view, double low, double high, std::vector<double>& found) {
    const auto keep = [&](double k) {
        const double m = view.phase - 2 * kPi * k;
        const double s = view.height + (rootInWindow(view.eps, m) - m) / view.kappa;
        // The tolerance keeps a minimum at the very end: without it, rounding could make both this test and the test of
        // the ends miss it.
        if (s >= low - kSameMinimum / std::abs(view.kappa) && s <= high + kSameMinimum / std::abs(view.kappa))
            found.push_back(glm::clamp(s, low, high));
    };
    if (view.eps <= 1) {
        keep(std::round(view.phase / (2 * kPi)));
        return;
    }
    const double window = std::acos(-1 / view.eps);
    const double widest = window + std::sqrt((view.eps - 1) * (view.eps + 1));  // w + eps sin w
    const double uLow = std::min(view.u0 + view.kappa * low, view.u0 + view.kappa * high);
    const double uHigh = std::max(view.u0 + view.kappa * low, view.u0 + view.kappa * high);
    const auto first = std::int64_t(std::ceil(std::max(view.phase - widest, uLow - window) / (2 * kPi)));
    const auto last = std::int64_t(std::floor(std::min(view.phase + widest, uHigh + window) / (2 * kPi)));
    for (std::int64_t k = first; k <= last; ++k) keep(double(k));
}

/// Wire coordinates of every local minimum of the distance with |s - h| <= span, in increasing order.
std::vector<double> minima(const Coil& coil, const View& view, double span) {
    std::vector<double> found;
    interiorMinima(view, std::max(0.0, view.height - span), std::min(coil.length, view.height + span), found);
    // dD/ds: an end is a minimum when the distance grows from there into the wire.
    const auto slope = [&](double s) {
        return view.rho * coil.radius * view.kappa * std::sin(view.u0 + view.kappa * s) + (s - view.height);
    };
    const auto addEnd = [&](double s) {
        const bool known = std::any_of(found.begin(), found.end(), [&](double other) {
            return std::abs(view.kappa * (other - s)) < 2 * kSameMinimum;
        });
        if (!known && std::abs(s - view.height) <= span) found.push_back(s);
    };
    if (slope(0) >= 0) addEnd(0);
    if (slope(coil.length) <= 0) addEnd(coil.length);
    std::sort(found.begin(), found.end());
    return found;
}

void requireFinite(const Vec3& q, double angle) {
    if (!std::isfinite(q.x) || !std::isfinite(q.y) || !std::isfinite(q.z) || !std::isfinite(angle))
        throw std::logic_error("closest point on the coil: the query point or the coil's angle is not finite");
}

}  // namespace

std::vector<CoilTouch> touches(const Coil& coil, double angle, const Vec3& q, double reach) {
    requireFinite(q, angle);
    const double span = reach + coil.wireRadius;  // largest distance from the point to the centre line
    const double height = q.z - coil.zStart;
    const double rho = std::hypot(q.x, q.y);
    std::vector<CoilTouch> found;
    if (std::abs(rho - coil.radius) >= span || height <= -span || height >= coil.length + span) return found;
    for (const double s : minima(coil, viewFrom(coil, angle, q), span)) {
        const CoilTouch touch = touchAt(coil, angle, q, s);
        if (touch.distance < reach) found.push_back(touch);
    }
    return found;
}

CoilTouch closestPoint(const Coil& coil, double angle, const Vec3& q) {
    requireFinite(q, angle);
    CoilTouch nearest{};
    nearest.distance = std::numeric_limits<double>::infinity();
    for (const double s : minima(coil, viewFrom(coil, angle, q), std::numeric_limits<double>::infinity())) {
        const CoilTouch touch = touchAt(coil, angle, q, s);
        if (touch.distance < nearest.distance) nearest = touch;
    }
    return nearest;
}

std::vector<Feature> Coil::places(const Vec3& centre, double reach) const {
    std::vector<Feature> found;
    for (const CoilTouch& touch : touches(*this, 0, centre, reach)) {
        const Closest& closest = touch;
        found.push_back({closest, std::uint32_t(std::lround(std::abs(touch.wireAngle) / (2 * kPi))), 0});
    }
    return found;
}

ShapeForm Coil::form() const {
    constexpr double kAroundWire = 12;  // pieces of its circumference
    ShapeForm form{.solid = true, .approach = pitch / (2 * kPi)};
    if (length < kMostSlender * pitch)
        form.facet = std::max(2 * kPi * wireRadius / kAroundWire, 2 * kPi * radius / (10 * kPiecesAround));
    return form;
}

int maxTouches(const Coil& coil, double a) {
    const auto whole = [](double turns) { return static_cast<int>(std::min(std::floor(turns), 1e9)); };
    const double reach = a + coil.wireRadius;
    const double span = std::min(2 * reach, coil.length);  // extent along z of the wire points that can touch
    // A wire point within reach < radius is less than asin(reach/radius) off the sphere's own angle. Two such points on
    // different turns therefore differ along z by at least this much.
    if (reach < coil.radius) {
        const double separation = coil.pitch * (1 - std::asin(reach / coil.radius) / kPi);
        return whole(span / separation) + 1;
    }
    // Wider than the coil: one minimum in each turn that the span meets, and the two ends.
    return whole(span / coil.pitch) + 4;
}

double conveyingRate(const Coil& coil, double speed) {
    return -coil.hand * speed;  // at a fixed angle the wire's z moves at -rate / kappa
}

}  // namespace vkdose::geometry
