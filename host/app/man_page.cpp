#include "host/app/man_page.h"

#include <fmt/format.h>

#include <algorithm>

#include "host/app/help.h"

namespace vkdose {

namespace {

/// Text for troff: no character of it is a command, and a hyphen stays one that can be copied.
std::string roff(const std::string& text) {
    std::string out;
    bool begins = true;
    for (const char c : text) {
        if (begins && (c == '.' || c == '\'')) out += "\\&";
        if (c == '\\')
            out += "\\e";
        else if (c == '-')
            out += "\\-";
        else
            out += c;
        begins = c == '\n';
    }
    return out;
}

std::string upper(std::string text) {
    for (char& c : text)
        if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
    return text;
}

std::string sentence(std::string text) {
    if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 'a' + 'A');
    return text + ".";
}

std::string head(const std::string& name, const std::string& about) {
    return fmt::format(".TH {} 1 \"\" \"vkdose {}\" \"vkdose manual\"\n.SH NAME\n{} \\- {}\n", upper(roff(name)),
                       VKDOSE_VERSION, roff(name), roff(about));
}

std::string optionEntry(const OptionText& option) {
    std::string text = fmt::format(".TP\n\\fB{}\\fR", roff(option.name));
    if (!option.value.empty()) text += fmt::format(" \\fI{}\\fR", roff(option.value));
    text += fmt::format("\n{}\n", roff(sentence(option.meaning)));
    std::string words;
    for (const std::string& word : option.words) words += (words.empty() ? "" : ", ") + word;
    if (!words.empty()) text += fmt::format("One of {}.\n", roff(words));
    if (!option.allowed.empty()) text += fmt::format("Allowed: {}.\n", roff(option.allowed));
    if (!option.standard.empty()) text += fmt::format("Default: {}.\n", roff(option.standard));
    if (option.several) text += "May be given several times.\n";
    return text;
}

std::string exampleLines(const std::vector<std::string>& lines) {
    std::string text = ".SH EXAMPLES\n.nf\n";
    for (const std::string& line : lines) text += roff(line) + "\n";
    return text + ".fi\n";
}

}  // namespace

std::string manPage(const std::vector<CommandText>& commands) {
    std::string text = head("vkdose", "simulate the dosing of cohesive powder by a turning coil");
    text += ".SH SYNOPSIS\n\\fBvkdose\\fR \\fICOMMAND\\fR [options]\n.SH COMMANDS\n";
    for (const CommandText& command : commands)
        text += fmt::format(".TP\n\\fB{}\\fR\n{}\nSee \\fB{}\\fR(1).\n", roff(command.usage),
                            roff(sentence(command.about)), roff(manName(command)));
    return text + exampleLines({"vkdose run quickstart", "vkdose report out/quickstart", "vkdose new my.toml"});
}

std::string manName(const CommandText& command) {
    std::string name = "vkdose-" + command.name;
    std::replace(name.begin(), name.end(), ' ', '-');
    return name;
}

std::string manPage(const CommandText& command) {
    std::string text = head(manName(command), command.about);
    text += fmt::format(".SH SYNOPSIS\n\\fB{}\\fR [options]\n.SH DESCRIPTION\n{}\n", roff(command.usage),
                        roff(sentence(command.about)));
    for (const bool positional : {true, false}) {
        std::string entries;
        for (const OptionText& option : command.options)
            if (option.positional == positional) entries += optionEntry(option);
        if (!entries.empty()) text += (positional ? ".SH ARGUMENTS\n" : ".SH OPTIONS\n") + entries;
    }
    text += exampleLines(examplesOf(command.name));
    return text + ".SH SEE ALSO\n\\fBvkdose\\fR(1)\n";
}

}  // namespace vkdose
