#include "host/sim/rest_watch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/core/grams.h"

namespace vkdose {

FillFall fillFall(const Case& c, const Particles& filled) {
    const Vec3 down = c.settlingGravity();
    const double gravity = glm::length(down);
    if (gravity == 0 || filled.size() == 0) return {};
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (std::size_t i = 0; i < filled.size(); ++i) {
        const double up = -glm::dot(filled.position[i], down) / gravity;
        low = std::min(low, up - filled.radius[i]);
        high = std::max(high, up + filled.radius[i]);
    }
    const double height = high - low;
    return {height, std::sqrt(2 * height / gravity), std::sqrt(2 * height * gravity)};
}

double meanSpeed(const Sensors& s) {
    const double mass = s.mass[std::size_t(Region::Canister)] + s.mass[std::size_t(Region::Throat)];
    return mass > 0 ? std::sqrt(2 * s.kineticEnergy / mass) : 0;
}

RestWatch::RestWatch(const Case& c, const Particles& filled)
    : fall_(fillFall(c, filled)),
      limit_(c.schedule.restSpeedRatio * fall_.speed),
      hold_(static_cast<std::uint64_t>(std::ceil(fall_.time / c.world.timeStep))) {}

bool RestWatch::rests(const Sensors& sensors, std::uint64_t step) {
    if (!(meanSpeed(sensors) < limit_)) {
        slowSince_ = kNever;
        return false;
    }
    slowSince_ = std::min(slowSince_, step);
    return step - slowSince_ >= hold_;
}

void RestWatch::save(Record& record) const {
    record.putOne("slow_since", slowSince_);
}

void RestWatch::restore(const Record& record) {
    slowSince_ = record.one<std::uint64_t>("slow_since");
}

std::string moverOf(const Case& c, const Settling& settling) {
    for (const RigidBody& body : c.world.bodies) {
        const bool own = body.movesInPhases();
        if (body.movesFreely() || body.clock == Clock::Drive) continue;
        if (own && std::find(body.phases.begin(), body.phases.end(), Phase::Settle) == body.phases.end()) continue;
        const auto clock = own ? std::optional(settling.time) : std::nullopt;
        // A step before the end, at which an interval of its motion may end too.
        const geometry::Moving now = body.moving(settling.time - c.world.timeStep, 0, 0, clock);
        if (now.velocity != Vec3(0) || now.spin != Vec3(0)) return fmt::format("body \"{}\" moves", body.name);
    }
    const double gravity = glm::length(c.settlingGravity());
    const double fall = gravity > 0 ? settling.fallSpeed / gravity : 0;
    const bool comes = std::any_of(c.refills.begin(), c.refills.end(), [&](const Refill& r) {
        return r.time && *r.time <= settling.time && *r.time >= settling.time - fall;
    });
    return comes ? "powder comes in" : "";
}

std::string settlingSentence(const Settling& s, const Case& c) {
    const Schedule& schedule = c.schedule;
    std::string text = fmt::format("at rest at t = {:.4g} s", s.time);
    if (!s.atRest) {
        text = fmt::format("{}not at rest at t = {:.4g} s",
                           schedule.untilRest ? "the longest time is over, and the bed is " : "", s.time);
        const std::string mover = moverOf(c, s);
        if (!mover.empty()) text += ", as " + mover;
        if (s.fallSpeed > 0) {
            const double now = 100 * s.speed / s.fallSpeed, rest = 100 * schedule.restSpeedRatio;
            text += fmt::format(" (speed {:.2g} % of that after a fall from the fill's top", now);
            if (mover.empty()) text += "; ";
            text += !mover.empty() ? ")"
                    : now < rest
                        ? fmt::format("it is below {:.2g} %, but has been for less than the time of that fall)", rest)
                        : fmt::format("at rest it is below {:.2g} %)", rest);
        }
    }
    if (s.spilled > 0 && schedule.rotateTime > 0)
        text += fmt::format("; {} g had left by then, in no dose of this run", grams(s.spilled));
    return text;
}

void put(Record& record, const std::optional<Settling>& settling) {
    if (!settling) return;
    const Settling& s = *settling;
    record.put("settling_counts", std::vector<std::uint64_t>{s.step, s.atRest ? 1U : 0U});
    record.put("settling_figures", std::vector<double>{s.time, s.speed, s.fallSpeed, s.spilled});
}

void get(const Record& record, std::optional<Settling>& settling) {
    settling.reset();
    if (!record.arrays().contains("settling_counts")) return;
    const auto& counts = record.get<std::uint64_t>("settling_counts", 2);
    const auto& figures = record.get<double>("settling_figures", 4);
    settling = Settling{counts[0], counts[1] != 0, figures[0], figures[1], figures[2], figures[3]};
}

}  // namespace vkdose
