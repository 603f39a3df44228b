// The commands of the group `test`.
#include <CLI/CLI.hpp>
#include <string>

#include "host/app/command_options.h"
#include "host/app/shared_options.h"

namespace vkdose {

namespace {

CLI::App& addVerify(CLI::App& group, VerifyOptions& options) {
    CLI::App& command = *group.add_subcommand("verify", "run small cases with known answers and judge the results");
    addBackend(command, options.backend);
    command.add_option("--out", options.out, "folder for verify.md and verify.json")
        ->type_name("DIR")
        ->capture_default_str();
    command.add_option("--only", options.only, "play only the cases with this in their name")->type_name("NAME");
    command.add_flag("--list", options.list, "tell which cases there are, and play none");
    return command;
}

CLI::App& addValidate(CLI::App& group, ValidateOptions& options) {
    CLI::App& command =
        *group.add_subcommand("validate", "run the comparisons with the literature and judge the results");
    command.add_option("name", options.names, "comparisons to run (default: all)")
        ->check(CLI::IsMember(comparisonNames()));
    command
        .add_option("--out", options.sweep.out,
                    "folder for validate.md, validate.json, validate.html and the runs (default: out/validate, "
                    "with --full out/validate-full)")
        ->type_name("DIR");
    command.add_flag("--full", options.full, "at full size: hours on a CPU");
    command.add_flag("--list", options.list, "tell which comparisons there are, and run none");
    CLI::Option* judge = command.add_flag("--judge", options.judge,
                                          "begin no run: judge those that have ended, while others may still go on");
    command
        .add_option("--jobs", options.sweep.jobs,
                    "runs at once, each in a process of its own (default on a CPU: one for each core)")
        ->check(CLI::Range(1, 1024))
        ->excludes(judge);
    addFor(command, options.sweep.limit);
    command
        .add_flag("--retry-failed", options.sweep.retryFailed,
                  "run those that failed again, from their checkpoints if these can be read")
        ->excludes(judge);
    command.add_flag("--quiet", options.sweep.quiet, "print the verdicts and errors only");
    addBackend(command, options.sweep.backend);
    return command;
}

CLI::App& addBench(CLI::App& group, BenchOptions& options) {
    CLI::App& command = *group.add_subcommand("bench", "measure the speed of a device on fixed workloads");
    addDevice(command, options.backend);
    command
        .add_option("--bed", options.bed,
                    "case with a list of settled particles, which is run at rest and turning (default: " +
                        std::string(kSettledBed) + ")")
        ->type_name("CASE");
    command
        .add_option("--only", options.only,
                    "run only the workloads with this in their name; bed-4M, which takes 8 GB, runs only by its name")
        ->type_name("NAME");
    command.add_option("--repeats", options.repeats, "timed repeats of each workload")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
    command
        .add_option("--copies", options.copies,
                    "processes that run each workload at once, each pinned to a core; the rate is their sum")
        ->check(CLI::Range(1, 1024))
        ->capture_default_str();
    command
        .add_option("--members", options.members,
                    "canisters that share the device in one ensemble, each with the workload")
        ->check(CLI::Range(1, 65535))
        ->capture_default_str()
        ->excludes("--copies");
    command.add_flag("--quick", options.quick,
                     "run only the small workloads, too short to be measured: a trial of the command");
    command.add_option("--out", options.out, "folder for bench.csv and bench.json")
        ->type_name("DIR")
        ->capture_default_str();
    return command;
}

CLI::App& addCompare(CLI::App& group, CompareOptions& options) {
    CLI::App& command =
        *group.add_subcommand("compare", "run a case on both backends side by side and judge the differences");
    addCase(command, options.input);
    auto* steps =
        command.add_option("--steps", options.steps, "stop after this many steps")->check(CLI::PositiveNumber);
    command
        .add_option("--time", options.time, "stop after this simulated time [s] (default: settling and the first dose)")
        ->check(CLI::PositiveNumber)
        ->excludes(steps);
    command
        .add_option("--twins", options.twins,
                    "number of perturbed reference runs that measure the chaos of the packing")
        ->check(CLI::Range(1, 16))
        ->capture_default_str();
    addDevice(command, options.backend);
    return command;
}

}  // namespace

std::vector<Command> declareTests(CLI::App& program, Options& o) {
    CLI::App& test = addGroup(program, "test", "judge and measure vkdose itself");
    return {
        {&addVerify(test, o.verification), [&o] { return verifyCommand(o.verification); }},
        {&addValidate(test, o.validation), [&o] { return validateCommand(o.validation); }},
        {&addBench(test, o.bench), [&o] { return benchCommand(o.bench); }},
        {&addCompare(test, o.compare), [&o] { return compareCommand(named(o.compare)); }},
    };
}

}  // namespace vkdose
