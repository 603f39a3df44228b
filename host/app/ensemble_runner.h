#pragma once
// Runs members of a sweep in this process, a batch at a time: they share the device and step together, each played in a
// thread of its own.

#include <atomic>
#include <condition_variable>
#include <deque>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "host/app/backends.h"
#include "host/backend/vulkan/capacity.h"
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
    /// Only members of one batch, until the first wait; then none until all of them have ended.
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
    MemberEnd run(const MemberTask& task, std::unique_ptr<Backend> backend) const;

    BackendChoice choice_;
    int most_;
    DeviceRoom room_;
    std::map<int, Place> places_;    ///< of the members that were ordered
    std::vector<MemberTask> batch_;  ///< started, and not yet launched
    std::vector<std::thread> threads_;
    std::atomic<bool> stop_{false};
    std::mutex mutex_;
    std::condition_variable someEnded_;
    std::deque<MemberEnd> ended_;  ///< and not waited for
    std::size_t running_ = 0;      ///< launched, and not waited for
};

}  // namespace vkdose
