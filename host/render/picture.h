#pragma once
// A whole picture: powder, coil, bodies and canister, once or in several panels, with colour bar, scale bar and time.

#include <string>
#include <vector>

#include "host/analysis/drawn_bodies.h"
#include "host/render/canvas.h"
#include "host/render/quantity.h"
#include "host/render/ray_caster.h"

namespace vkdose::render {

struct PictureSpec {
    View view = View::Side;
    Scale scale;
    bool coil = true;
    std::vector<DrawnBody> bodies;  ///< those that are to be seen
    int width = 0, height = 0;      ///< [pixels]; 0: as large as what is to be seen takes, even numbers
};

/// One state of the powder.
struct Panel {
    const Frame* frame;
    std::vector<double> values;  ///< of every particle, to be coloured on the picture's scale
    std::string title;
};

/// The part of a frame to be seen, with a margin: the canister and its coil, up to the height that all powder but a
/// stray hundredth reaches. Without a canister it is the particles and the coil. Bodies are seen whole, but for those
/// without an end.
Box contentOf(const Case& c, const Frame& frame, const std::vector<DrawnBody>& bodies = {});
/// Of several frames.
Box united(const Box& a, const Box& b);

/// "1.20 s, dose 1, turning"; of a device in which nothing turns "moving".
std::string stateText(const Case& c, const Frame& frame);

/// Where the parts of a picture stand, all in pixels. Each panel has the same camera.
struct Layout {
    int width = 0, height = 0;
    double text = 0;  ///< height of a line
    Camera camera;
    std::vector<Canvas::Point> panels;  ///< top left corners of their images
    Canvas::Point bar{};                ///< top left corner of the colour bar
    double barWidth = 0, barHeight = 0;
    double scaleLength = 0;  ///< what the scale bar stands for [m]
    Canvas::Point scaleFrom{}, scaleTo{};
};
Layout layoutOf(const PictureSpec& spec, const Box& content, std::size_t panels);

/// Draws the picture. `content` is that of contentOf, united over all frames of a film, so that nothing jumps.
Canvas drawPicture(RayCaster& caster, const Case& c, const PictureSpec& spec, const Box& content,
                   const std::vector<Panel>& panels);

}  // namespace vkdose::render
