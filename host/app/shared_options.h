#pragma once
// Options that several commands have.

#include <optional>
#include <string>
#include <vector>

#include "host/app/commands.h"
#include "host/app/find_case.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace vkdose {

/// A command that has commands of its own.
CLI::App& addGroup(CLI::App& program, const char* name, const char* about);

/// Finds the powder of a case that is named, and makes it an override, the first.
void usePowder(CaseOptions& input);

/// The options with the files of a case and of a powder that may have been given by their names.
template <class Command>
const Command& named(Command& options) {
    options.input.file = findCase(options.input.file);
    usePowder(options.input);
    return options;
}

/// The same for a study.
inline const SweepOptions& studied(SweepOptions& options) {
    options.study = findCase(options.study);
    return options;
}

/// --set, whose help is `what`.
void addSet(CLI::App& command, std::vector<std::string>& overrides, const char* what);

/// The case, which must be given unless the option that is returned is told otherwise, and --set.
CLI::Option& addCase(CLI::App& command, CaseOptions& input);

void addDevice(CLI::App& command, BackendChoice& backend);

/// --backend and the options of the device.
void addBackend(CLI::App& command, BackendChoice& backend);

/// For the program itself, which runs the members of a sweep as processes of its own.
void addParent(CLI::App& command, int& parent);

void addShow(CLI::App& command, bool& quiet, bool& live, bool& events, bool& orders);

/// --for, of commands that run members.
CLI::Option* addFor(CLI::App& command, std::optional<TimeLimit>& limit);

/// How members run. Returns the options.
std::vector<CLI::Option*> addMemberOptions(CLI::App& command, MemberOptions& options);

CLI::Option& addAssume(CLI::App& command, bool& assume);

}  // namespace vkdose
