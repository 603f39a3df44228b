#include "host/app/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace vkdose {

std::string duration(double seconds) {
    if (!(seconds >= 0) || !(seconds < 1e11)) return "?";
    if (seconds < 9.95) return fmt::format("{:.1f} s", seconds);
    const auto s = static_cast<long long>(std::llround(seconds));
    if (s < 60) return fmt::format("{} s", s);
    if (s < 3600) return fmt::format("{} min {:02} s", s / 60, s % 60);
    if (s < 86400) return fmt::format("{} h {:02} min", s / 3600, s % 3600 / 60);
    return fmt::format("{} d {} h", s / 86400, s % 86400 / 3600);
}

std::string large(double x) {
    if (!(x >= 1e3)) return fmt::format("{:.3g} ", x);
    if (x < 1e6) return fmt::format("{:.3g} k ", x / 1e3);
    if (x < 1e9) return fmt::format("{:.3g} M ", x / 1e6);
    return fmt::format("{:.4g} G ", x / 1e9);
}

std::string counted(std::size_t count, const char* thing) {
    return fmt::format("{} {}{}", count, thing, count == 1 ? "" : "s");
}

}  // namespace vkdose
