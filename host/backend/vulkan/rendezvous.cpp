#include "host/backend/vulkan/rendezvous.h"

#include <algorithm>
#include <stdexcept>

#include "host/core/error.h"

namespace vkdose {

void Rendezvous::load(std::size_t guest, const World& world, const ContactLaw& law, const Particles& particles) {
    std::unique_lock lock(mutex_);
    Guest& g = guests_[guest];
    g.canister = {world, law, particles};
    g.wish = Wish::Load;
    await(lock, g);
}

Sensors Rendezvous::advance(std::size_t guest, std::uint32_t steps, double coilRate) {
    std::unique_lock lock(mutex_);
    Guest& g = guests_[guest];
    if (steps == 0) return ensemble_.sense({{g.member, 0}}).front();
    g.asked = g.steps = steps;
    g.coilRate = coilRate;
    g.wish = Wish::Advance;
    await(lock, g);
    return std::move(g.sensors);
}

void Rendezvous::leave(std::size_t guest) {
    const std::lock_guard lock(mutex_);
    guests_[guest].present = false;
    guests_[guest].canister = {};
    roster_ = false;
    if (allWish()) grant();
}

void Rendezvous::await(std::unique_lock<std::mutex>& lock, Guest& guest) {
    while (guest.wish != Wish::None) {
        if (allWish())
            grant();
        else
            granted_.wait(lock);
    }
    if (guest.problem) std::rethrow_exception(std::exchange(guest.problem, nullptr));
}

bool Rendezvous::allWish() const {
    bool anyone = false;
    for (const Guest& g : guests_) {
        if (g.present && g.wish == Wish::None) return false;
        anyone = anyone || g.present;
    }
    return anyone;
}

void Rendezvous::grant() {
    try {
        const bool loads = std::any_of(guests_.begin(), guests_.end(),
                                       [](const Guest& g) { return g.present && g.wish == Wish::Load; });
        if (loads)
            grantLoad();
        else
            grantAdvance();
    } catch (...) {
        grantAll(std::current_exception());
    }
    granted_.notify_all();
}

void Rendezvous::grantAll(const std::exception_ptr& problem) {
    for (Guest& g : guests_) {
        if (!g.present) continue;
        g.problem = problem;
        g.wish = Wish::None;
    }
}

void Rendezvous::grantLoad() {
    std::vector<Ensemble::Canister> canisters;
    for (Guest& g : guests_) {
        if (!g.present) continue;
        if (g.wish != Wish::Load) throw std::logic_error("one canister of an ensemble cannot be loaded anew alone");
        g.member = std::uint32_t(canisters.size());
        canisters.push_back(std::exchange(g.canister, {}));
    }
    ensemble_.load(canisters);
    roster_ = true;
    grantAll(nullptr);
}

void Rendezvous::grantAdvance() {
    std::uint32_t steps = ~0U;
    std::vector<std::uint32_t> live;
    std::vector<double> rates;
    for (const Guest& g : guests_) {
        rates.resize(std::max<std::size_t>(rates.size(), g.member + 1));
        if (!g.present) continue;
        steps = std::min(steps, g.steps);
        live.push_back(g.member);
        rates[g.member] = g.coilRate;
    }
    if (!roster_) ensemble_.setLive(live);
    roster_ = true;
    ensemble_.advance(steps, rates);
    std::vector<Guest*> through;
    std::vector<Ensemble::Look> looks;
    for (Guest& g : guests_) {
        if (!g.present) continue;
        g.steps -= steps;
        const std::optional<std::string>& failure = ensemble_.failure(g.member);
        if (failure) g.problem = std::make_exception_ptr(RunError(*failure));
        if (failure || g.steps == 0) g.wish = Wish::None;
        if (failure || g.steps > 0) continue;
        through.push_back(&g);
        looks.push_back({g.member, g.asked});
    }
    if (looks.empty()) return;
    std::vector<Sensors> sensed = ensemble_.sense(looks);
    for (std::size_t n = 0; n < through.size(); ++n) through[n]->sensors = std::move(sensed[n]);
}

}  // namespace vkdose
