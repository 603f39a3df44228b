#include "host/app/command_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

#include "host/app/command_options.h"
#include "host/app/exit_code.h"
#include "host/app/help.h"
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
    const std::vector<Command> commands = declareCommands(program, given);
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
        tell(stderr, "{}", usageFault(program, e.what(), {argv + 1, argv + argc}));
        return kBadInput;
    }
    const auto asked = std::find_if(commands.begin(), commands.end(), [](const Command& c) { return c.app->parsed(); });
    return guarded(asked->run);
}

}  // namespace

int commandLine(int argc, const char* const* argv) {
    openText();
    return closedText(played(argc, argv));
}

}  // namespace vkdose
