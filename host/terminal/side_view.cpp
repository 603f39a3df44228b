#include "host/terminal/side_view.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "host/model/body_mesh.h"

namespace vkdose::terminal {

namespace {

constexpr Colour kWall{110, 110, 110};
constexpr Colour kCoilFront{235, 235, 240};
constexpr Colour kCoilBack{120, 120, 130};
constexpr Colour kRest{58, 86, 168}, kSlow{214, 204, 150}, kFast{242, 120, 30};
constexpr double kHeadroom = 0.01;  ///< the height shown is a multiple of this [m]
constexpr double kSmallDisc = 1.5;  ///< a disc of a smaller radius in pixels has no rim

Colour between(Colour a, Colour b, double share) {
    const auto mix = [share](std::uint8_t p, std::uint8_t q) {
        return std::uint8_t(std::lround(p + (double(q) - p) * share));
    };
    return {mix(a.red, b.red), mix(a.green, b.green), mix(a.blue, b.blue)};
}

Colour shaded(Colour c, double light) {
    return between({0, 0, 0}, c, light);
}

struct Extent {
    double zLow, zHigh, yLow, yHigh;  ///< [m]
    void hold(double z, double y, double reach) {
        zLow = std::min(zLow, z - reach);
        zHigh = std::max(zHigh, z + reach);
        yLow = std::min(yLow, y - reach);
        yHigh = std::max(yHigh, y + reach);
    }
};

/// The edges of the bodies that are seen from the side, in their place.
std::vector<Edge> edgesOf(const Scene& scene, const Frame& frame) {
    std::vector<Edge> edges;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i)
        for (const Edge& e :
             placed(scene.skins[i], scene.bodies[i].pose(frame.time, frame.coilAngle, frame.movedOf(i))).edges)
            if (e.sharp() || e.onLimb({-1, 0, 0})) edges.push_back(e);
    return edges;
}

Extent extentOf(const Scene& scene, const Particles& p, const std::vector<Edge>& edges) {
    Extent e{kInfinity, -kInfinity, kInfinity, -kInfinity};
    if (const auto& k = scene.canister) {
        e.hold(0, -k->width / 2, 0);
        e.hold(k->length + k->throatLength, k->outletDiameter / 2, 0);
    }
    if (const auto& coil = scene.coil) {
        e.hold(coil->zStart, 0, 0);
        e.hold(coil->zStart + coil->length, 0, 0);
        e.yLow = std::min(e.yLow, -coil->radius - coil->wireRadius);
        e.yHigh = std::max(e.yHigh, coil->radius + coil->wireRadius);
    }
    for (const Edge& edge : edges)
        for (const Vec3& x : {edge.from, edge.to}) e.hold(x.z, x.y, 0);
    for (std::size_t i = 0; i < p.size(); ++i) {
        if (p.status[i] != Status::Active) continue;
        if (scene.canister)
            e.yHigh = std::max(e.yHigh, p.position[i].y + p.radius[i]);  // its walls hold it in the other directions
        else
            e.hold(p.position[i].z, p.position[i].y, p.radius[i]);
    }
    if (!(e.zHigh > e.zLow)) return {0, kHeadroom, 0, kHeadroom};  // nothing there
    e.yHigh = e.yLow + std::ceil((e.yHigh - e.yLow) / kHeadroom - 1e-9) * kHeadroom;
    return e;
}

/// From metres to pixels of a canvas, with a margin of one pixel for the walls.
struct Projection {
    Extent extent;
    double perMetre;
    int height;

