#include "host/app/manual.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <vector>

#include "host/core/printable.h"
#include "host/model/case_keys.h"
#include "host/model/case_reader.h"
#include "host/study/output_tables.h"
#include "host/study/study_keys.h"

namespace vkdose {
namespace {

std::string upper(std::string text) {
    for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return text;
}

/// The type alone: "FLOAT:POSITIVE" is a type and the name of a check.
std::string typeName(const CLI::Option& option) {
    const std::string all = option.get_type_name();
    return all.substr(0, all.find(':'));
}

/// A check's text as people write it: "INT in [1 - 16]" is 1 to 16, "{dark,light}" the words.
std::string allowedText(const CLI::Option& option) {
    const std::string all = option.get_type_name();
    const std::size_t colon = all.find(':');
    if (colon == std::string::npos) return "";
    std::string text = all.substr(colon + 1);
    if (text == "POSITIVE") return "> 0";
    if (text == "NONNEGATIVE") return "≥ 0";
    const std::size_t range = text.find(" in [");
    if (range != std::string::npos) {
        text = text.substr(range + 5, text.size() - range - 6);
        return text.replace(text.find(" - "), 3, " to ");
    }
    if (text.size() < 2 || text.front() != '{') return text;
    std::string words;
    for (const char c : text.substr(1, text.size() - 2)) words += c == ',' ? std::string("`, `") : std::string(1, c);
    return "`" + words + "`";
}

/// Options that people use: not those that the program gives itself, which are in no group, and not --help.
std::vector<const CLI::Option*> shownOptions(const CLI::App& command, bool positional) {
    return command.get_options([positional](const CLI::Option* option) {
        return !option->get_group().empty() && option->nonpositional() != positional && !option->check_lname("help");
    });
}

std::string usage(const CLI::App& command) {
    std::string text = "vkdose " + command.get_name();
    for (const CLI::Option* option : shownOptions(command, true)) {
        const std::string type = typeName(*option);
        const bool named = type.find('|') != std::string::npos || type == "DIR" || type == "FILE";
        text += " " + (named ? type : upper(option->get_name(true)));
    }
    return text;
}

/// `text` with a backslash before each `mark`, which Markdown would take for the end of a cell or the start of a tag.
std::string escaped(const std::string& text, char mark) {
    std::string out;
    for (const char c : text) {
        if (c == mark) out += '\\';
        out += c;
    }
    return out;
}

std::string optionRows(const CLI::App& command) {
    std::string rows;
    for (const CLI::Option* option : shownOptions(command, false)) {
        std::string name = "--" + option->get_lnames().front();
        const std::string type = option->get_items_expected_max() == 0 ? "" : typeName(*option);
        if (!type.empty()) name += " " + type;
        if (option->get_items_expected_max() > 1 && type.find(',') == std::string::npos) name += " ...";
        const std::string standard = option->get_default_str();
        rows += fmt::format("| `{}` | {} | {} | {} |\n", escaped(name, '|'), escaped(option->get_description(), '<'),
                            allowedText(*option), standard.empty() ? "" : "`" + standard + "`");
    }
    return rows;
}

std::vector<const CLI::App*> commandsOf(const CLI::App& program) {
    return program.get_subcommands([](const CLI::App*) { return true; });
}

}  // namespace

std::string keysPage(bool study) {
    return keyReference(study ? studyKeys() : caseKeys());
}

std::string optionsPage(const CLI::App& program, bool brief) {
    std::string text = brief ? "| command | what it does |\n| --- | --- |\n" : "";
    for (const CLI::App* command : commandsOf(program)) {
        if (brief) {
            text += fmt::format("| `{}` | {} |\n", escaped(usage(*command), '|'), command->get_description());
            continue;
        }
        text += fmt::format("{}### `{}`\n\n", text.empty() ? "" : "\n", usage(*command));
        std::string sentence = command->get_description();
        sentence[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(sentence[0])));
        text += sentence + ".\n";
        const std::string rows = optionRows(*command);
        if (!rows.empty()) text += "\n| option | meaning | allowed | default |\n| --- | --- | --- | --- |\n" + rows;
    }
    return text;
}

std::string columnsPage(bool sweep) {
    const std::vector<OutputTable> all = outputTables();
    const auto ofRun = static_cast<std::ptrdiff_t>(runTables().size());
    const std::vector<OutputTable> tables(sweep ? all.begin() + ofRun : all.begin(),
                                          sweep ? all.end() : all.begin() + ofRun);
    std::string text;
    for (const OutputTable& table : tables) {
        const std::size_t comma = table.file.find(',');  // "doses.csv, of a sweep"
        text += fmt::format("{}### `{}`{}\n\n{}\n\n", text.empty() ? "" : "\n", table.file.substr(0, comma),
                            comma == std::string::npos ? "" : table.file.substr(comma), table.about);
        text += "| column | unit | meaning |\n| --- | --- | --- |\n";
        for (const ColumnText& c : table.columns)
            text += fmt::format("| `{}` | {} | {} |\n", c.name, c.unit == "1" ? "" : c.unit, c.meaning);
    }
    return text;
}

std::string usageFault(const CLI::App& program, const std::string& problem, const std::string& first) {
    if (first.empty()) return "vkdose: give a command\nRun `vkdose --help` for the commands.\n";
    std::vector<std::string> names;
    for (const CLI::App* command : commandsOf(program)) names.push_back(command->get_name());
    const bool known = std::find(names.begin(), names.end(), first) != names.end();
    if (!known && first.front() != '-') {
        const std::string meant = closestWord(first, names);
        return fmt::format("vkdose: there is no command {}; {}\nRun `vkdose --help` for the commands.\n",
                           printable(first), meant.empty() ? "see the list" : fmt::format("did you mean {}?", meant));
    }
    const std::string name = known ? "vkdose " + first : "vkdose";
    return fmt::format("{}: {}\nRun `{} --help`.\n", name, printableLines(problem), name);
}

}  // namespace vkdose
