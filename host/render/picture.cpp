#include "host/render/picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>

#include "host/render/colour.h"
#include "host/render/outline.h"

namespace vkdose::render {

namespace {

const Vec3 kInk(0.13), kEdge(0.42);

/// A line that is nearer than this to the drawn surface counts as on it [pixels].
constexpr double kOn = 1.5;

void include(Box& box, const Vec3& low, const Vec3& high) {
    box.low = glm::min(box.low, low);
    box.high = glm::max(box.high, high);
}

/// The height up to which all powder lies except a stray hundredth [m]. It is needed because single spheres are flung
/// about or stick to a lid. Dosed particles count as powder, so that the last particles in the canister are not taken
/// for stray ones.
double powderTop(const Particles& p) {
    std::vector<double> tops;
    for (std::size_t i = 0; i < p.size(); ++i)
        if (p.status[i] == Status::Active) tops.push_back(p.position[i].y + p.radius[i]);
    const std::size_t stray = p.size() / 100;
    if (stray >= tops.size()) return -std::numeric_limits<double>::infinity();
    std::nth_element(tops.begin(), tops.begin() + std::ptrdiff_t(stray), tops.end(), std::greater<>());
    return tops[stray];
}

/// All skins of a body in their place.
std::vector<Skin> skinsOf(const DrawnBody& body, const Case& c, const Frame& frame, const Box& content) {
    const geometry::Pose pose = poseOf(body, c, frame);
    return {placed(body.skin, pose), placed(endlessSkin(c.world.bodies[body.index], pose, content), pose)};
}

/// Edges of the body, and of one that is seen through also the lines where it turns away from the viewer.
std::vector<Line> linesOf(const Skin& skin, bool seeThrough, const Vec3& towards) {
    std::vector<Line> lines;
    for (const Edge& e : skin.edges)
        if (e.sharp() || (seeThrough && e.onLimb(towards))) lines.push_back({e.from, e.to});
    return lines;
}

Scene sceneOf(const Case& c, const PictureSpec& spec, const Box& content, const Panel& panel) {
    const Particles& p = panel.frame->particles;
    Scene scene;
    scene.cut = cutOf(spec.view);
    if (spec.coil) scene.coil = c.world.coil;
    scene.coilAngle = panel.frame->coilAngle;
    for (std::size_t i = 0; i < p.size(); ++i) {
        if (p.status[i] != Status::Active) continue;
        scene.centre.push_back(p.position[i]);
        scene.radius.push_back(p.radius[i]);
        scene.colour.push_back(spec.scale.colour(panel.values[i]));
    }
    for (const DrawnBody& body : spec.bodies)
        for (const Skin& skin : skinsOf(body, c, *panel.frame, content))
            for (const Facet& facet : skin.facets) scene.facets.push_back({facet, body.seeThrough});
    return scene;
}

/// Draws the visible parts of a line, piece by piece.
void drawSeen(Canvas& canvas, const Line& line, const Camera& camera, const Image& image, Canvas::Point corner,
              double thickness) {
    std::vector<Canvas::Point> run;
    const auto end = [&] {
        canvas.line(run, thickness, kEdge);
        run.clear();
    };
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const Camera::Place a = camera.project(line[i]), b = camera.project(line[i + 1]);
        const int pieces = std::max(1, int(std::hypot(b.x - a.x, b.y - a.y)));
        for (int k = 0; k <= pieces; ++k) {
            const Camera::Place p = camera.project(line[i] + (line[i + 1] - line[i]) * (double(k) / pieces));
            const int x = std::clamp(int(std::floor(p.x)), 0, image.width - 1);
            const int y = std::clamp(int(std::floor(p.y)), 0, image.height - 1);
            if (p.depth + kOn * camera.pixel < image.depthAt(x, y)) {
                end();
            } else {
                run.push_back({corner.x + p.x, corner.y + p.y});
            }
        }
    }
    end();
}

void drawPanel(Canvas& canvas, RayCaster& caster, const Case& c, const PictureSpec& spec, const Layout& l,
               const Box& content, const Panel& panel, Canvas::Point corner) {
    const Image image = caster.draw(sceneOf(c, spec, content, panel), l.camera);
    canvas.image(image, int(corner.x), int(corner.y));
    canvas.clip(corner.x, corner.y, image.width, image.height);
    const double thickness = std::max(1.0, l.text / 14);
    const auto drawLine = [&](const Line& line) { drawSeen(canvas, line, l.camera, image, corner, thickness); };
    for (const Line& line : outlineOf(c, l.camera.towards, content, cutOf(spec.view))) drawLine(line);
    for (const DrawnBody& body : spec.bodies)
        for (const Skin& skin : skinsOf(body, c, *panel.frame, content))
            for (const Line& line : left(linesOf(skin, body.seeThrough, l.camera.towards), cutOf(spec.view)))
                drawLine(line);
    canvas.unclip();
    const double fitting = (image.width + 0.5 * l.text) / canvas.textWidth(panel.title, l.text);
    const double size = l.panels.size() > 1 ? l.text * std::clamp(fitting, 0.5, 1.0) : l.text;
    canvas.text(panel.title, corner.x, corner.y - 0.7 * l.text, size, kInk);
}

void drawColourBar(Canvas& canvas, const Scale& scale, const Layout& l) {
    const int rows = int(l.barHeight);
    for (int row = 0; row < rows; ++row) {
        double t = 1 - (row + 0.5) / rows;
        if (scale.bands > 0) t = (std::floor(t * scale.bands) + 0.5) / scale.bands;
        canvas.box(l.bar.x, l.bar.y + row, l.barWidth, 1, mapColour(t));
    }
    double widest = 0;
    for (const Scale::Tick& tick : scale.ticks()) {
        const double y = l.bar.y + (1 - tick.place) * rows, right = l.bar.x + l.barWidth;
        canvas.line({{right, y}, {right + 0.3 * l.text, y}}, std::max(1.0, l.text / 14), kInk);
        canvas.text(tick.text, right + 0.5 * l.text, y + 0.36 * l.text, l.text, kInk);
        widest = std::max(widest, canvas.textWidth(tick.text, l.text));
    }
    canvas.textUpwards(scale.title, l.bar.x + l.barWidth + 1.7 * l.text + widest, l.bar.y + rows / 2.0, l.text, kInk);
}

void drawScaleBar(Canvas& canvas, const Layout& l) {
    const double thickness = std::max(2.0, l.text / 6);
    canvas.line({l.scaleFrom, l.scaleTo}, thickness, kInk);
    canvas.text(fmt::format("{:.4g} mm", l.scaleLength * 1e3), l.scaleTo.x + 0.5 * l.text, l.scaleTo.y + 0.36 * l.text,
                l.text, kInk);
}

}  // namespace

