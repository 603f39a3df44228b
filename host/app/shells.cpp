// The commands that print what shells and man(1) read.
#include <fmt/format.h>

#include "host/app/commands.h"
#include "host/app/completion.h"
#include "host/app/exit_code.h"
#include "host/app/find_case.h"
#include "host/app/man_page.h"
#include "host/app/tell.h"
#include "host/core/file.h"
#include "host/core/printable.h"
#include "host/model/closest_word.h"

namespace vkdose {

int completionCommand(const std::vector<CommandText>& commands, const ShellOptions& options) {
    std::string text;
    if (!options.names.empty())
        for (const std::string& name : namesOfCases(options.names == "study")) text += name + "\n";
    else if (options.shell.empty())
        throw UsageError("completion: name the shell: bash, zsh or fish");
    else
        text = (options.shell == "bash"  ? bashCompletion
                : options.shell == "zsh" ? zshCompletion
                                         : fishCompletion)(commands);
    tell("{}", text);
    return kOk;
}

int manCommand(const std::vector<CommandText>& commands, const ShellOptions& options) {
    if (!options.out.empty()) {
        createFolder(options.out);
        replaceFile(options.out / "vkdose.1", manPage(commands));
        for (const CommandText& command : commands)
            replaceFile(options.out / ("vkdose-" + command.name + ".1"), manPage(command));
        tell("{}\n", printable(options.out.string()));
        return kOk;
    }
    if (options.command.empty()) {
        tell("{}", manPage(commands));
        return kOk;
    }
    std::vector<std::string> names;
    for (const CommandText& command : commands) {
        names.push_back(command.name);
        if (command.name != options.command) continue;
        tell("{}", manPage(command));
        return kOk;
    }
    const std::string meant = closestWord(options.command, names);
    throw UsageError(fmt::format("man: there is no command {}{}", printable(options.command),
                                 meant.empty() ? "; `vkdose --help` lists them" : "; did you mean " + meant + "?"));
}

}  // namespace vkdose
