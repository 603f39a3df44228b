#pragma once
// The parts of the manual that the program knows itself, as Markdown: `vkdose keys`, `vkdose options`. tools/manual
// puts them into the pages, and tests/manual holds the pages against them.

#include <string>

namespace CLI {
class App;
}

namespace vkdose {

/// Every key of a case file, or of a study.
std::string keysPage(bool study);

/// The options of every command; `brief`: a table of the commands, a line each.
std::string optionsPage(const CLI::App& program, bool brief);

}  // namespace vkdose
