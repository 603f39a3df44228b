#pragma once
// The surface of a bed from a photograph: region, contrast, two colours, upper edge, millimetres.

#include <optional>
#include <string>
#include <vector>

#include "host/photo/bed.h"

namespace vkdose::photo {

/// The options for reading a photograph.
struct Reading {
    std::optional<Region> region;  ///< if not given, the whole picture
    /// One of the two is given: the size of a pixel, or the width that the region stands for [mm].
    std::optional<double> mmPerPixel, lengthMm;
    std::optional<int> threshold;  ///< of the picture's own greys, 1 ... 255, dark below; else even light and `otsu`
    Powder powder = Powder::Automatic;
    bool rearLeft = true;  ///< the rear wall is on the left
    double speckMm = 1;    ///< patches smaller than a square of this edge are dirt
    /// Place of the region's lower corner at the rear wall's side: z from the rear wall, height over the canister's
    /// lowest point [mm].
    double cornerZMm = 0, cornerHeightMm = 0;
};

struct SurfacePoint {
    double zMm = 0;                  ///< along the coil from the rear wall
    std::optional<double> heightMm;  ///< over the canister's lowest point, where there is a surface
};

/// The surface, from the rear wall on, and how it was found.
struct Surface {
    std::vector<SurfacePoint> points;  ///< one for each column of the region
    Region region;
    std::vector<std::optional<int>> edge;  ///< per column of the region: the highest row of the bed, from the top
    Powder powder = Powder::Dark;
    double mmPerPixel = 0;
    bool rearLeft = true;  ///< the rear wall is on the left: `points` go to the right
    int columnsCut = 0;    ///< where the bed reaches the region's upper edge, so that its height is not known
};

/// Row of the highest 1 in every column, from the top. Absent in columns without a 1.
std::vector<std::optional<int>> upperEdge(const Mask& mask);

/// Finds the surface. A height is off by up to half a pixel, and by the blur of the picture. Throws PhotoError if the
/// options make no sense or nothing is found.
Surface surfaceOf(const Picture& picture, const Reading& reading);

/// Angle to the horizontal of the least-squares line through the heights of all columns that have one [rad]; positive
/// where the surface rises to the right of the picture. None of fewer than two heights.
std::optional<double> slopeOf(const Surface& surface);

/// "z_mm,height_mm" and a line for each point; the height is empty where there is none.
std::string csvText(const Surface& surface);

/// The photograph with the region framed and the surface drawn over it, at most 1600 pixels wide. It is there to be
/// judged by eye.
Picture checkPicture(const Picture& picture, const Surface& surface);

}  // namespace vkdose::photo
