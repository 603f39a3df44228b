#pragma once
// Lets runs that know nothing of each other share an Ensemble. Each run calls from a thread of its own. When all runs
// that are present want to advance, one of them advances the device for all, by the smallest number of steps that any
// of them wants. A run may come while others go on. They wait until it has loaded.

#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <vector>

#include "host/backend/vulkan/ensemble.h"

namespace vkdose {

class Rendezvous {
  public:
    explicit Rendezvous(const VulkanOptions& options) : ensemble_(options) {}

    /// A new guest, for whom the others wait from now on. Its number may be that of one who has left.
    std::size_t enter();

    /// Returns when the guest has loaded. Guests that come together wait for each other. An exception of Ensemble::load
    /// is thrown to all of them; if the guest comes to others that go on, only those that come get a RunError.
    void load(std::size_t guest, const World& world, const ContactLaw& law, const Particles& particles);

    /// Returns when the guest's steps are made, with what its sensors tell of them. Steps of other guests may not be
    /// finished then. Throws RunError if the run of this guest has failed. Any other exception of the device is thrown
    /// to every guest.
    Sensors advance(std::size_t guest, std::uint32_t steps, double coilRate);

    /// Takes this guest out, so that the others no longer wait for it.
    void leave(std::size_t guest);

    /// Calls `use(ensemble, member)` while no other guest uses the device.
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
        std::uint32_t asked = 0;  ///< number of steps of the call
        std::uint32_t steps = 0;  ///< still to make
        double coilRate = 0;
        Sensors sensors;
        std::exception_ptr problem;
    };

    void await(std::unique_lock<std::mutex>& lock, Guest& guest);
    bool allWish() const;
    void grant();
    void grantLoad();
    void grantPlaces(const std::vector<Guest*>& coming, const std::vector<Guest*>& staying);
    void grantAdvance();
    void grantAll(const std::exception_ptr& problem);

    std::mutex mutex_;
    std::condition_variable granted_;
    Ensemble ensemble_;
    std::deque<Guest> guests_;  ///< which stay where they are when others come
    bool roster_ = true;        ///< whether the ensemble's live members are those present
};

}  // namespace vkdose
