#pragma once
// The parts of the manual that the program knows itself, as Markdown: `vkdose manual keys`,
// `columns`, `options`. tools/manual
// puts them into the pages, and tests/manual holds the pages against them.

#include <span>
#include <string>
#include <vector>

#include "host/core/key.h"

namespace CLI {
class App;
}

namespace vkdose {

/// The kinds of files that people write.
enum class FileKind { Case, Study, Powder };

/// Every key of a file of this kind.
std::span<const KeyTable> keysOfKind(FileKind kind);
std::string keysPage(FileKind kind);

/// Every column of the tables that a run leaves, or a sweep.
std::string columnsPage(bool sweep);

/// The options of every command; `brief`: a table of the commands, a line each.
std::string optionsPage(const CLI::App& program, bool brief);

/// The lines that report a fault of the command line and say where to read on. `problem` is the message of the parser,
/// `words` those after the program's name.
std::string usageFault(const CLI::App& program, const std::string& problem, const std::vector<std::string>& words);

}  // namespace vkdose
