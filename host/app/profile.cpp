#include "host/photo/profile.h"
#include "host/app/tell.h"

#include <fmt/format.h>

#include <algorithm>

#include "host/app/commands.h"
#include "host/app/exit_code.h"
#include "host/app/inputs.h"
#include "host/core/file.h"
#include "host/core/printable.h"

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
    if (s.columnsCut > 0)
        text +=
            fmt::format("in {} columns the powder reaches the region's upper edge: no height there\n", s.columnsCut);
    return text;
}

}  // namespace

int profileCommand(const ProfileOptions& options) {
    keepInputs({options.photo}, {options.out, options.check});
    if (options.out == options.check) throw UsageError("profile: --out and --check name the same file; give two");
    const photo::Picture picture = photo::readPicture(options.photo);
    const photo::Surface surface = photo::surfaceOf(picture, options.reading);
    replaceFile(options.out, photo::csvText(surface));
    if (!options.check.empty()) replaceFile(options.check, photo::pngBytes(photo::checkPicture(picture, surface)));
    tell("{}{}\n", summary(surface), printable(options.out.string()));
    if (!options.check.empty()) tell("{}\n", printable(options.check.string()));
    return kOk;
}

}  // namespace vkdose
