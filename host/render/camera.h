#pragma once
// From where a picture is taken, and where in it a point stands.

#include <optional>
#include <string_view>

#include "host/core/vec.h"
#include "host/model/world.h"

namespace vkdose::render {

/// Side: seen from -x, the outlet on the right. End: seen into the outlet. Iso: in perspective, from the side, the
/// outlet's end and above. Cut: as Side, with all of x < 0 taken away. CutEnd: as End, with all of z > 0 taken away.
/// All but Iso are true to scale.
enum class View { Side, End, Iso, Cut, CutEnd };

/// "side" ..., if there is such a view.
std::optional<View> viewNamed(std::string_view name);

/// The part of the scene beyond the plane along its normal is taken away.
struct CutPlane {
    Vec3 normal;    ///< unit
    double offset;  ///< dot(point, normal) of the plane's points [m]
};
std::optional<CutPlane> cutOf(View view);

struct Camera {
    Vec3 right{}, up{}, towards{};    ///< unit vectors; `towards` the viewer
    Vec3 target{};                    ///< the point that stands at (centreX, centreY) [m]
    double pixel = 0;                 ///< size of one in the plane through the target [m]
    double eye = 0;                   ///< distance of the eye from that plane; 0: parallel rays [m]
    double centreX = 0, centreY = 0;  ///< in pixels from the top left corner
    int width = 0, height = 0;        ///< of the picture, in pixels

    struct Place {
        double x, y;   ///< pixels from the top left corner
        double depth;  ///< towards the viewer, from the target [m]
    };
    Place project(const Vec3& point) const;
};

/// A camera for which `content` fills the picture in at least one direction. In the other direction the picture is cut
/// to the content. The picture has at most `width` x `height` pixels.
Camera cameraFor(View view, const Box& content, int width, int height);

}  // namespace vkdose::render
