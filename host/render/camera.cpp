#include "host/render/camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace vkdose::render {

namespace {

constexpr std::array<const char*, 5> kNames{"side", "end", "iso", "cut", "cut-end"};

/// Distance of the eye in parts of the diagonal of the scene; it acts as a lens of moderate length.
constexpr double kEyeDistance = 3;

/// Smallest and largest place of the content's corners.
struct Extent {
    double left = std::numeric_limits<double>::infinity(), top = left, right = -left, bottom = -left;
};

Extent extentOf(const Camera& camera, const Box& content) {
    Extent e;
    for (int corner = 0; corner < 8; ++corner) {
        Vec3 point;
        for (int k = 0; k < 3; ++k) point[k] = (corner >> k & 1) != 0 ? content.high[k] : content.low[k];
        const Camera::Place p = camera.project(point);
        e = {std::min(e.left, p.x), std::min(e.top, p.y), std::max(e.right, p.x), std::max(e.bottom, p.y)};
    }
    return e;
}

}  // namespace

std::optional<View> viewNamed(std::string_view name) {
    const auto found = std::find(kNames.begin(), kNames.end(), name);
    if (found == kNames.end()) return std::nullopt;
    return View(found - kNames.begin());
}

std::optional<CutPlane> cutOf(View view) {
    if (view == View::Cut) return CutPlane{{-1, 0, 0}, 0};
    if (view == View::CutEnd) return CutPlane{{0, 0, 1}, 0};
    return std::nullopt;
}

Camera::Place Camera::project(const Vec3& point) const {
    const Vec3 d = point - target;
    const double depth = glm::dot(d, towards);
    const double scale = (eye > 0 ? eye / (eye - depth) : 1.0) / pixel;
    return {centreX + scale * glm::dot(d, right), centreY - scale * glm::dot(d, up), depth};
}

Camera cameraFor(View view, const Box& content, int width, int height) {
    Camera c;
    c.target = 0.5 * (content.low + content.high);
    switch (view) {
        case View::Side:
        case View::Cut:
            c.towards = {-1, 0, 0};
            break;
        case View::End:
        case View::CutEnd:
            c.towards = {0, 0, 1};
            break;
        case View::Iso:
            c.towards = glm::normalize(Vec3(-1, 0.55, 0.75));
            c.eye = kEyeDistance * glm::length(content.high - content.low);
            break;
    }
    c.right = glm::normalize(glm::cross(Vec3(0, 1, 0), c.towards));
    c.up = glm::cross(c.towards, c.right);

    c.pixel = 1;
    const Extent e = extentOf(c, content);  // in metres
    c.pixel = std::max((e.right - e.left) / width, (e.bottom - e.top) / height);
    c.centreX = -e.left / c.pixel;
    c.centreY = -e.top / c.pixel;
    // A small amount is subtracted, so that content which exactly fills the picture is not rounded up beyond it.
    c.width = std::clamp(int(std::ceil((e.right - e.left) / c.pixel - 1e-6)), 1, width);
    c.height = std::clamp(int(std::ceil((e.bottom - e.top) / c.pixel - 1e-6)), 1, height);
    return c;
}

}  // namespace vkdose::render
