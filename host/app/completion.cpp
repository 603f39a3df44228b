#include "host/app/completion.h"

#include <fmt/format.h>

namespace vkdose {

namespace {

/// The things that a value can be completed to.
enum class Offer { Nothing, Words, Folders, Files, Cases, Studies };

Offer offerOf(const OptionText& option) {
    if (!option.words.empty()) return Offer::Words;
    if (option.name == "case" || option.value == "CASE") return Offer::Cases;
    if (option.name == "study") return Offer::Studies;
    if (option.value == "DIR") return Offer::Folders;
    const bool file = option.value.find("FILE") != std::string::npos || option.value.find("DIR") != std::string::npos;
    return file || option.positional ? Offer::Files : Offer::Nothing;
}

std::string joined(const std::vector<std::string>& words, const std::string& between) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : between) + word;
    return text;
}

std::vector<std::string> lastWords(const std::vector<CommandText>& commands) {
    std::vector<std::string> words;
    for (const CommandText& command : commands) words.push_back(lastWord(command.name));
    return words;
}

/// `text` with a backslash before each of `marks`.
std::string escaped(const std::string& text, const std::string& marks) {
    std::string out;
    for (const char c : text) {
        if (marks.find(c) != std::string::npos) out += '\\';
        out += c;
    }
    return out;
}

/// As a word in single quotes, of bash and zsh.
std::string quoted(const std::string& text) {
    std::string out = "'";
    for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return out + "'";
}

// ---- bash ---------------------------------------------------------------------------------------------------------

std::string bashOffer(const OptionText& option) {
    switch (offerOf(option)) {
        case Offer::Words:
            return "_vkdose_words " + quoted(joined(option.words, " "));
        case Offer::Folders:
            return "_vkdose_paths -d";
        case Offer::Files:
            return "_vkdose_paths -f";
        case Offer::Cases:
            return "_vkdose_paths -f case";
        case Offer::Studies:
            return "_vkdose_paths -f study";
        default:
            return ":";
    }
}

constexpr const char* kBashHead = R"_(# Completion of vkdose for bash, printed by `vkdose manual completion bash`:
#     source <(vkdose manual completion bash)
_vkdose_words() {
    mapfile -t COMPREPLY < <(compgen -W "$1" -- "$current")
}
# _vkdose_paths -f|-d [case|study]: files or folders, and the names that vkdose finds cases or studies by.
_vkdose_paths() {
    compopt -o filenames 2> /dev/null
    mapfile -t COMPREPLY < <(
        compgen "$1" -- "$current"
        [ -z "${2-}" ] || compgen -W "$("${COMP_WORDS[0]}" manual completion --names "$2" 2> /dev/null)" -- "$current"
    )
}
_vkdose() {
    local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]}
    COMPREPLY=()
)_";

/// What follows the words of a command.
std::string bashCommand(const CommandText& command, const std::string& margin) {
    std::string text = margin + "case $previous in\n";
    std::string options;
    std::string place = ":";
    for (const OptionText& option : command.options) {
        if (option.positional)
            place = bashOffer(option);
        else
            options += option.name + " ";
        if (!option.positional && !option.value.empty())
            text += fmt::format("{}{}) {}; return ;;\n", margin, option.name, bashOffer(option));
    }
    text += fmt::format("{0}esac\n{0}case $current in\n{0}-*) _vkdose_words {1} ;;\n{0}*) {2} ;;\n{0}esac\n", margin,
                        quoted(options + "--help"), place);
    return text;
}

/// The commands whose word is the `place`-th behind the program's name, and what follows each.
std::string bashCommands(const std::vector<CommandText>& commands, int place) {
    const std::string margin(4 * static_cast<std::size_t>(place), ' ');
    std::string text =
        fmt::format("{0}if [ \"$COMP_CWORD\" -eq {1} ]; then\n{0}    _vkdose_words {2}\n{0}    return\n", margin, place,
                    quoted(joined(lastWords(commands), " ") + (place == 1 ? " --help --version" : " --help")));
    text += fmt::format("{0}fi\n{0}case ${{COMP_WORDS[{1}]}} in\n", margin, place);
    for (const CommandText& command : commands) {
        text += fmt::format("{}{})\n", margin, lastWord(command.name));
        text += command.commands.empty() ? bashCommand(command, margin + "    ")
                                         : bashCommands(command.commands, place + 1);
        text += margin + "    ;;\n";
    }
    return text + margin + "esac\n";
}

}  // namespace

std::string bashCompletion(const std::vector<CommandText>& tree) {
    return kBashHead + bashCommands(tree, 1) + "}\ncomplete -F _vkdose vkdose\n";
}

// ---- zsh ----------------------------------------------------------------------------------------------------------

