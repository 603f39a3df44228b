#pragma once
// The commands of the program, from its own list.

#include <cctype>
#include <sstream>
#include <string>
#include <vector>

#include "tests/app/sandbox.h"

namespace vkdose::test {

/// "run", "test verify": the words in small letters of each usage.
inline std::vector<std::string> commandsOf(const Sandbox& box) {
    std::vector<std::string> names;
    std::istringstream list(box.vkdose("manual options --brief").out);
    for (std::string line; std::getline(list, line);) {
        const std::size_t at = line.find("`vkdose ");
        if (at == std::string::npos) continue;
        std::istringstream words(line.substr(at + 8, line.find('`', at + 1) - at - 8));
        std::string name;
        for (std::string word; words >> word && std::islower(static_cast<unsigned char>(word[0])) != 0;)
            name += (name.empty() ? "" : " ") + word;
        names.push_back(name);
    }
    return names;
}

}  // namespace vkdose::test
