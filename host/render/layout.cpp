// Where the parts of a picture stand.

#include <algorithm>
#include <cmath>

#include "host/render/picture.h"

namespace vkdose::render {

namespace {

// The width where the user gives no size: room for one panel, and a larger width for several.
constexpr int kAutoWidth = 1400, kAutoHeight = 860, kAutoWider = 1900;

// In heights of a line of text.
constexpr double kMargin = 0.9, kHeader = 1.9, kFooter = 2.4, kGap = 1.2;
constexpr double kBarBlock = 7.0, kBarWidth = 1.1;

/// The largest of 1, 2, 5, 10 ... mm that is not more than x.
double roundedDown(double x) {
    const double decade = std::pow(10.0, std::floor(std::log10(x)));
    for (const double step : {5.0, 2.0})
        if (step * decade <= x * (1 + 1e-9)) return step * decade;
    return decade;
}

int even(double x) {
    return 2 * int(std::ceil(x / 2 - 1e-6));
}

struct Arrangement {
    std::size_t columns = 0;
    Camera camera;
};

/// As many columns as make the panels largest.
Arrangement arranged(const PictureSpec& spec, const Box& content, std::size_t panels, double width, double height,
                     double text) {
    Arrangement best;
    for (std::size_t columns = 1; columns <= panels; ++columns) {
        const std::size_t rows = (panels + columns - 1) / columns;
        const int w = int((width - (double(columns) - 1) * kGap * text) / double(columns));
        const int h = int(height / double(rows) - kHeader * text);
        const Camera camera = cameraFor(spec.view, content, std::max(w, 8), std::max(h, 8));
        if (best.columns == 0 || camera.pixel < best.camera.pixel) best = {columns, camera};
    }
    return best;
}

}  // namespace

Layout layoutOf(const PictureSpec& spec, const Box& content, std::size_t panels) {
    const bool automatic = spec.width == 0;
    Layout l;
    l.width = automatic ? (panels > 1 ? kAutoWider : kAutoWidth) : spec.width;
    l.height = automatic ? kAutoHeight : spec.height;
    l.text = std::clamp(std::min(l.width * 0.7, double(l.height)) / 42, 10.0, 64.0);
    const double margin = kMargin * l.text, across = l.width - 2 * margin - kBarBlock * l.text,
                 down = l.height - 2 * margin - kFooter * l.text;
    const Arrangement a = arranged(spec, content, panels, across, down, l.text);
    l.camera = a.camera;
    const std::size_t rows = (panels + a.columns - 1) / a.columns;
    const double stepX = a.camera.width + kGap * l.text, stepY = a.camera.height + kHeader * l.text;
    const double usedX = stepX * double(a.columns) - kGap * l.text, usedY = stepY * double(rows);
    if (automatic) {
        l.width = even(usedX + l.width - across);
        l.height = even(usedY + l.height - down);
    }
    // Centred in the room that there is.
    const double left = std::floor((l.width - kBarBlock * l.text - usedX) / 2);
    const double top = std::floor((l.height - kFooter * l.text - usedY) / 2);
    for (std::size_t i = 0; i < panels; ++i)
        l.panels.push_back({std::floor(left + stepX * double(i % a.columns)),
                            std::floor(top + stepY * double(i / a.columns) + kHeader * l.text)});
    // In whole pixels, because half a pixel would mix the colours with the paper's.
    const double room = usedY - kHeader * l.text;
    l.barWidth = std::floor(kBarWidth * l.text);
    l.barHeight = std::floor(std::min(room, 24 * l.text));
    l.bar = {std::floor(left + usedX + kGap * l.text), std::floor(top + kHeader * l.text + (room - l.barHeight) / 2)};

    const Vec3 along = spec.view == View::End || spec.view == View::CutEnd ? Vec3(1, 0, 0) : Vec3(0, 0, 1);
    l.scaleLength = roundedDown(0.35 * glm::dot(content.high - content.low, along));
    const Canvas::Point corner = l.panels[(rows - 1) * a.columns];
    // Along the lower edge of the content, on the viewer's side.
    const auto place = [&](double way) {
        const Camera::Place p = l.camera.project(content.low + along * way);
        return Canvas::Point{corner.x + p.x, corner.y + p.y + 0.9 * l.text};
    };
    l.scaleFrom = place(0);
    l.scaleTo = place(l.scaleLength);
    return l;
}

}  // namespace vkdose::render