    double across(double z) const { return 1 + (z - extent.zLow) * perMetre; }
    double down(double y) const { return height - 1 - (y - extent.yLow) * perMetre; }
    double length(double metres) const { return metres * perMetre; }
};

/// A straight line along z or y, drawn in the pixels beside it: to the left with `outZ` -1, below with `outY` 1.
void wall(Canvas& canvas, const Projection& to, double z0, double y0, double z1, double y1, int outZ, int outY) {
    const auto px = [&](double z) { return int(std::lround(to.across(z))) + outZ; };
    const auto py = [&](double y) { return int(std::lround(to.down(y))) - 1 + outY; };
    for (int x = px(z0); x <= px(z1); ++x)
        for (int y = py(y1); y <= py(y0); ++y) canvas.light(x, y, kWall);
}

void drawCanister(Canvas& canvas, const Projection& to, const Canister& k) {
    const double floor = -k.width / 2, half = k.outletDiameter / 2, top = std::min(k.height + floor, to.extent.yHigh);
    const double out = k.length + k.throatLength;
    wall(canvas, to, 0, floor, k.length, floor, 0, 1);
    wall(canvas, to, 0, floor, 0, top, -1, 1);
    if (top > half) wall(canvas, to, k.length, half, k.length, top, 0, 0);
    if (half < -floor) wall(canvas, to, k.length, floor, k.length, -half, 0, 1);
    wall(canvas, to, k.length, -half, out, -half, 0, 1);
    wall(canvas, to, k.length, half, out, half, 0, 0);
}

void drawCoil(Canvas& canvas, const Projection& to, const geometry::Coil& coil, double angle, bool front) {
    const double turns = coil.length / coil.pitch;
    const double alongWire = to.length(std::hypot(coil.length, 2 * kPi * coil.radius * turns));
    const int pieces = std::clamp(int(2 * alongWire), 1, 100000);
    for (int i = 0; i < pieces; ++i) {
        const double s = coil.length * (i + 0.5) / pieces;
        const double psi = angle + coil.startAngle + coil.hand * 2 * kPi * s / coil.pitch;
        if ((std::cos(psi) < 0) != front) continue;
        canvas.light(int(std::floor(to.across(coil.zStart + s))), int(std::floor(to.down(coil.radius * std::sin(psi)))),
                     front ? kCoilFront : kCoilBack);
    }
}

void drawEdges(Canvas& canvas, const Projection& to, const std::vector<Edge>& edges) {
    for (const Edge& e : edges) {
        const double across = to.length(std::hypot(e.to.z - e.from.z, e.to.y - e.from.y));
        const int pieces = std::clamp(int(2 * across), 1, 10000);
        for (int i = 0; i <= pieces; ++i) {
            const Vec3 x = e.from + (e.to - e.from) * (double(i) / pieces);
            canvas.light(int(std::floor(to.across(x.z))), int(std::floor(to.down(x.y))), kWall);
        }
    }
}

/// In colour a sphere is a shaded disc. In dots it is its rim, and what lies behind it is hidden.
void drawSphere(Canvas& canvas, const Projection& to, const Vec3& x, double radius, Colour colour) {
    const double cx = to.across(x.z), cy = to.down(x.y), r = std::max(to.length(radius), 0.6);
    if (!(cx + r > 0 && cx - r < canvas.width() && cy + r > 0 && cy - r < canvas.height())) return;
    for (int py = int(std::floor(cy - r)); py <= int(std::ceil(cy + r)); ++py) {
        for (int px = int(std::floor(cx - r)); px <= int(std::ceil(cx + r)); ++px) {
            const double d = std::hypot(px + 0.5 - cx, py + 0.5 - cy) / r;
            if (!(d <= 1)) continue;
            if (canvas.style() == Style::Colour)
                canvas.light(px, py, shaded(colour, 0.45 + 0.55 * std::sqrt(1 - d * d)));
            else if (r < kSmallDisc || d > 1 - 1 / r)
                canvas.light(px, py, colour);
            else
                canvas.darken(px, py);
        }
    }
}

void drawPowder(Canvas& canvas, const Projection& to, const Particles& p, double fast) {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < p.size(); ++i)
        if (p.status[i] == Status::Active) order.push_back(i);
    std::sort(order.begin(), order.end(), [&p](std::size_t a, std::size_t b) {
        return p.position[a].x != p.position[b].x ? p.position[a].x > p.position[b].x : a < b;
    });
    for (const std::size_t i : order)
        drawSphere(canvas, to, p.position[i], p.radius[i], speedColour(glm::length(p.velocity[i]), fast));
}

}  // namespace

Scene sceneOf(const Case& c, double tipVelocity) {
    Scene scene;
    scene.canister = c.canister;
    scene.coil = c.world.coil;
    scene.bodies = c.world.bodies;
    scene.loaded = loadNames(c.world);
    for (const RigidBody& body : scene.bodies) scene.skins.push_back(bodySkin(body));
    if (tipVelocity > 0) scene.fast = tipVelocity;
    return scene;
}

Colour speedColour(double speed, double fast) {
    const double share = std::sqrt(std::clamp(speed / fast, 0.0, 1.0));
    if (!std::isfinite(share)) return kFast;
    return share < 0.5 ? between(kRest, kSlow, 2 * share) : between(kSlow, kFast, 2 * share - 1);
}

Canvas sideView(const Scene& scene, const Frame& frame, int columns, int rows, Style style) {
    const std::vector<Edge> edges = edgesOf(scene, frame);
    const Extent extent = extentOf(scene, frame.particles, edges);
    const int across = Canvas::pixelsAcross(style), down = Canvas::pixelsDown(style);
    const double perMetre = std::min((columns * across - 2) / (extent.zHigh - extent.zLow),
                                     (rows * down - 2) / (extent.yHigh - extent.yLow));
    if (!(perMetre > 0)) return Canvas(0, 0, style);
    const auto cells = [perMetre](double metres, int pixels) {
        return int(std::ceil((metres * perMetre + 2) / pixels - 1e-9));
    };
    Canvas canvas(std::min(columns, cells(extent.zHigh - extent.zLow, across)),
                  std::min(rows, cells(extent.yHigh - extent.yLow, down)), style);
    const Projection to{extent, perMetre, canvas.height()};
    if (scene.coil) drawCoil(canvas, to, *scene.coil, frame.coilAngle, false);
    drawPowder(canvas, to, frame.particles, scene.fast);
    if (scene.canister) drawCanister(canvas, to, *scene.canister);
    if (scene.coil) drawCoil(canvas, to, *scene.coil, frame.coilAngle, true);
    drawEdges(canvas, to, edges);
    return canvas;
}

}  // namespace vkdose::terminal
