#pragma once
// The parts of the manual that the program knows itself, as Markdown: `vkdose manual keys`,
// `columns`, `options`. tools/manual
// puts them into the pages, and tests/manual holds the pages against them.

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace vkdose {

/// Every key of a case file, or of a study.
std::string keysPage(bool study);

/// Every column of the tables that a run leaves, or a sweep.
std::string columnsPage(bool sweep);

/// The options of every command; `brief`: a table of the commands, a line each.
std::string optionsPage(const CLI::App& program, bool brief);

/// The lines that report a fault of the command line and say where to read on. `problem` is the message of the parser,
/// `words` those after the program's name.
std::string usageFault(const CLI::App& program, const std::string& problem, const std::vector<std::string>& words);

}  // namespace vkdose
