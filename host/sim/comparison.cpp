#include "host/sim/comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "host/core/error.h"
#include "host/core/random.h"
#include "host/model/body_form.h"
#include "host/sim/agreement.h"
#include "host/sim/body_clocks.h"
#include "host/sim/ledger.h"

namespace vkdose {

namespace {

/// The reference with every particle displaced a little, each twin differently.
Particles twinOf(const Particles& original, double shift, std::uint64_t seed, std::uint32_t twin) {
    Particles p = original;
    for (std::size_t i = 0; i < p.size(); ++i) {
        const auto [x, y] = uniforms(seed, Stream::Jitter, i, 2 * twin);
        const auto [z, unused] = uniforms(seed, Stream::Jitter, i, 2 * twin + 1);
        (void)unused;
        p.position[i] += shift * (2.0 * Vec3(x, y, z) - 1.0);
    }
    return p;
}

/// Steps at which all stop to be compared: 1, 2, 3, 5, 7, 10, 15, ... for the first contacts, two hundred evenly
/// spread ones for the packing, and every end of a phase or of a piece of a ramp (so that no interval holds two
/// speeds).
std::vector<std::uint64_t> checkpoints(const Timeline& timeline, std::uint64_t steps) {
    std::set<std::uint64_t> at;
    for (std::uint64_t decade = 1; decade < steps; decade *= 10) {
        for (const std::uint64_t tenths : {10, 15, 20, 30, 50, 70}) at.insert(tenths * decade / 10);
    }
    for (std::uint64_t i = 1; i <= 200; ++i) at.insert(steps * i / 200);
    for (std::uint64_t s = 0; s < steps && !timeline.over(s); s = timeline.at(s).pieceEnd)
        at.insert(timeline.at(s).pieceEnd);
    at.insert(steps);
    at.erase(0);
    at.erase(at.upper_bound(steps), at.end());
    return {at.begin(), at.end()};
}

/// One backend on its way through the schedule.
class Walker {
  public:
    Walker(std::string name, const Case& c, const Timeline& timeline, Backend& backend, const Particles& start,
           double filledMass)
        : name_(std::move(name)),
          timeline_(timeline),
          backend_(backend),
          ledger_(start.size(), filledMass),
          clocks_(c.world),
          gravity_(c.settlingGravity()) {
        for (const RigidBody& body : c.world.bodies) levers_.push_back(hingeLever(body));
        told([&] { backend_.load(c.settlingWorld(), c.settlingLaw, start); });
    }

    void advanceTo(std::uint64_t step) {
        const Timeline::Stretch stretch = timeline_.at(step_);
        const auto n = static_cast<std::uint32_t>(step - step_);
        Sensors sensors;
        told([&] {
            if (stretch.law != law_) backend_.setLaw(*stretch.law);
            if (stretch.gravity != gravity_) backend_.setGravity(stretch.gravity);
            law_ = stretch.law;
            gravity_ = stretch.gravity;
            clocks_.enter(stretch.phase, stretch.dose);
            if (clocks_.any()) backend_.setClocks(clocks_.now());
            clocks_.count(n);
            sensors = backend_.advance(n, stretch.rate);
            ledger_.close(sensors, timeline_.time(step));
            state = backend_.particles();
            contacts = backend_.contacts().size();
        });
        step_ = step;
        append(sensors, stretch, n);
    }

    Particles state;
    std::size_t contacts = 0;
    History history;

  private:
    /// An error says which of the backends met it.
    template <typename F>
    void told(F&& work) {
        try {
            work();
        } catch (const RunError& e) {
            throw RunError(fmt::format("{}: {}", name_, e.what()));
        }
    }

