#include "host/app/command_line.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <exception>
#include <functional>
#include <sstream>
#include <string>

#include "host/app/command_options.h"
#include "host/app/command_table.h"
#include "host/app/commands.h"
#include "host/app/exit_code.h"
#include "host/app/find_case.h"
#include "host/app/help.h"
#include "host/app/key_schema.h"
#include "host/app/manual.h"
#include "host/app/tell.h"
#include "host/backend/vulkan/law_trial.h"

namespace vkdose {

namespace {

/// Runs `command`; every error becomes lines on stderr and an exit code.
int guarded(const std::function<int()>& command) {
    try {
        return command();
    } catch (...) {
        const Refusal refusal = refusalOf(std::current_exception());
        tell(stderr, "{}\n", refusal.text);
        return refusal.code;
    }
}

/// The options with the file of a case that may have been given by its name.
template <class Command>
const Command& named(Command& options) {
    options.input.file = findCase(options.input.file);
    return options;
}

/// The same for a study.
const SweepOptions& studied(SweepOptions& options) {
    options.study = findCase(options.study);
    return options;
}

int printed(const std::string& page) {
    say(stdout, page);
    return kOk;
}

/// Runs what the command line asks for and returns its exit code.
int played(int argc, const char* const* argv) {
    tryLawsOnDevices();
    std::signal(SIGXFSZ, SIG_IGN);  // a limit on the size of files becomes an error of the write that meets it
    CLI::App program("Simulates the dosing of cohesive powder by a turning coil (discrete element method).", "vkdose");
    program.set_version_flag("--version", "vkdose " VKDOSE_VERSION);
    program.require_subcommand(1);
    Options given;
    declareCommands(program, given);
    addExamples(program);
    if (argc < 2) return printed(overview(program));
    try {
        program.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
        // --help is a ParseError too, with code 0 and its text on stdout.
        if (e.get_exit_code() == 0) {
            std::ostringstream text;
            program.exit(e, text, text);
            return printed(text.str());
        }
        tell(stderr, "{}", usageFault(program, e.what(), argc > 1 ? argv[1] : ""));
        return kBadInput;
    }
    if (program.got_subcommand("new")) return guarded([&] { return newCommand(given.made); });
    if (program.got_subcommand("run")) return guarded([&] { return runCommand(named(given.run)); });
    if (program.got_subcommand("resume")) return guarded([&] { return resumeCommand(given.resume); });
    if (program.got_subcommand("check")) return guarded([&] { return checkCommand(named(given.check)); });
    if (program.got_subcommand("compare")) return guarded([&] { return compareCommand(named(given.compare)); });
    if (program.got_subcommand("verify")) return guarded([&] { return verifyCommand(given.verification); });
    if (program.got_subcommand("bench")) return guarded([&] { return benchCommand(given.bench); });
    if (program.got_subcommand("export-body"))
        return guarded([&] { return exportBodyCommand(named(given.exportBody)); });
    if (program.got_subcommand("sweep")) return guarded([&] { return sweepCommand(studied(given.sweep)); });
    if (program.got_subcommand("calibrate"))
        return guarded([&] { return calibrateCommand(studied(given.calibration)); });
    if (program.got_subcommand("validate")) return guarded([&] { return validateCommand(given.validation); });
    if (program.got_subcommand("report")) return guarded([&] { return reportCommand(given.report); });
    if (program.got_subcommand("profile")) return guarded([&] { return profileCommand(given.profile); });
    if (program.got_subcommand("render")) return guarded([&] { return renderCommand(given.render); });
    if (program.got_subcommand("keys"))
        return guarded([&] {
            return printed(given.manual.schema ? keySchema(given.manual.study) : keysPage(given.manual.study));
        });
    if (program.got_subcommand("columns")) return guarded([&] { return printed(columnsPage(given.manual.sweep)); });
    if (program.got_subcommand("options"))
        return guarded([&] { return printed(optionsPage(program, given.manual.brief)); });
    if (program.got_subcommand("completion"))
        return guarded([&] { return completionCommand(commandTexts(program), given.shells); });
    if (program.got_subcommand("man")) return guarded([&] { return manCommand(commandTexts(program), given.shells); });
    return guarded([] { return devicesCommand(); });
}

}  // namespace

int commandLine(int argc, const char* const* argv) {
    openText();
    return closedText(played(argc, argv));
}

}  // namespace vkdose
