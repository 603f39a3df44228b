#include "host/studio/runs.h"

#include <fmt/format.h>

#include <algorithm>

#include "host/core/error.h"
#include "host/core/printable.h"

namespace vkdose::studio {

Runs::~Runs() {
    {
        const std::lock_guard lock(mutex_);
        for (const auto& [name, run] : runs_)
            if (run->running) run->child->interrupt();
    }
    for (const auto& [name, run] : runs_) run->reader.join();
}

void Runs::start(const std::string& name, const std::vector<std::string>& arguments) {
    const std::lock_guard lock(mutex_);  // to the end: of two that start a run at once the second finds it going on
    const auto former = runs_.find(name);
    if (former != runs_.end() && former->second->running)
        throw RunError(fmt::format("{} is going on; stop it first", printable(name)));
    const auto count = std::count_if(runs_.begin(), runs_.end(), [](const auto& r) { return r.second->running; });
    if (std::size_t(count) >= kMost)
        throw RunError(fmt::format("{} runs are going on; stop one, or wait for its end", count));
    decltype(runs_) begun;
    Run& run = *(begun[name] = std::make_unique<Run>());
    run.child = std::make_unique<Child>(program_, arguments, folder_, true);
    run.reader = std::thread([this, &run] { read(run); });
    // Nothing throws from here on: a thread that nobody joins would end the workbench.
    if (former != runs_.end()) {
        former->second->reader.join();  // at its end: it takes the lock no more
        runs_.erase(former);
    }
    runs_.merge(begun);
}

void Runs::read(Run& run) {
    Ended ended = run.child->read([&](const std::string& line) {
        const std::lock_guard lock(mutex_);
        run.events.push_back(line);
        changed_.notify_all();
    });
    const std::lock_guard lock(mutex_);
    run.ended = std::move(ended);
    run.running = false;
    changed_.notify_all();
}

bool Runs::stop(const std::string& name) {
    const std::lock_guard lock(mutex_);
    const auto found = runs_.find(name);
    if (found == runs_.end() || !found->second->running) return false;
    found->second->child->interrupt();
    return true;
}

bool Runs::tell(const std::string& name, const std::string& line) {
    const std::lock_guard lock(mutex_);
    const auto found = runs_.find(name);
    return found != runs_.end() && found->second->running && found->second->child->tell(line);
}

Runs::State Runs::eventsOf(const std::string& name, std::size_t from, std::chrono::milliseconds patience) {
    std::unique_lock lock(mutex_);
    const auto news = [&] {
        const auto found = runs_.find(name);
        return found == runs_.end() || !found->second->running || found->second->events.size() > from;
    };
    changed_.wait_for(lock, patience, news);
    State state;
    const auto found = runs_.find(name);
    if (found == runs_.end()) return state;
    const Run& run = *found->second;
    state.known = true;
    state.running = run.running;
    state.code = run.ended.code;
    state.error = run.ended.error;
    for (std::size_t i = from; i < run.events.size(); ++i) state.events.push_back(run.events[i]);
    state.next = std::max(from, run.events.size());
    return state;
}

std::vector<std::string> Runs::running() {
    const std::lock_guard lock(mutex_);
    std::vector<std::string> names;
    for (const auto& [name, run] : runs_)
        if (run->running) names.push_back(name);
    return names;
}

}  // namespace vkdose::studio
