#pragma once
// The commands and options of the program: what can be given, and where the values go.

#include "host/app/commands.h"
#include "host/app/validate.h"

namespace CLI {
class App;
}

namespace vkdose {

/// Of the commands that print parts of the manual.
struct ManualOptions {
    bool study = false;
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
    SweepOptions calibration;
    ValidateOptions validation;
    ReportOptions report;
    ProfileOptions profile;
    RenderOptions render;
    ManualOptions manual;
    ShellOptions shells;
};

/// Declares every command in the order of --help. Parsing sets `options`, which must outlive the program.
void declareCommands(CLI::App& program, Options& options);

}  // namespace vkdose
