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

std::string names(const std::vector<CommandText>& commands) {
    std::string text;
    for (const CommandText& command : commands) text += (text.empty() ? "" : " ") + command.name;
    return text;
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

constexpr const char* kBashHead = R"_(# Completion of vkdose for bash, printed by `vkdose completion bash`:
#     source <(vkdose completion bash)
_vkdose_words() {
    mapfile -t COMPREPLY < <(compgen -W "$1" -- "$current")
}
# _vkdose_paths -f|-d [case|study]: files or folders, and the names that vkdose finds cases or studies by.
_vkdose_paths() {
    compopt -o filenames 2> /dev/null
    mapfile -t COMPREPLY < <(
        compgen "$1" -- "$current"
        [ -z "${2-}" ] || compgen -W "$("${COMP_WORDS[0]}" completion --names "$2" 2> /dev/null)" -- "$current"
    )
}
_vkdose() {
    local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]} command=${COMP_WORDS[1]}
    COMPREPLY=()
    if [ "$COMP_CWORD" -eq 1 ]; then
)_";

}  // namespace

std::string bashCompletion(const std::vector<CommandText>& commands) {
    std::string text = kBashHead;
    text += fmt::format("        _vkdose_words {}\n        return\n    fi\n    case \"$command $previous\" in\n",
                        quoted(names(commands) + " --help --version"));
    for (const CommandText& command : commands)
        for (const OptionText& option : command.options)
            if (!option.positional && !option.value.empty())
                text += fmt::format("    \"{} {}\") {}; return ;;\n", command.name, option.name, bashOffer(option));
    text += "    esac\n    case $command in\n";
    for (const CommandText& command : commands) {
        std::string options;
        std::string place = ":";
        for (const OptionText& option : command.options) {
            if (option.positional)
                place = bashOffer(option);
            else
                options += option.name + " ";
        }
        text += fmt::format(
            "    {})\n        case $current in\n        -*) _vkdose_words {} ;;\n        *) {} ;;\n        "
            "esac\n        ;;\n",
            command.name, quoted(options + "--help"), place);
    }
    return text + "    esac\n}\ncomplete -F _vkdose vkdose\n";
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

}  // namespace

std::string zshCompletion(const std::vector<CommandText>& commands) {
    std::string text = R"_(#compdef vkdose
# Completion of vkdose for zsh, printed by `vkdose completion zsh`; put it as _vkdose into a folder of $fpath.
_vkdose_named() {
    local -a named
    named=(${(f)"$($service completion --names $1 2> /dev/null)"})
    _alternative "names:$1:compadd -a named" 'files:file:_files'
}
_vkdose() {
    local -a commands
    commands=(
)_";
    for (const CommandText& command : commands)
        text += fmt::format("        {}\n", quoted(command.name + ":" + escaped(command.about, ":\\")));
    text +=
        "    )\n    if (( CURRENT == 2 )); then\n        _describe command commands\n        return\n    fi\n"
        "    local command=$words[2]\n    shift words\n    (( CURRENT -= 1 ))\n    case $command in\n";
    for (const CommandText& command : commands) {
        text += fmt::format("    {})\n        _arguments '--help[print the options with examples]'", command.name);
        for (const OptionText& option : command.options) text += " \\\n            " + zshArgument(option);
        text += "\n        ;;\n";
    }
    return text + "    esac\n}\n_vkdose \"$@\"\n";
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
            return " -rF -a '(vkdose completion --names case)'";
        case Offer::Studies:
            return " -rF -a '(vkdose completion --names study)'";
        default:
            return option.value.empty() ? "" : " -x";
    }
}

}  // namespace

std::string fishCompletion(const std::vector<CommandText>& commands) {
    std::string text =
        "# Completion of vkdose for fish, printed by `vkdose completion fish`; put it as vkdose.fish into\n"
        "# ~/.config/fish/completions.\ncomplete -c vkdose -f\ncomplete -c vkdose -n __fish_use_subcommand -l "
        "version\n";
    for (const CommandText& command : commands)
        text += fmt::format("complete -c vkdose -n __fish_use_subcommand -a {} -d {}\n", command.name,
                            fishWord(command.about));
    for (const CommandText& command : commands) {
        const std::string front = fmt::format("complete -c vkdose -n '__fish_seen_subcommand_from {}'", command.name);
        for (const OptionText& option : command.options) {
            const std::string name = option.positional ? "" : " -l " + option.name.substr(2);
            const std::string meaning = option.positional ? "" : " -d " + fishWord(option.meaning);
            const std::string offer = fishOffer(option);
            text += front + name + offer + meaning + "\n";
        }
    }
    return text;
}

}  // namespace vkdose
