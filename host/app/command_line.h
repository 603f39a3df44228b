#pragma once

namespace vkdose {

/// Parses the command line, runs the command and turns every error into one line on stderr and an exit code.
int commandLine(int argc, const char* const* argv);

}  // namespace vkdose
