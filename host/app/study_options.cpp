// The commands that run members: sweep, calibrate, design, scale.
#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "host/app/command_options.h"
#include "host/app/shared_options.h"

namespace vkdose {

namespace {

/// The options of commands that run members.
void addMembers(CLI::App& command, SweepOptions& options, const char* out) {
    command.add_option("--out", options.out, out)->type_name("DIR");
    addMemberOptions(command, options);
    addSet(command, options.overrides,
           "replace a value of every member's case: --set stop.max_doses=2; may be repeated");
    auto* dry = command.add_flag("--dry-run", options.dryRun,
                                 "print the members with the time that they take, and write nothing");
    addAssume(command, options.assume).needs(dry);
    command.add_flag("--quiet", options.quiet, "print errors only");
    addBackend(command, options.backend);
}

CLI::App& addSweep(CLI::App& program, const char* name, const char* what, SweepOptions& options) {
    CLI::App& command = *program.add_subcommand(name, what);
    command.add_option("study", options.study, "study file (TOML)")->required();
    addMembers(command, options, "folder of the sweep (default: out/<name of the study's file> in the current folder)");
    return command;
}

CLI::App& addScale(CLI::App& program, ScaleOptions& options) {
    CLI::App& command = *program.add_subcommand(
        "scale", "run a case with spheres of several sizes: which figures depend on the size, and from where on");
    command.add_option("case", options.sweep.study, "case file (TOML), or name of a case")->required();
    command
        .add_option("--sizes", options.factors,
                    "sizes of the spheres over those of the case; all are judged by the smallest")
        ->delimiter(',')
        ->type_name("FLOAT,...")
        ->default_str("1,1.5,2,3");
    command.add_option("--seeds", options.seeds, "runs of each size")->check(CLI::Range(1, 100))->capture_default_str();
    command
        .add_option("--within", options.within, "difference that is none, in percent of the smallest spheres' figure")
        ->check(CLI::Range(0.01, 100.0))
        ->capture_default_str();
    addMembers(command, options.sweep, "folder of the runs (default: out/<name of the case>-scale)");
    return command;
}

/// A sweep may also run on an MPI job or through a queue.
CLI::App& addPlainSweep(CLI::App& program, SweepOptions& options) {
    CLI::App& command = addSweep(program, "sweep", "run every member of a study: a base case, axes, seeds", options);
    command.add_flag("--mpi", options.mpi, "run a member on each rank of an MPI job (needs a build with VKDOSE_MPI)")
        ->excludes("--ensemble");
    command.add_flag("--prepare", options.prepare, "only make the members' folders, for a queue (tools/slurm-array)");
    return command;
}

CLI::App& addCalibrate(CLI::App& program, SweepOptions& options) {
    return addSweep(program, "calibrate", "find the parameters of a study that dose the measured mass", options);
}

CLI::App& addDesign(CLI::App& program, SweepOptions& options) {
    return addSweep(program, "design", "find the best compromises between what is wished of a device", options);
}

}  // namespace

std::vector<Command> declareStudies(CLI::App& program, Options& o) {
    return {
        {&addPlainSweep(program, o.sweep), [&o] { return sweepCommand(studied(o.sweep)); }},
        {&addCalibrate(program, o.calibration), [&o] { return calibrateCommand(studied(o.calibration)); }},
        {&addDesign(program, o.design), [&o] { return designCommand(studied(o.design)); }},
        {&addScale(program, o.scale),
         [&o] {
             (void)studied(o.scale.sweep);
             return scaleCommand(o.scale);
         }},
    };
}

}  // namespace vkdose
