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

namespace vkdose {

int completionCommand(const std::vector<CommandText>& tree, const ShellOptions& options) {
    std::string text;
    if (!options.names.empty())
        for (const std::string& name : namesOfCases(options.names == "study")) text += name + "\n";
    else if (options.shell.empty())
        throw UsageError("completion: name the shell: bash, zsh or fish");
    else
        text = (options.shell == "bash"  ? bashCompletion
                : options.shell == "zsh" ? zshCompletion
                                         : fishCompletion)(tree);
    tell("{}", text);
    return kOk;
}

int manCommand(const std::vector<CommandText>& commands, const ShellOptions& options) {
    if (!options.out.empty()) {
        createFolder(options.out);
        replaceFile(options.out / "vkdose.1", manPage(commands));
        for (const CommandText& command : commands)
            replaceFile(options.out / (manName(command) + ".1"), manPage(command));
        tell("{}\n", printable(options.out.string()));
        return kOk;
    }
    if (options.command.empty()) {
        tell("{}", manPage(commands));
        return kOk;
    }
    std::string name;
    for (const std::string& word : options.command) name += (name.empty() ? "" : " ") + word;
    for (const CommandText& command : commands) {
        if (command.name != name) continue;
        tell("{}", manPage(command));
        return kOk;
    }
    throw UsageError(fmt::format("man: there is no command {}; {}", printable(name),
                                 meantCommand(options.command.back(), commands)));
}

}  // namespace vkdose
