#include "host/app/shared_options.h"

#include <CLI/CLI.hpp>

#include "host/model/case_tree.h"

namespace vkdose {

CLI::App& addGroup(CLI::App& program, const char* name, const char* about) {
    CLI::App& group = *program.add_subcommand(name, about);
    group.require_subcommand(1);
    return group;
}

void addSet(CLI::App& command, std::vector<std::string>& overrides, const char* what) {
    command.add_option("--set", overrides, what)->type_name("KEY=VALUE")->take_all()->allow_extra_args(false);
}

void usePowder(CaseOptions& input) {
    if (input.powder.empty()) return;
    input.powder = std::filesystem::absolute(findPowder(input.powder)).lexically_normal();
    input.overrides.insert(input.overrides.begin(), "powder_file=" + tomlString(input.powder.string()));
}

CLI::Option& addCase(CLI::App& command, CaseOptions& input) {
    addSet(command, input.overrides, "replace a value of the case: --set coil.speed_rpm=60; may be repeated");
    command
        .add_option("--powder", input.powder,
                    "a powder in place of the case's: a powder file (TOML), or a name that `vkdose powders` lists")
        ->type_name("FILE");
    return *command.add_option("case", input.file, "case file (TOML), or the name of a case in the folder cases")
                ->required();
}

void addDevice(CLI::App& command, BackendChoice& backend) {
    command
        .add_option("--device", backend.device, "Vulkan device: its index or part of its name (see `vkdose devices`)")
        ->type_name("NAME");
    command.add_flag("--validation", backend.validation, "load the Vulkan validation layer; slow, for development");
}

void addBackend(CLI::App& command, BackendChoice& backend) {
    command.add_option("--backend", backend.backend, "the backend that computes the steps")
        ->type_name("NAME")
        ->check(CLI::IsMember({"vulkan", "reference"}))
        ->capture_default_str();
    addDevice(command, backend);
}

void addParent(CLI::App& command, int& parent) {
    command.add_option("--parent", parent, "end, as by Ctrl-C, when this process does")->group("");
}

void addShow(CLI::App& command, bool& quiet, bool& live, bool& events, bool& orders) {
    auto* silent = command.add_flag("--quiet", quiet, "print errors only");
    command.add_flag("--live", live, "show the bed and the doses on the terminal while the run goes on")
        ->excludes(silent);
    command
        .add_flag("--events", events, "print phases, samples, doses and warnings as JSON, a line for each, and no text")
        ->excludes("--quiet")
        ->excludes("--live");
    command
        .add_flag("--orders", orders,
                  "obey lines on the standard input while the run goes on: speed RPM, dose GRAMS, stop, refill NAME")
        ->needs("--events");
}

CLI::Option* addFor(CLI::App& command, std::optional<TimeLimit>& limit) {
    return command
        .add_option_function<std::string>(
            "--for",
            [&limit](const std::string& text) {
                try {
                    limit.emplace(text);
                } catch (const UsageError& error) {
                    throw CLI::ValidationError(error.what());
                }
            },
            "wall time of the command, as 480s, 8min or 2h: all members stop at a checkpoint before it is over, and "
            "the "
            "same command goes on")
        ->type_name("TIME");
}

std::vector<CLI::Option*> addMemberOptions(CLI::App& command, MemberOptions& options) {
    auto* jobs = command
                     .add_option("--jobs", options.jobs,
                                 "members at once, each in a process of its own (default on a CPU: one for each core)")
                     ->check(CLI::Range(1, 1024));
    auto* ensemble =
        command
            .add_option("--ensemble", options.ensemble,
                        "members at once that share the device in an ensemble (default on a GPU: as many as its memory "
                        "holds)")
            ->check(CLI::Range(1, 1024))
            ->excludes(jobs);
    auto* limit = addFor(command, options.limit);
    auto* retry = command.add_flag("--retry-failed", options.retryFailed,
                                   "run the members that failed again, from their checkpoints if these can be read");
    return {jobs, ensemble, limit, retry};
}

CLI::Option& addAssume(CLI::App& command, bool& assume) {
    return *command.add_flag("--assume", assume,
                             "estimate the run time at an assumed speed, without measuring the device for a second");
}

}  // namespace vkdose