    void append(const Sensors& s, const Timeline::Stretch& stretch, std::uint32_t n) {
        const bool fresh = history.empty() || stretch.end != phaseEnd_;
        phaseEnd_ = stretch.end;
        if (fresh) {
            impulse_ = energySteps_ = contactSteps_ = 0;
            phaseSteps_ = 0;
        }
        phaseSteps_ += n;
        Moment m;
        m.time = timeline_.time(step_);
        m.phase = stretch.phase;
        m.kineticEnergy = s.kineticEnergy + s.rotationalEnergy;
        m.lateInPhase = 2 * phaseSteps_ >= phaseSteps_ + (stretch.end - step_);
        m.maxOverlap = fresh ? s.maxOverlapRatio : std::max(history.back().maxOverlap, s.maxOverlapRatio);
        m.dosedMass = s.mass[static_cast<std::size_t>(Region::Dosed)];
        double height = 0, active = 0;
        for (std::size_t i = 0; i < state.size(); ++i) {
            if (state.status[i] != Status::Active) continue;
            height += state.position[i].y;
            active += 1;
        }
        m.meanHeight = active > 0 ? height / active : 0;
        const std::vector<FreeBody> free = backend_.freeBodies();
        for (std::size_t b = 0; b < free.size(); ++b)
            m.freeWay += glm::length(free[b].shift) + std::abs(free[b].angle) * levers_[b];
        // Means over the phase; energy and contacts from the values at the checkpoints.
        impulse_ += s.coilTorque * n;
        energySteps_ += m.kineticEnergy * n;
        contactSteps_ += active > 0 ? static_cast<double>(contacts) / active * n : 0;
        const auto steps = static_cast<double>(phaseSteps_);
        m.meanTorque = impulse_ / steps;
        m.meanKineticEnergy = energySteps_ / steps;
        m.contactsEach = contactSteps_ / steps;
        history.push_back(m);
    }

    std::string name_;
    const Timeline& timeline_;
    Backend& backend_;
    Ledger ledger_;
    BodyClocks clocks_;
    std::uint64_t step_ = 0;
    const ContactLaw* law_ = nullptr;  // in force
    Vec3 gravity_;                     // in force [m/s2]
    std::vector<double> levers_;       // hingeLever of each body [m]
    std::uint64_t phaseEnd_ = 0;
    double impulse_ = 0, energySteps_ = 0, contactSteps_ = 0;  // sums over the phase, times steps
    std::uint64_t phaseSteps_ = 0;
};

}  // namespace

Verdict Comparison::verdict() const {
    const auto any = [](const auto& rows, Verdict verdict) {
        return std::any_of(rows.begin(), rows.end(), [&](const auto& row) { return row.verdict == verdict; });
    };
    if (any(particles, Verdict::Differs) || any(quantities, Verdict::Differs)) return Verdict::Differs;
    const bool judged = any(particles, Verdict::Agrees) && any(quantities, Verdict::Agrees);
    return judged ? Verdict::Agrees : Verdict::Undecided;
}

int Comparison::undecided() const {
    const auto count = std::count_if(quantities.begin(), quantities.end(),
                                     [](const QuantityRow& row) { return row.verdict == Verdict::Undecided; });
    return static_cast<int>(count);
}

Comparison compareBackends(const Case& c, const Insertion& filled, Backend& reference, const Twins& twins,
                           Backend& candidate, std::uint64_t steps, const std::function<void(std::uint64_t)>& progress,
                           const std::atomic<bool>& stop) {
    const Timeline timeline(c);
    const Scales scales = scalesOf(c.world, filled.particles, filled.mass);
    Walker ref("reference", c, timeline, reference, filled.particles, filled.mass);
    Walker other(candidate.description(), c, timeline, candidate, filled.particles, filled.mass);
    const auto start = [&](double shift, std::uint32_t twin) {
        return twinOf(filled.particles, shift * scales.radius, c.seed, twin);
    };
    Walker fine("fine twin", c, timeline, *twins.fine, start(kFineShift, 1), filled.mass);
    std::vector<Walker> rough;
    rough.reserve(twins.rough.size());
    for (Backend* twin : twins.rough) {
        const auto number = static_cast<std::uint32_t>(rough.size()) + 1;
        rough.emplace_back(fmt::format("rough twin {}", number), c, timeline, *twin, start(kRoughShift, number + 1),
                           filled.mass);
    }

    Comparison result;
    ParticleJudge judge(scales);
    for (const std::uint64_t step : checkpoints(timeline, steps)) {
        if (stop || timeline.over(result.steps)) break;
        const Phase phase = timeline.at(result.steps).phase;
        ref.advanceTo(step);
        other.advanceTo(step);
        fine.advanceTo(step);
        for (Walker& twin : rough) twin.advanceTo(step);
        ParticleRow row = judge.row(step, timeline.time(step), ref.contacts, ref.state, fine.state, other.state);
        row.phase = phase;
        result.particles.push_back(row);
        result.steps = step;
        progress(step);
    }
    result.interrupted = stop;
    std::vector<const History*> spread;
    for (const Walker& twin : rough) spread.push_back(&twin.history);
    result.quantities = judgeQuantities(ref.history, spread, other.history, scales);
    return result;
}

}  // namespace vkdose
