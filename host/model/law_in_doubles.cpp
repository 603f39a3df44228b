#include "host/model/law_in_doubles.h"

#include <algorithm>
#include <cmath>

namespace vkdose {
namespace {

struct Answer {
    const char* function;
    double LawPoint::*device;
    double LawAnswer::*exact;
};
constexpr Answer kAnswers[] = {{"force", &LawPoint::force, &LawAnswer::force},
                               {"stiffness", &LawPoint::stiffness, &LawAnswer::stiffness},
                               {"damping", &LawPoint::damping, &LawAnswer::damping},
                               {"pull", &LawPoint::pull, &LawAnswer::pull},
                               {"energy", &LawPoint::energy, &LawAnswer::energy}};

double asFloat(double x) {
    return double(float(x));
}

}  // namespace

std::vector<LawPoint> LawInDoubles::tried(const LawLoading& loading) {
    constexpr int kPart = 32;  // pressed, drawn apart, beyond touch
    const double reach = program_.reach(loading.own, loading.radius);
    LawProgram::Memory memory{};
    std::vector<LawPoint> points;
    for (int k = 0; k < 3 * kPart; ++k) {
        const bool presses = k < kPart, touches = k < 2 * kPart;
        const double share = double(presses ? k + 1 : 2 * kPart - k) / kPart;
        LawPoint p;
        p.overlap = touches ? loading.deepest * share * share * share : -reach * (k - 2 * kPart) / kPart;
        p.speed = presses ? loading.speed : -loading.speed;
        const LawAnswer a =
            program_.answer(loading.own, {p.overlap, p.speed, loading.radius, loading.mass}, memory, loading.sides);
        for (const Answer& answer : kAnswers) p.*answer.device = a.*answer.exact;
        p.flows = a.flows;
        p.reach = reach;
        points.push_back(p);
    }
    return points;
}

void LawInDoubles::compare(const std::string& pair, const LawLoading& loading, std::span<const LawPoint> points) {
    constexpr std::uint64_t kMostWork = 4'000'000;  // about half a second
    constexpr double kSmall = 1e-3;
    if (program_.work() > kMostWork) return;
    LawProgram::Parameters own{};
    std::transform(loading.own.begin(), loading.own.end(), own.begin(), asFloat);
    LawSides sides;
    std::transform(loading.sides.i.begin(), loading.sides.i.end(), sides.i.begin(), asFloat);
    std::transform(loading.sides.j.begin(), loading.sides.j.end(), sides.j.begin(), asFloat);
    LawProgram::Memory memory{};
    std::vector<LawAnswer> exact;
    for (const LawPoint& p : points)
        exact.push_back(
            program_.answer(own, {p.overlap, p.speed, asFloat(loading.radius), asFloat(loading.mass)}, memory, sides));
    for (const Answer& answer : kAnswers) {
        double largest = 0;
        for (const LawAnswer& a : exact) largest = std::max(largest, std::abs(a.*answer.exact));
        for (std::size_t k = 0; k < points.size() && largest > 0; ++k) {
            const double device = points[k].*answer.device, is = exact[k].*answer.exact;
            // A contact of a run is much shallower than the deepest of the trial. Where an answer changes its sign, its
            // share of the largest counts.
            const double share = std::abs(device - is) / std::max(std::abs(is), kSmall * largest);
            if (share > (worst_ ? worst_->share : 0))
                worst_ = {answer.function, pair, points[k].overlap, device, is, share};
        }
    }
}

}  // namespace vkdose
