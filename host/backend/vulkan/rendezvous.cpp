#include "host/backend/vulkan/rendezvous.h"

#include <algorithm>
#include <set>
#include <utility>

#include "host/core/error.h"

namespace vkdose {

std::size_t Rendezvous::enter() {
    const std::lock_guard lock(mutex_);
    const auto left = std::find_if(guests_.begin(), guests_.end(), [](const Guest& g) { return !g.present; });
    const auto number = std::size_t(left - guests_.begin());
    if (left == guests_.end())
        guests_.emplace_back();
    else
        *left = {};
    return number;
}

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
    std::vector<Guest*> coming, staying;
    for (Guest& g : guests_)
        if (g.present) (g.wish == Wish::Load ? coming : staying).push_back(&g);
    if (!staying.empty()) return grantPlaces(coming, staying);
    std::vector<Ensemble::Canister> canisters;
    for (Guest* g : coming) {
        g->member = std::uint32_t(canisters.size());
        canisters.push_back(std::exchange(g->canister, {}));
    }
    ensemble_.load(canisters);
    roster_ = true;
    grantAll(nullptr);
}

/// Those that come take places that are free. If the tables have no room for some of them, larger ones are made.
void Rendezvous::grantPlaces(const std::vector<Guest*>& coming, const std::vector<Guest*>& staying) {
    std::vector<Guest*> placed = staying, waiting;
    std::set<std::uint32_t> free;
    for (std::uint32_t member = 0; member < ensemble_.size(); ++member) free.insert(member);
    for (const Guest* g : staying) free.erase(g->member);
    const auto refused = [](Guest& g) {
        g.problem = std::current_exception();
        g.wish = Wish::None;
    };
    for (Guest* g : coming) {
        try {
            const auto place = std::find_if(
                free.begin(), free.end(), [&](std::uint32_t member) { return ensemble_.replace(member, g->canister); });
            (place == free.end() ? waiting : placed).push_back(g);
            if (place == free.end()) continue;
            g->member = *place;
            g->wish = Wish::None;
            g->canister = {};
            free.erase(place);
        } catch (const RunError&) {
            refused(*g);
        }
    }
    std::vector<std::uint32_t> members;
    std::vector<Ensemble::Canister> beside;
    std::sort(placed.begin(), placed.end(), [](const Guest* a, const Guest* b) { return a->member < b->member; });
    for (const Guest* g : placed) members.push_back(g->member);
    if (placed.size() > staying.size()) ensemble_.setLive(members);
    if (waiting.empty()) return;
    for (Guest* g : waiting) beside.push_back(std::exchange(g->canister, {}));
    try {
        ensemble_.enlarge(members, beside);
    } catch (const RunError&) {
        if (!ensemble_.isLoaded()) throw;
        for (Guest* g : waiting) refused(*g);
        return;
    }
    placed.insert(placed.end(), waiting.begin(), waiting.end());
    for (std::uint32_t member = 0; member < placed.size(); ++member) placed[member]->member = member;
    for (Guest* g : waiting) g->wish = Wish::None;
    roster_ = true;
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
