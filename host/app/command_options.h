#pragma once
// The commands and options of the program: what can be given, and where the values go.

#include <functional>
#include <vector>

#include "host/app/commands.h"
#include "host/app/validate.h"

namespace CLI {
class App;
}

namespace vkdose {

/// Of the commands that print keys, columns and options.
struct ManualOptions {
    bool study = false;
    bool powder = false;
    bool schema = false;
    bool sweep = false;
    bool brief = false;
};

/// What was given to each command.
struct Options {
    NewOptions made;
    RunOptions run;
    ResumeOptions resume;
    CheckOptions check;
    CompareOptions compare;
    VerifyOptions verification;
    BenchOptions bench;
    ExportBodyOptions exportBody;
    SweepOptions sweep;
    SweepOptions calibration, design;
    ScaleOptions scale;
    PowdersOptions powders;
    StudioOptions studio;
    ValidateOptions validation;
    ReportOptions report;
    ProfileOptions profile;
    RenderOptions render;
    ManualOptions manual;
    ShellOptions shells;
};

/// Where a command is declared, and what it does.
struct Command {
    const CLI::App* app;
    std::function<int()> run;
};

/// Declares every command in the order of --help. Parsing sets `options`. These and the program must outlive the
/// commands.
std::vector<Command> declareCommands(CLI::App& program, Options& options);

/// Those that run members, and those of the groups `manual` and `test`.
std::vector<Command> declareStudies(CLI::App& program, Options& options);
std::vector<Command> declareManual(CLI::App& program, Options& options);
std::vector<Command> declareTests(CLI::App& program, Options& options);

}  // namespace vkdose
