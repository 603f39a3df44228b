#pragma once
// What the workbench answers. It has no engine of its own: what it is asked it has the program do, in processes.

#include <atomic>
#include <chrono>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "host/studio/answer.h"
#include "host/studio/own_law.h"
#include "host/studio/runs.h"
#include "host/studio/workspace.h"

namespace vkdose::studio {

class Workbench {
  public:
    /// `first`: a case that a new one begins as. When `stop` comes true, what runs for an answer is interrupted.
    Workbench(const std::filesystem::path& folder, std::filesystem::path program, std::filesystem::path first,
              const std::atomic<bool>& stop)
        : workspace_(folder),
          program_(std::move(program)),
          first_(std::move(first)),
          stop_(stop),
          runs_(program_, workspace_.folder()) {}

    // workbench_cases.cpp
    Json folder() const;
    Json read(const std::string& name) const;
    /// Writes a new case or study. `like`: "mini", "canister" with `answers`, a device that `vkdose new` has ready, or
    /// a study over the case `of`.
    Json make(const Json& body) const;
    /// The keys of cases or of studies.
    Json keys(bool ofStudies);
    /// The powders that are known, as `vkdose powders --json` tells them.
    Json powders() const;
    Json check(const std::string& name, const std::string& text) const;
    static Json edit(const Json& body);
    Json save(const Json& body) const;
    /// Writes a mesh into the folder, and tells its size in its own units. One that cannot be used is not kept.
    Json mesh(const std::string& name, const std::string& content) const;
    void allow(const std::string& law) { laws_.allow(law); }

    // workbench_runs.cpp: runs, and studies, which are many of them
    Json start(const Json& body);
    Json resume(const std::string& run);
    Json stop(const std::string& run);
    Json order(const std::string& run, const std::string& line);
    Json running() { return runs_.running(); }
    Json frame(const std::string& run) const;
    Json history(const std::string& run) const;
    Json members(const std::string& study) const;
    /// Server-sent events: each event of the run with its number, so that a page that was cut off goes on where it was.
    void events(const httplib::Request& request, httplib::Response& response);

    // workbench_exports.cpp
    Json report(const std::string& run) const;
    Json compare(const Json& body) const;
    Json picture(const std::string& run, bool film) const;
    /// A file that a run, a study or a comparison has left, for the browser to show or to keep.
    void file(const std::string& run, const std::string& name, httplib::Response& response) const;

  private:
    /// Throws Refused for a name that is not inside the folder.
    std::filesystem::path fileOf(const std::string& name) const;
    std::filesystem::path caseOf(const std::string& name) const;
    /// The law that nobody has allowed yet, if there is one.
    std::optional<OwnLaw> lawToAskFor(const std::filesystem::path& file) const;
    void requireAllowed(const std::filesystem::path& file) const;
    void requireKnown(const std::string& powder) const;

    struct Said {
        std::string text;  ///< on its standard output
        Ended ended;
    };
    Said said(const std::vector<std::string>& arguments, std::chrono::milliseconds limit) const;
    /// The same, refused with what it says if it fails.
    std::string done(const std::vector<std::string>& arguments, std::chrono::milliseconds limit) const;
    /// What it says as one JSON object.
    Json asked(const std::vector<std::string>& arguments, std::chrono::milliseconds limit) const;
    Json checkStudy(const std::filesystem::path& draft, const std::filesystem::path& file, const std::string& text,
                    const char* command) const;

    Workspace workspace_;
    std::filesystem::path program_, first_;
    const std::atomic<bool>& stop_;
    AllowedLaws laws_;
    Runs runs_;
    std::atomic<std::size_t> listeners_{0};
    mutable std::mutex writing_;  ///< between the look at what a file has and its writing, no other page writes
    std::mutex keysLock_;
    Json caseKeys_, studyKeys_;  ///< once somebody has asked
};

}  // namespace vkdose::studio
