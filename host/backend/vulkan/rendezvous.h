#pragma once
// Lets runs that know nothing of each other share an Ensemble: each calls from a thread of its own, and when all who
// are present want to go on, one of them advances the device for all, as far as the one who wants least.

#include <condition_variable>
#include <exception>
#include <mutex>
#include <vector>

#include "host/backend/vulkan/ensemble.h"

namespace vkdose {

class Rendezvous {
  public:
    Rendezvous(const VulkanOptions& options, std::size_t guests) : ensemble_(options), guests_(guests) {}

    /// Returns when all who are present have loaded. Throws what Ensemble::load throws, at everyone.
    void load(std::size_t guest, const World& world, const ContactLaw& law, const Particles& particles);

    /// Returns when the guest's steps are made; those of others may then still be under way. Throws RunError if this
    /// guest's run has failed, what else the device throws at everyone.
    void advance(std::size_t guest, std::uint32_t steps, double coilRate);

    /// The others no longer wait for this guest.
    void leave(std::size_t guest);

    /// `use(ensemble, member)` while nobody else uses the device.
    template <class Use>
    auto alone(std::size_t guest, Use use) {
        const std::lock_guard lock(mutex_);
        return use(ensemble_, guests_[guest].member);
    }
    const vk::Device& device() const { return ensemble_.device(); }

  private:
    enum class Wish { None, Load, Advance };
    struct Guest {
        bool present = true;
        std::uint32_t member = 0;  ///< of the ensemble, once loaded
        Wish wish = Wish::None;
        Ensemble::Canister canister;
        std::uint32_t steps = 0;  ///< still to make
        double coilRate = 0;
        std::exception_ptr problem;
    };

    void await(std::unique_lock<std::mutex>& lock, Guest& guest);
    bool allWish() const;
    void grant();
    void grantLoad();
    void grantAdvance();
    void grantAll(const std::exception_ptr& problem);

    std::mutex mutex_;
    std::condition_variable granted_;
    Ensemble ensemble_;
    std::vector<Guest> guests_;
    bool roster_ = true;  ///< whether the ensemble's live members are those present
};

}  // namespace vkdose
