#pragma once
// Runs each member of a sweep as a process of this program, so that it is an ordinary run.

#include <sys/types.h>

#include <list>
#include <string>

#include "host/app/backends.h"
#include "host/study/sweep.h"

namespace vkdose {

class ChildRunner : public MemberRunner {
  public:
    ChildRunner(BackendChoice choice, int slots) : choice_(std::move(choice)), slots_(slots) {}
    ~ChildRunner() override;
    ChildRunner(const ChildRunner&) = delete;
    ChildRunner& operator=(const ChildRunner&) = delete;

    std::string manner() const override { return std::to_string(slots_) + " at a time"; }
    bool settlesBeds() const override { return true; }
    bool takes(const Member&) const override { return int(children_.size()) < slots_; }
    /// Throws RunError if the system starts no more processes.
    void start(const MemberTask& task) override;
    std::optional<MemberEnd> wait() override;
    void interrupt() override;

  private:
    struct Child {
        int number;
        pid_t process;
        int said;  ///< reading end of its stderr
        std::string text;
        bool interrupted = false;  ///< a second interrupt would end it without a checkpoint
    };
    std::vector<std::string> arguments(const MemberTask& task) const;
    MemberEnd reap(std::list<Child>::iterator child);

    BackendChoice choice_;
    int slots_;
    std::list<Child> children_;
};

}  // namespace vkdose