Box united(const Box& a, const Box& b) {
    return {glm::min(a.low, b.low), glm::max(a.high, b.high)};
}

Box contentOf(const Case& c, const Frame& frame, const std::vector<DrawnBody>& bodies) {
    constexpr double kInfinite = std::numeric_limits<double>::infinity();
    Box coil{Vec3(kInfinite), Vec3(-kInfinite)};
    if (const auto& k = c.world.coil) {
        const double reach = k->radius + k->wireRadius;
        coil = {{-reach, -reach, k->zStart - k->wireRadius}, {reach, reach, k->zStart + k->length + k->wireRadius}};
    }
    Box box = coil;
    const Particles& p = frame.particles;
    for (std::size_t i = 0; i < p.size(); ++i)
        if (p.status[i] == Status::Active) include(box, p.position[i] - p.radius[i], p.position[i] + p.radius[i]);
    if (c.canister) {  // with its coil, whatever of the powder lies beyond
        const double half = c.canister->width / 2, top = std::max(powderTop(p), half);
        box = coil;
        include(box, {-half, -half, 0}, {half, top, c.canister->length + c.canister->throatLength});
    }
    for (const DrawnBody& body : bodies)
        for (const Facet& facet : placed(body.skin, poseOf(body, c, frame)).facets)
            for (const Vec3& corner : facet.corners) include(box, corner, corner);
    if (!(box.low.x <= box.high.x)) box = {Vec3(-1e-3), Vec3(1e-3)};
    const Vec3 margin(0.02 * glm::length(box.high - box.low));
    return {box.low - margin, box.high + margin};
}

std::string stateText(const Case& c, const Frame& frame) {
    if (frame.dose == 0) return fmt::format("{:.2f} s", frame.time);
    const std::vector<RigidBody>& bodies = c.world.bodies;
    const bool turns = c.world.coil || std::any_of(bodies.begin(), bodies.end(), [](const RigidBody& b) {
                           return std::holds_alternative<geometry::Turn>(b.course.motion);
                       });
    const char* moving = turns ? "turning" : "moving";
    const std::string doing = frame.phase == Phase::Rest      ? "resting"
                              : frame.phase == Phase::Reverse ? fmt::format("{} back", moving)
                                                              : moving;
    return fmt::format("{:.2f} s, dose {}, {}", frame.time, frame.dose, doing);
}

Canvas drawPicture(RayCaster& caster, const Case& c, const PictureSpec& spec, const Box& content,
                   const std::vector<Panel>& panels) {
    const Layout l = layoutOf(spec, content, panels.size());
    Canvas canvas(l.width, l.height);
    for (std::size_t i = 0; i < panels.size(); ++i)
        drawPanel(canvas, caster, c, spec, l, content, panels[i], l.panels[i]);
    drawColourBar(canvas, spec.scale, l);
    drawScaleBar(canvas, l);
    return canvas;
}

}  // namespace vkdose::render
