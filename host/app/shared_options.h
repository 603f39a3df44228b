#pragma once
// Options that several commands have.

#include <optional>
#include <string>
#include <vector>

#include "host/app/commands.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace vkdose {

/// --set, whose help is `what`.
void addSet(CLI::App& command, std::vector<std::string>& overrides, const char* what);

/// The case, which must be given unless the option that is returned is told otherwise, and --set.
CLI::Option& addCase(CLI::App& command, CaseOptions& input);

void addDevice(CLI::App& command, BackendChoice& backend);

/// --backend and the options of the device.
void addBackend(CLI::App& command, BackendChoice& backend);

/// For the program itself, which runs the members of a sweep as processes of its own.
void addParent(CLI::App& command, int& parent);

void addShow(CLI::App& command, bool& quiet, bool& live, bool& events);

/// --for, of commands that run members.
void addFor(CLI::App& command, std::optional<TimeLimit>& limit);

CLI::Option& addAssume(CLI::App& command, bool& assume);

}  // namespace vkdose
