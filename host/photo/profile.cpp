#include "host/photo/profile.h"

#include <fmt/format.h>
#include <leptonica/allheaders.h>

#include <algorithm>
#include <cmath>

#include "host/core/line_fit.h"
#include "host/photo/light.h"

namespace vkdose::photo {

namespace {

constexpr int kCheckWidth = 1600;

double pixelSize(const Reading& reading, const Region& region) {
    if (reading.mmPerPixel.has_value() == reading.lengthMm.has_value())
        throw PhotoError(
            "the scale is missing or given twice; give --mm-per-pixel, or the --length-mm that the width "
            "of the region stands for");
    const double size = reading.mmPerPixel ? *reading.mmPerPixel : *reading.lengthMm / region.width;
    if (!(size > 0) || !std::isfinite(size)) throw PhotoError("the scale must be a length above zero");
    return size;
}

Mask powderPixels(const Grey& grey, const Reading& reading, Powder& powder) {
    const Mask dark = reading.threshold ? darkPixels(grey, *reading.threshold) : [&] {
        const Grey even = evenLight(grey);
        Mask found = darkPixels(even, otsu(even));
        requireContrast(grey, found);
        return found;
    }();
    powder = reading.powder == Powder::Automatic ? lowerKind(dark) : reading.powder;
    return powder == Powder::Dark ? dark : inverse(dark);
}

int speckPixels(const Reading& reading, double mmPerPixel) {
    if (!(reading.speckMm >= 0)) throw PhotoError("--speck-mm must be a length, 0 or more");
    return int(std::min(std::lround(reading.speckMm / mmPerPixel), 10000L));
}

}  // namespace

std::vector<std::optional<int>> upperEdge(const Mask& mask) {
    std::vector<std::optional<int>> edge(std::size_t(mask.width));
    for (int x = 0; x < mask.width; ++x) {
        for (int y = 0; y < mask.height && !edge[std::size_t(x)]; ++y)
            if (mask.at(x, y) != 0) edge[std::size_t(x)] = y;
    }
    return edge;
}

Surface surfaceOf(const Picture& picture, const Reading& reading) {
    Surface s;
    s.region = reading.region.value_or(whole(picture));
    const Grey grey = greyOf(picture, s.region);
    s.mmPerPixel = pixelSize(reading, s.region);
    s.rearLeft = reading.rearLeft;
    const int speck = speckPixels(reading, s.mmPerPixel);
    const Mask bed = bedOf(powderPixels(grey, reading, s.powder), speck);
    s.edge = upperEdge(bed);

    int found = 0;
    for (int i = 0; i < s.region.width; ++i) {
        const int column = reading.rearLeft ? i : s.region.width - 1 - i;
        const std::optional<int> row = s.edge[std::size_t(column)];
        SurfacePoint point{reading.cornerZMm + (i + 0.5) * s.mmPerPixel, std::nullopt};
        if (row == 0) {
            ++s.columnsCut;
        } else if (row) {
            point.heightMm = reading.cornerHeightMm + (s.region.height - *row) * s.mmPerPixel;
            ++found;
        }
        s.points.push_back(point);
    }
    if (found == 0 && s.columnsCut > 0)
        throw PhotoError(
            "the powder reaches the region's upper edge everywhere; enlarge --roi upwards, or tell what is --powder, "
            "dark or light");
    if (found == 0)
        throw PhotoError(
            "no powder reaches the region's lower edge; end --roi at the canister's lowest point, or tell what is "
            "--powder, dark or light");
    return s;
}

std::optional<double> slopeOf(const Surface& surface) {
    LineFit line;
    for (const SurfacePoint& p : surface.points)
        if (p.heightMm) line.add(surface.rearLeft ? p.zMm : -p.zMm, *p.heightMm);
    if (line.count() < 2) return std::nullopt;
    return std::atan(line.slope());
}

std::string csvText(const Surface& surface) {
    std::string text = "z_mm,height_mm\n";
    for (const SurfacePoint& p : surface.points)
        text += p.heightMm ? fmt::format("{:.4f},{:.4f}\n", p.zMm, *p.heightMm) : fmt::format("{:.4f},\n", p.zMm);
    return text;
}

Picture checkPicture(const Picture& picture, const Surface& surface) {
    const double scale = std::min(1.0, double(kCheckWidth) / picture.width());
    const auto scaled = [scale](double pixels) { return int(std::lround(pixels * scale)); };
    const Picture colour = held(pixConvertTo32(picture.pix()));
    Picture check =
        held(pixScaleToSize(colour.pix(), std::max(1, scaled(picture.width())), std::max(1, scaled(picture.height()))));

    const int pen = std::max(1, check.width() / 400);
    const Region& r = surface.region;
    BOX* frame = boxCreate(scaled(r.x), scaled(r.y), scaled(r.width), scaled(r.height));
    pixRenderBoxArb(check.pix(), frame, pen, 0, 140, 255);
    boxDestroy(&frame);
    for (std::size_t i = 0; i < surface.edge.size(); ++i) {
        if (!surface.edge[i]) continue;
        const bool joined = i > 0 && surface.edge[i - 1];
        const int before = joined ? *surface.edge[i - 1] : *surface.edge[i];
        const int x = scaled(r.x + double(i));
        pixRenderLineArb(check.pix(), x, scaled(r.y + double(before)), x, scaled(r.y + double(*surface.edge[i])),
                         pen + 1, 255, 0, 160);
    }
    return check;
}

}  // namespace vkdose::photo
