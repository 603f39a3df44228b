#include "host/app/command_line.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <exception>
#include <functional>
#include <string>
#include <vector>

#include "host/app/commands.h"
#include "host/app/exit_code.h"
#include "host/core/printable.h"

namespace vkdose {

namespace {

void addCase(CLI::App& command, CaseOptions& input) {
    command.add_option("case", input.file, "case file (TOML)")->required();
    command
        .add_option("--set", input.overrides, "replace a value of the case, e.g. --set coil.speed_rpm=60; repeatable")
        ->type_name("KEY=VALUE")
        ->take_all()
        ->allow_extra_args(false);
}

void addDevice(CLI::App& command, BackendChoice& backend) {
    command.add_option("--device", backend.device, "Vulkan device: index or part of its name (see `vkdose devices`)");
    command.add_flag("--validation", backend.validation, "load the Vulkan validation layer (slow, for development)");
}

void addBackend(CLI::App& command, BackendChoice& backend) {
    command.add_option("--backend", backend.backend, "vulkan or reference")
        ->check(CLI::IsMember({"vulkan", "reference"}))
        ->capture_default_str();
    addDevice(command, backend);
}

/// For the program itself, which runs the members of a sweep as processes of its own.
void addParent(CLI::App& command, int& parent) {
    command.add_option("--parent", parent, "end, as by Ctrl-C, when this process does")->group("");
}

void addShow(CLI::App& command, bool& quiet, bool& live) {
    auto* silent = command.add_flag("--quiet", quiet, "print errors only");
    command.add_flag("--live", live, "show the bed and the doses on the terminal")->excludes(silent);
}

void addRun(CLI::App& program, RunOptions& options) {
    CLI::App& command = *program.add_subcommand("run", "simulate a case and write its output folder");
    addCase(command, options.input);
    command.add_option("--out", options.out, "output folder (default: out/<case name>)")->type_name("DIR");
    command.add_flag("--force", options.force, "replace a former run in the output folder");
    addShow(command, options.quiet, options.live);
    command.add_option("--member", options.member, "number of the run in a study")->group("");
    addParent(command, options.parent);
    addBackend(command, options.backend);
}

void addResume(CLI::App& program, ResumeOptions& options) {
    CLI::App& command = *program.add_subcommand("resume", "go on with an interrupted run from its checkpoint");
    command.add_option("dir", options.folder, "output folder of the run")->required()->type_name("DIR");
    addShow(command, options.quiet, options.live);
    addParent(command, options.parent);
    addDevice(command, options.backend);
}

void addCheck(CLI::App& program, CheckOptions& options) {
    CLI::App& command = *program.add_subcommand("check", "validate a case; print time scales, predictions, run time");
    addCase(command, options.input);
    command.add_flag("--measure", options.measure, "measure the device for about a second to estimate the run time");
    addBackend(command, options.backend);
}

void addCompare(CLI::App& program, CompareOptions& options) {
    CLI::App& command = *program.add_subcommand("compare", "run a case on both backends and compare them over time");
    addCase(command, options.input);
    auto* steps = command.add_option("--steps", options.steps, "stop after so many steps")->check(CLI::PositiveNumber);
    command.add_option("--time", options.time, "stop after so many simulated seconds (default: settling, first dose)")
        ->check(CLI::PositiveNumber)
        ->excludes(steps);
    command
        .add_option("--twins", options.twins, "perturbed runs of the reference that measure the chaos of the packing")
        ->check(CLI::Range(1, 16))
        ->capture_default_str();
    addDevice(command, options.backend);
}

void addVerify(CLI::App& program, VerifyOptions& options) {
    CLI::App& command = *program.add_subcommand("verify", "run small cases with known answers and judge the results");
    addBackend(command, options.backend);
    command.add_option("--out", options.out, "folder for verify.md and verify.json")
        ->type_name("DIR")
        ->capture_default_str();
    command.add_option("--only", options.only, "play the cases with this in their name")->type_name("NAME");
}

void addBench(CLI::App& program, BenchOptions& options) {
    CLI::App& command = *program.add_subcommand("bench", "measure the speed of a device on fixed workloads");
    addDevice(command, options.backend);
    command
        .add_option("--bed", options.bed,
                    "case with a list of settled particles, to run at rest and turning (default: " +
                        std::string(kSettledBed) + ")")
        ->type_name("CASE");
    command.add_option("--only", options.only, "run the workloads with this in their name")->type_name("NAME");
    command.add_option("--repeats", options.repeats, "timed repeats of each workload")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
    command.add_option("--copies", options.copies, "processes that run each workload at once, one for each core")
        ->check(CLI::Range(1, 1024))
        ->capture_default_str();
    command.add_option("--members", options.members, "canisters with each workload that share the device")
        ->check(CLI::Range(1, 65535))
        ->capture_default_str()
        ->excludes("--copies");
    command.add_flag("--quick", options.quick, "the small workloads, too short to measure: a trial of the command");
    command.add_option("--out", options.out, "folder for bench.csv and bench.json")
        ->type_name("DIR")
        ->capture_default_str();
}

void addExportCoil(CLI::App& program, ExportCoilOptions& options) {
    CLI::App& command = *program.add_subcommand("export-coil", "write the coil of a case as an STL mesh");
    addCase(command, options.input);
    command.add_option("--out", options.out, "file to write")->type_name("FILE")->capture_default_str();
    command.add_option("--around", options.around, "corners of the wire's cross-section")
        ->check(CLI::Range(3, 1000))
        ->capture_default_str();
    command.add_option("--per-turn", options.perTurn, "straight pieces of a turn")
        ->check(CLI::Range(4, 10000))
        ->capture_default_str();
}

CLI::App& addSweep(CLI::App& program, const char* name, const char* what, SweepOptions& options) {
    CLI::App& command = *program.add_subcommand(name, what);
    command.add_option("study", options.study, "study file (TOML)")->required();
    command.add_option("--out", options.out, "folder of the sweep (default: out/<name of the study's file>)")
        ->type_name("DIR");
    command
        .add_option("--jobs", options.jobs,
                    "members at once, each a process of its own (default on a CPU: one for each core)")
        ->check(CLI::Range(1, 1024));
    command
        .add_option("--ensemble", options.ensemble,
                    "members at once that share the device (default on a GPU: as many as its memory holds)")
        ->check(CLI::Range(1, 1024))
        ->excludes("--jobs");
    command.add_flag("--retry-failed", options.retryFailed, "run the members that failed again");
    command.add_flag("--dry-run", options.dryRun, "print the members and write nothing");
    command.add_flag("--quiet", options.quiet, "print errors only");
    addBackend(command, options.backend);
    return command;
}

void addReport(CLI::App& program, ReportOptions& options) {
    CLI::App& command = *program.add_subcommand("report", "write an HTML report of a run or a sweep");
    command.add_option("source", options.source, "output folder of a run or a sweep, or a study's file")
        ->required()
        ->type_name("DIR|STUDY");
    command.add_option("--out", options.out, "file to write (default: report.html in the folder)")->type_name("FILE");
    command
        .add_option("--experiment", options.experiment, "readings of a balance, to stand beside a run's doses (CSV)")
        ->type_name("FILE");
    command.add_option("--expected", options.expected, "table of published results, to judge a sweep by (TOML)")
        ->type_name("FILE");
    command
        .add_option("--profile", options.profiles,
                    "surface measured on a photograph (CSV), to stand beside a run's after a dose; may be repeated")
        ->type_name("FILE[@DOSE]")
        ->allow_extra_args(false);
}

void addProfile(CLI::App& program, ProfileOptions& options) {
    CLI::App& command = *program.add_subcommand("profile", "trace the surface of the powder in a photograph");
    photo::Reading& reading = options.reading;
    command.add_option("photo", options.photo, "PNG, JPEG or TIFF")->required();
    command
        .add_option_function<std::vector<int>>(
            "--roi",
            [&reading](const std::vector<int>& r) {
                reading.region = photo::Region{r[0], r[1], r[2], r[3]};
            },
            "region in pixels: left, top, width, height (default: the whole picture)")
        ->delimiter(',')
        ->expected(4)
        ->type_name("X,Y,W,H");
    auto* scale = command.add_option("--mm-per-pixel", reading.mmPerPixel, "size of a pixel [mm]");
    command.add_option("--length-mm", reading.lengthMm, "what the region's width stands for [mm]")->excludes(scale);
    command.add_option("--threshold", reading.threshold, "grey between powder and background (default: found)")
        ->check(CLI::Range(1, 255));
    command
        .add_option_function<std::string>(
            "--powder",
            [&reading](const std::string& kind) {
                reading.powder = kind == "dark" ? photo::Powder::Dark : photo::Powder::Light;
            },
            "dark or light (default: what lies lower)")
        ->check(CLI::IsMember({"dark", "light"}));
    command
        .add_option_function<std::string>(
            "--rear", [&reading](const std::string& side) { reading.rearLeft = side == "left"; },
            "side of the rear wall in the picture (default: left)")
        ->check(CLI::IsMember({"left", "right"}));
    command
        .add_option_function<std::vector<double>>(
            "--corner-mm",
            [&reading](const std::vector<double>& corner) {
                reading.cornerZMm = corner[0];
                reading.cornerHeightMm = corner[1];
            },
            "z and height of the region's lower corner at the rear [mm] (default: 0,0)")
        ->delimiter(',')
        ->expected(2)
        ->type_name("Z,H");
    command.add_option("--speck-mm", reading.speckMm, "patches smaller than a square of this edge are dirt [mm]")
        ->check(CLI::NonNegativeNumber)
        ->capture_default_str();
    command.add_option("--out", options.out, "file to write")->type_name("FILE")->capture_default_str();
    command.add_option("--check", options.check, "picture to write, with the surface drawn over the photograph")
        ->type_name("FILE");
}

void addRender(CLI::App& program, RenderOptions& options) {
    CLI::App& command = *program.add_subcommand("render", "draw a run: a picture, several in one, or a film");
    command.add_option("dir", options.folder, "output folder of the run")->required()->type_name("DIR");
    command.add_option("--out", options.out, "file to write (default: picture.png in the folder)")->type_name("FILE");
    auto* times = command
                      .add_option("--time", options.times,
                                  "simulated time [s], or several, side by side; the nearest frames (default: the end)")
                      ->expected(1, 26);
    auto* panels =
        command.add_flag("--panels", options.panels, "four times side by side: settled, first dose, half out, late")
            ->excludes(times);
    auto* movie = command.add_option("--movie", options.movie, "all frames: a film (ffmpeg), or a folder of pictures")
                      ->type_name("FILE|DIR")
                      ->excludes(times)
                      ->excludes(panels)
                      ->excludes("--out");
    command.add_option("--rate", options.rate, "frames per second of the film")
        ->check(CLI::Range(0.1, 240.0))
        ->capture_default_str()
        ->needs(movie);
    command.add_option("--color", options.color, "what the colour tells")
        ->check(CLI::IsMember({"kinetic-energy", "speed", "overlap", "radius", "fill-layer"}))
        ->capture_default_str();
    command.add_option("--from", options.from, "where the colours begin, in the unit of the colour bar");
    command.add_option("--to", options.to, "where they end");
    command.add_option("--view", options.view, "from where")
        ->check(CLI::IsMember({"side", "end", "iso", "cut"}))
        ->capture_default_str();
    command.add_option("--size", options.size, "width and height [pixels], e.g. 1280x720")->type_name("WxH");
    command.add_flag("--no-coil", options.noCoil, "leave the coil out");
    addDevice(command, options.backend);
}

/// Runs `command`; every error becomes lines on stderr and an exit code.
int guarded(const std::function<int()>& command) {
    try {
        return command();
    } catch (...) {
        const Refusal refusal = refusalOf(std::current_exception());
        fmt::print(stderr, "{}\n", refusal.text);
        return refusal.code;
    }
}

}  // namespace

int commandLine(int argc, const char* const* argv) {
    std::signal(SIGXFSZ, SIG_IGN);  // a limit on the size of files becomes an error of the write that meets it
    CLI::App program("Simulates the dosing of cohesive powder by a turning coil (discrete element method).", "vkdose");
    program.require_subcommand(1);
    RunOptions run;
    ResumeOptions resume;
    CheckOptions check;
    CompareOptions compare;
    VerifyOptions verification;
    BenchOptions bench;
    ExportCoilOptions exportCoil;
    SweepOptions sweep;
    SweepOptions calibration;
    ReportOptions report;
    ProfileOptions profile;
    RenderOptions render;
    addRun(program, run);
    addResume(program, resume);
    addCheck(program, check);
    program.add_subcommand("devices", "list the Vulkan devices");
    addCompare(program, compare);
    addVerify(program, verification);
    addBench(program, bench);
    addExportCoil(program, exportCoil);
    addSweep(program, "sweep", "run every member of a study", sweep)
        .add_flag("--mpi", sweep.mpi, "a member on each rank of an MPI job (needs a build with VKDOSE_MPI)")
        ->excludes("--ensemble");
    program.get_subcommand("sweep")->add_flag("--prepare", sweep.prepare,
                                              "only make the members' folders, for a queue (tools/slurm-array)");
    addSweep(program, "calibrate", "find the case of a study that doses what was measured", calibration);
    addReport(program, report);
    addProfile(program, profile);
    addRender(program, render);
    try {
        program.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
        // --help is a ParseError too, with code 0 and its text on stdout.
        if (e.get_exit_code() == 0) return program.exit(e);
        fmt::print(stderr, "vkdose: {}\nRun `vkdose --help` or `vkdose COMMAND --help`.\n", printableLines(e.what()));
        return kBadInput;
    }
    if (program.got_subcommand("run")) return guarded([&] { return runCommand(run); });
    if (program.got_subcommand("resume")) return guarded([&] { return resumeCommand(resume); });
    if (program.got_subcommand("check")) return guarded([&] { return checkCommand(check); });
    if (program.got_subcommand("compare")) return guarded([&] { return compareCommand(compare); });
    if (program.got_subcommand("verify")) return guarded([&] { return verifyCommand(verification); });
    if (program.got_subcommand("bench")) return guarded([&] { return benchCommand(bench); });
    if (program.got_subcommand("export-coil")) return guarded([&] { return exportCoilCommand(exportCoil); });
    if (program.got_subcommand("sweep")) return guarded([&] { return sweepCommand(sweep); });
    if (program.got_subcommand("calibrate")) return guarded([&] { return calibrateCommand(calibration); });
    if (program.got_subcommand("report")) return guarded([&] { return reportCommand(report); });
    if (program.got_subcommand("profile")) return guarded([&] { return profileCommand(profile); });
    if (program.got_subcommand("render")) return guarded([&] { return renderCommand(render); });
    return guarded([] { return devicesCommand(); });
}

}  // namespace vkdose
