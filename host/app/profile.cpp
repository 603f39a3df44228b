#include "host/photo/profile.h"
#include "host/app/tell.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/app/commands.h"
#include "host/app/exit_code.h"
#include "host/app/inputs.h"
#include "host/core/file.h"
#include "host/core/printable.h"
#include "host/core/vec.h"
#include "host/photo/mean_picture.h"

namespace vkdose {

namespace {

/// The first things a person looks at: how much was found, and where.
std::string summary(const photo::Surface& s) {
    double low = std::numeric_limits<double>::infinity(), high = -low, sum = 0;
    int known = 0;
    for (const photo::SurfacePoint& p : s.points) {
        if (!p.heightMm) continue;
        low = std::min(low, *p.heightMm);
        high = std::max(high, *p.heightMm);
        sum += *p.heightMm;
        ++known;
    }
    std::string text =
        fmt::format("{} powder in {} of {} columns of {:.4g} mm, {:.2f} to {:.2f} mm high, mean {:.2f} mm\n",
                    s.powder == photo::Powder::Dark ? "dark" : "light", known, s.points.size(), s.mmPerPixel, low, high,
                    sum / known);
    if (const auto slope = photo::slopeOf(s))
        text +=
            fmt::format("the line through these heights is at {:.2f}° to the horizontal{}\n",
                        std::abs(*slope) * 180 / kPi, *slope > 0 ? ", rising to the right" : ", rising to the left");
    if (s.columnsCut > 0)
        text +=
            fmt::format("in {} columns the powder reaches the region's upper edge: no height there\n", s.columnsCut);
    return text;
}

/// A single photograph stays in its colours, for the picture to judge by.
photo::Picture meanOf(const std::vector<std::filesystem::path>& files) {
    if (files.size() == 1) return photo::readPicture(files.front());
    photo::MeanPicture mean;
    for (const std::filesystem::path& file : files) mean.add(photo::readPicture(file), file.string());
    return mean.mean();
}

}  // namespace

int profileCommand(const ProfileOptions& options) {
    keepInputs(options.photos, {options.out, options.check});
    if (options.out == options.check) throw UsageError("profile: --out and --check name the same file; give two");
    const photo::Picture picture = meanOf(options.photos);
    const photo::Surface surface = photo::surfaceOf(picture, options.reading);
    replaceFile(options.out, photo::csvText(surface));
    if (!options.check.empty()) replaceFile(options.check, photo::pngBytes(photo::checkPicture(picture, surface)));
    tell("{}{}\n", summary(surface), printable(options.out.string()));
    if (!options.check.empty()) tell("{}\n", printable(options.check.string()));
    return kOk;
}

}  // namespace vkdose
