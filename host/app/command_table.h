#pragma once
// The commands and options of the program as texts: the manual, the man pages and the completion of the shells are made
// from these, which come from the declarations in command_options.h.

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace vkdose {

struct OptionText {
    std::string name;   ///< "--out"; of an argument by its place "case"
    std::string value;  ///< "DIR"; empty for a flag
    std::string meaning;
    std::vector<std::string> words;  ///< if it is one of these
    std::string allowed;             ///< otherwise: "1 to 16", "> 0"; may be empty
    std::string standard;            ///< empty: none, or told in the meaning
    bool several = false;            ///< may be given more than once, or with several values
    bool positional = false;
    bool required = false;
};

struct CommandText {
    std::string name;  ///< "run"; of a command in a group "test verify"
    std::string about;
    std::string usage;                  ///< "vkdose run CASE"
    std::vector<OptionText> options;    ///< those by their place first; --help is left out
    std::vector<CommandText> commands;  ///< of a group, which does nothing itself
};

/// Commands and groups in the order of --help. What the program gives itself alone is left out.
std::vector<CommandText> commandTree(const CLI::App& program);

/// The commands that do something, those of the groups too.
std::vector<CommandText> commandTexts(const CLI::App& program);

/// "verify" of "test verify".
std::string lastWord(const std::string& name);

/// "did you mean test verify?" for a command `word` that is not there; if none is like it, where all are
/// listed.
std::string meantCommand(const std::string& word, const std::vector<CommandText>& tree);

}  // namespace vkdose
