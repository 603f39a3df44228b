#pragma once
// The commands and options of the program as texts: the manual, the man pages and the completion of the shells are made
// from these, which come from the declarations in command_options.cpp.

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
    std::string name;
    std::string about;
    std::string usage;                ///< "vkdose run CASE"
    std::vector<OptionText> options;  ///< those by their place first; --help is left out
};

/// Every command in the order of --help. What the program gives itself alone is left out.
std::vector<CommandText> commandTexts(const CLI::App& program);

}  // namespace vkdose
