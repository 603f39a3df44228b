#pragma once
// Texts of help beside the options: examples of every command, and the overview that `vkdose` alone prints.

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace vkdose {

/// Command lines that can be typed, with a comment behind "#"; none for an unknown command.
std::vector<std::string> examplesOf(const std::string& command);

/// Puts the examples under the help of every command of the program, or of a `group`: "test ".
void addExamples(CLI::App& app, const std::string& group = "");

/// The first commands of a new user, and all others in a line each.
std::string overview(const CLI::App& program);

}  // namespace vkdose
