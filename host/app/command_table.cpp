#include "host/app/command_table.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <map>
#include <sstream>

#include "host/core/closest_word.h"

namespace vkdose {

namespace {

std::string upper(std::string text) {
    for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return text;
}

/// The words of "free|easy|cohesive". Empty for "DIR|STUDY", which are kinds of things.
std::vector<std::string> wordsIn(const std::string& value) {
    const bool words = value.find('|') != std::string::npos &&
                       std::all_of(value.begin(), value.end(), [](char c) { return c == '|' || std::islower(c) != 0; });
    std::vector<std::string> list;
    std::istringstream stream(words ? value : "");
    for (std::string word; std::getline(stream, word, '|');) list.push_back(word);
    return list;
}

/// A check's text as people write it: "INT in [1 - 16]" is 1 to 16. "{dark,light}" become the words.
void readCheck(OptionText& option, std::string text) {
    const std::size_t range = text.find(" in [");
    if (text == "POSITIVE") {
        option.allowed = "> 0";
    } else if (text == "NONNEGATIVE") {
        option.allowed = "≥ 0";
    } else if (range != std::string::npos) {
        text = text.substr(range + 5, text.size() - range - 6);
        option.allowed = text.replace(text.find(" - "), 3, " to ");
    } else if (text.size() >= 2 && text.front() == '{') {
        std::istringstream words(text.substr(1, text.size() - 2));
        for (std::string word; std::getline(words, word, ',');) option.words.push_back(word);
    } else {
        option.allowed = text;
    }
}

OptionText textOf(const CLI::Option& option) {
    OptionText text;
    text.positional = !option.nonpositional();
    text.required = option.get_required();
    text.name = text.positional ? option.get_name(true) : "--" + option.get_lnames().front();
    // "FLOAT:POSITIVE" is a type and the name of a check.
    const std::string type = option.get_type_name();
    const std::size_t colon = type.find(':');
    if (option.get_items_expected_max() > 0) text.value = type.substr(0, colon);
    text.words = wordsIn(text.value);
    if (!text.words.empty()) text.value = "KIND";
    if (colon != std::string::npos) readCheck(text, type.substr(colon + 1));
    text.meaning = option.get_description();
    text.standard = option.get_default_str();
    text.several = option.get_items_expected_max() > 1 && text.value.find(',') == std::string::npos;
    return text;
}

/// Options that people use: not those that the program gives itself, which are in no group, and not --help.
std::vector<const CLI::Option*> shownOptions(const CLI::App& command, bool positional) {
    return command.get_options([positional](const CLI::Option* option) {
        return !option->get_group().empty() && option->nonpositional() != positional && !option->check_lname("help");
    });
}

std::string usageOf(const CommandText& command) {
    std::string text = "vkdose " + command.name;
    for (const OptionText& option : command.options) {
        if (!option.positional) continue;
        const bool named =
            option.value.find('|') != std::string::npos || option.value == "DIR" || option.value == "FILE";
        const std::string word = (named ? option.value : upper(option.name)) + (option.several ? " ..." : "");
        text += option.required ? " " + word : " [" + word + "]";
    }
    return text;
}

std::vector<CommandText> textsUnder(const CLI::App& app, const std::string& prefix) {
    std::vector<CommandText> all;
    for (const CLI::App* sub : app.get_subcommands([](const CLI::App*) { return true; })) {
        CommandText command{prefix + sub->get_name(), sub->get_description(), "", {}, {}};
        for (const bool positional : {true, false})
            for (const CLI::Option* option : shownOptions(*sub, positional)) command.options.push_back(textOf(*option));
        command.usage = usageOf(command);
        command.commands = textsUnder(*sub, command.name + " ");
        all.push_back(std::move(command));
    }
    return all;
}

/// Every name in `tree` by its last word.
void addNames(const std::vector<CommandText>& tree, std::map<std::string, std::string>& names) {
    for (const CommandText& command : tree) {
        names[lastWord(command.name)] = command.name;
        addNames(command.commands, names);
    }
}

}  // namespace

std::vector<CommandText> commandTree(const CLI::App& program) {
    return textsUnder(program, "");
}

std::vector<CommandText> commandTexts(const CLI::App& program) {
    std::vector<CommandText> all;
    for (const CommandText& command : commandTree(program)) {
        if (command.commands.empty()) all.push_back(command);
        all.insert(all.end(), command.commands.begin(), command.commands.end());
    }
    return all;
}

std::string lastWord(const std::string& name) {
    return name.substr(name.rfind(' ') + 1);  // npos + 1 is 0
}

std::string meantCommand(const std::string& word, const std::vector<CommandText>& tree) {
    std::map<std::string, std::string> names;
    addNames(tree, names);
    std::vector<std::string> words;
    for (const auto& [last, name] : names) words.push_back(last);
    const std::string meant = closestWord(word, words);
    return meant.empty() ? "see `vkdose manual options --brief`" : "did you mean " + names[meant] + "?";
}

}  // namespace vkdose
