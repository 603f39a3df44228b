#pragma once
// Runs members of a sweep in this process, a batch at a time: they share the device and step together, each played in a
// thread of its own. A member that ends leaves its place to the next one of its batch.

#include <atomic>
#include <condition_variable>
#include <deque>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "host/app/backends.h"
#include "host/app/batches.h"
#include "host/study/sweep.h"

namespace vkdose {

class EnsembleRunner : public MemberRunner {
  public:
    /// `most` members at once; 0: as many as fit `room`, up to kMostThreads. Throws RunError if HDF5 was built for one
    /// thread only: members write their checkpoints side by side.
    EnsembleRunner(BackendChoice choice, int most, const DeviceRoom& room);
    ~EnsembleRunner() override;
    EnsembleRunner(const EnsembleRunner&) = delete;
    EnsembleRunner& operator=(const EnsembleRunner&) = delete;

    static constexpr int kMostThreads = 1024;

    std::string manner() const override;
    bool settlesBeds() const override { return true; }
    /// By batches (batchesOf).
    void order(std::vector<WaitingMember>& members) override;
    /// Only members of one batch, as many as it has places, until all of them have ended.
    bool takes(const Member& member) const override;
    void start(const MemberTask& task) override;
    /// Throws DeviceError if the device does not start.
    std::optional<MemberEnd> wait() override;
    void interrupt() override { stop_ = true; }

  private:
    struct Place {
        std::size_t batch = 0;
        std::size_t particles = 0;
    };
    void launch();
    /// Plays the member in a thread. Without a backend it enters the ensemble when it is ready to load.
    void play(const MemberTask& task, std::unique_ptr<Backend> backend);
    MemberEnd run(const MemberTask& task, std::unique_ptr<Backend> backend);

    BackendChoice choice_;
    int most_;
    DeviceRoom room_;
    std::vector<Batch> batches_;
    std::map<int, Place> places_;             ///< of the members that were ordered
    std::vector<MemberTask> first_;           ///< of a batch, started and not yet launched
    std::optional<VulkanEnsemble> ensemble_;  ///< of those that were launched
    std::map<int, std::thread> threads_;      ///< launched, and not waited for
    std::atomic<bool> stop_{false};
    std::mutex mutex_;
    std::condition_variable someEnded_;
    std::deque<MemberEnd> ended_;  ///< and not waited for
};

}  // namespace vkdose
