#include "host/app/manual.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <vector>

#include "host/app/command_table.h"
#include "host/core/printable.h"
#include "host/model/case_keys.h"
#include "host/model/powder_file.h"
#include "host/study/output_tables.h"
#include "host/study/study_keys.h"

namespace vkdose {
namespace {

/// `text` with a backslash before each `mark`, which Markdown would take for the end of a cell or the start of a tag.
std::string escaped(const std::string& text, char mark) {
    std::string out;
    for (const char c : text) {
        if (c == mark) out += '\\';
        out += c;
    }
    return out;
}

std::string allowedText(const OptionText& option) {
    std::string words;
    for (const std::string& word : option.words) words += (words.empty() ? "`" : ", `") + word + "`";
    return words.empty() ? option.allowed : words;
}

std::string optionRows(const CommandText& command) {
    std::string rows;
    for (const OptionText& option : command.options) {
        if (option.positional) continue;
        const std::string name = option.name + (option.value.empty() ? "" : " " + option.value);
        rows += fmt::format("| `{}` | {} | {} | {} |\n", escaped(name + (option.several ? " ..." : ""), '|'),
                            escaped(option.meaning, '<'), allowedText(option),
                            option.standard.empty() ? "" : "`" + option.standard + "`");
    }
    return rows;
}

}  // namespace

std::span<const KeyTable> keysOfKind(FileKind kind) {
    switch (kind) {
        case FileKind::Study:
            return studyKeys();
        case FileKind::Powder:
            return powderFileKeys();
        case FileKind::Case:
            break;
    }
    return caseKeys();
}

std::string keysPage(FileKind kind) {
    return keyReference(keysOfKind(kind));
}

std::string optionsPage(const CLI::App& program, bool brief) {
    std::string text = brief ? "| command | what it does |\n| --- | --- |\n" : "";
    for (const CommandText& command : commandTexts(program)) {
        if (brief) {
            text += fmt::format("| `{}` | {} |\n", escaped(command.usage, '|'), command.about);
            continue;
        }
        text += fmt::format("{}### `{}`\n\n", text.empty() ? "" : "\n", command.usage);
        std::string sentence = command.about;
        sentence[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(sentence[0])));
        text += sentence + ".\n";
        const std::string rows = optionRows(command);
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

std::string usageFault(const CLI::App& program, const std::string& problem, const std::vector<std::string>& words) {
    const std::vector<CommandText> tree = commandTree(program);
    const std::vector<CommandText>* known = &tree;
    std::string command = "vkdose";
    for (const std::string& word : words) {
        if (known->empty() || word.rfind('-', 0) == 0) break;
        const auto found = std::find_if(known->begin(), known->end(),
                                        [&word](const CommandText& text) { return lastWord(text.name) == word; });
        if (found == known->end())
            return fmt::format("{}: there is no command {}; {}\nRun `{} --help` for the commands.\n", command,
                               word.empty() ? "\"\"" : printable(word), meantCommand(word, tree), command);
        known = &found->commands;
        command = "vkdose " + found->name;
    }
    return fmt::format("{}: {}\nRun `{} --help`.\n", command, printableLines(problem), command);
}

}  // namespace vkdose