namespace {

std::string zshOffer(const OptionText& option) {
    switch (offerOf(option)) {
        case Offer::Words:
            return "(" + joined(option.words, " ") + ")";
        case Offer::Folders:
            return "_files -/";
        case Offer::Files:
            return "_files";
        case Offer::Cases:
            return "_vkdose_named case";
        case Offer::Studies:
            return "_vkdose_named study";
        default:
            return " ";
    }
}

/// An argument of _arguments: '--out[output folder]:DIR:_files -/'.
std::string zshArgument(const OptionText& option) {
    const std::string value =
        option.value.empty() ? "" : fmt::format(":{}:{}", escaped(option.value, ":[]\\"), zshOffer(option));
    if (option.positional) return quoted((option.several ? "*" : option.required ? "" : ":") + value);
    return quoted((option.several ? "*" : "") + option.name + "[" + escaped(option.meaning, "[]:\\") + "]" + value);
}

/// The commands whose word comes next, and what follows each.
std::string zshCommands(const std::vector<CommandText>& commands, const std::string& margin) {
    std::string text = margin + "commands=(\n";
    for (const CommandText& command : commands)
        text += fmt::format("{}    {}\n", margin, quoted(lastWord(command.name) + ":" + escaped(command.about, ":\\")));
    text += fmt::format(
        "{0})\n{0}if (( CURRENT == 2 )); then\n{0}    _describe command commands\n{0}    return\n{0}fi\n"
        "{0}command=$words[2]\n{0}shift words\n{0}(( CURRENT -= 1 ))\n{0}case $command in\n",
        margin);
    for (const CommandText& command : commands) {
        text += fmt::format("{}{})\n", margin, lastWord(command.name));
        if (command.commands.empty()) {
            text += margin + "    _arguments '--help[print the options with examples]'";
            for (const OptionText& option : command.options)
                text += " \\\n" + margin + "        " + zshArgument(option);
            text += "\n";
        } else {
            text += zshCommands(command.commands, margin + "    ");
        }
        text += margin + "    ;;\n";
    }
    return text + margin + "esac\n";
}

}  // namespace

std::string zshCompletion(const std::vector<CommandText>& tree) {
    const std::string head = R"_(#compdef vkdose
# Completion of vkdose for zsh, printed by `vkdose manual completion zsh`; put it as _vkdose into a folder of $fpath.
_vkdose_named() {
    local -a named
    named=(${(f)"$($service manual completion --names $1 2> /dev/null)"})
    _alternative "names:$1:compadd -a named" 'files:file:_files'
}
_vkdose() {
    local -a commands
    local command
)_";
    return head + zshCommands(tree, "    ") + "}\n_vkdose \"$@\"\n";
}

// ---- fish ---------------------------------------------------------------------------------------------------------

namespace {

/// As a word in single quotes, of fish.
std::string fishWord(const std::string& text) {
    return "'" + escaped(text, "'\\") + "'";
}

std::string fishOffer(const OptionText& option) {
    switch (offerOf(option)) {
        case Offer::Words:
            return " -xa " + fishWord(joined(option.words, " "));
        case Offer::Folders:
            return " -xa '(__fish_complete_directories)'";
        case Offer::Files:
            return " -rF";
        case Offer::Cases:
            return " -rF -a '(vkdose manual completion --names case)'";
        case Offer::Studies:
            return " -rF -a '(vkdose manual completion --names study)'";
        default:
            return option.value.empty() ? "" : " -x";
    }
}

/// The line's start while `condition` holds.
std::string fishFront(const std::string& condition) {
    return fmt::format("complete -c vkdose -n '{}'", condition);
}

/// The commands whose word comes next where `next` holds, and what follows each. `before` holds behind the words so
/// far.
std::string fishCommands(const std::vector<CommandText>& commands, const std::string& next, const std::string& before) {
    std::string text;
    for (const CommandText& command : commands)
        text += fmt::format("{} -a {} -d {}\n", fishFront(next), lastWord(command.name), fishWord(command.about));
    for (const CommandText& command : commands) {
        const std::string here = before + "__fish_seen_subcommand_from " + lastWord(command.name);
        const std::string words = joined(lastWords(command.commands), " ");
        text +=
            fishCommands(command.commands, here + "; and not __fish_seen_subcommand_from " + words, here + "; and ");
        for (const OptionText& option : command.options) {
            const std::string name = option.positional ? "" : " -l " + option.name.substr(2);
            const std::string meaning = option.positional ? "" : " -d " + fishWord(option.meaning);
            text += fishFront(here) + name + fishOffer(option) + meaning + "\n";
        }
    }
    return text;
}

}  // namespace

std::string fishCompletion(const std::vector<CommandText>& tree) {
    return "# Completion of vkdose for fish, printed by `vkdose manual completion fish`; put it as vkdose.fish into\n"
           "# ~/.config/fish/completions.\ncomplete -c vkdose -f\n" +
           fishFront("__fish_use_subcommand") + " -l version\n" + fishCommands(tree, "__fish_use_subcommand", "");
}

}  // namespace vkdose
