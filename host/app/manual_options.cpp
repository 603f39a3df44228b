// The commands of the group `manual`.
#include <CLI/CLI.hpp>
#include <string>

#include "host/app/command_options.h"
#include "host/app/exit_code.h"
#include "host/app/key_schema.h"
#include "host/app/manual.h"
#include "host/app/shared_options.h"
#include "host/app/tell.h"

namespace vkdose {

namespace {

CLI::App& addKeys(CLI::App& group, ManualOptions& options) {
    CLI::App& command = *group.add_subcommand("keys", "list every key of a case file: unit, default, bounds, meaning");
    auto* study = command.add_flag("--study", options.study, "list the keys of a study file instead");
    command.add_flag("--powder", options.powder, "list the keys of a powder file instead")->excludes(study);
    command.add_flag("--schema", options.schema,
                     "print them as a JSON Schema, by which an editor completes and checks");
    return command;
}

CLI::App& addColumns(CLI::App& group, ManualOptions& options) {
    CLI::App& command = *group.add_subcommand("columns", "list every column of the files that a run leaves");
    command.add_flag("--sweep", options.sweep, "list the columns of a sweep's tables instead");
    return command;
}

CLI::App& addOptions(CLI::App& group, ManualOptions& options) {
    CLI::App& command = *group.add_subcommand("options", "list every command with its options");
    command.add_flag("--brief", options.brief, "list the commands alone, a line each");
    return command;
}

CLI::App& addMan(CLI::App& group, ShellOptions& options) {
    CLI::App& command = *group.add_subcommand("man", "print the page for man(1), of vkdose or of a command");
    command.add_option("command", options.command, "a command of vkdose; without one the page that lists them")
        ->expected(1, 2);
    command.add_option("--out", options.out, "folder to write all the pages into, vkdose.1 and one for each command")
        ->type_name("DIR");
    return command;
}

CLI::App& addCompletion(CLI::App& group, ShellOptions& options) {
    CLI::App& command = *group.add_subcommand("completion", "print the completion of the command line for a shell");
    command.add_option("shell", options.shell, "the shell")->check(CLI::IsMember({"bash", "zsh", "fish"}));
    command.add_option("--names", options.names, "print the names of what can be given")
        ->check(CLI::IsMember({"case", "study"}))
        ->group("");
    return command;
}

int printed(const std::string& page) {
    say(stdout, page);
    return kOk;
}

}  // namespace

std::vector<Command> declareManual(CLI::App& program, Options& o) {
    CLI::App& manual = addGroup(program, "manual", "print what vkdose knows of its files and commands");
    const auto keys = [&o] {
        const FileKind kind = o.manual.study ? FileKind::Study : o.manual.powder ? FileKind::Powder : FileKind::Case;
        return printed(o.manual.schema ? keySchema(kind) : keysPage(kind));
    };
    const auto options = [&] { return printed(optionsPage(program, o.manual.brief)); };
    return {
        {&addKeys(manual, o.manual), keys},
        {&addColumns(manual, o.manual), [&o] { return printed(columnsPage(o.manual.sweep)); }},
        {&addOptions(manual, o.manual), options},
        {&addMan(manual, o.shells), [&] { return manCommand(commandTexts(program), o.shells); }},
        {&addCompletion(manual, o.shells), [&] { return completionCommand(commandTree(program), o.shells); }},
    };
}

}  // namespace vkdose
