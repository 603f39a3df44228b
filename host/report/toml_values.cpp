#include "host/report/toml_values.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "host/core/csv_table.h"
#include "host/core/error.h"
#include "host/core/file.h"

namespace vkdose::report {

namespace {

void collect(const toml::table& table, const std::string& prefix, std::map<std::string, Setting>& settings) {
    for (const auto& [name, node] : table) {
        const std::string key = prefix + std::string(name.str());
        if (const toml::table* below = node.as_table())
            collect(*below, key + ".", settings);
        else if (const auto number = node.value_exact<double>())
            settings[key] = {fmt::format("{}", *number), *number};
        else if (const auto integer = node.value_exact<std::int64_t>())
            settings[key] = {fmt::format("{}", *integer), static_cast<double>(*integer)};
        else if (const auto text = node.value_exact<std::string>())
            settings[key] = {*text, std::nan("")};
        else if (const auto truth = node.value_exact<bool>())
            settings[key] = {*truth ? "true" : "false", std::nan("")};
    }
}

}  // namespace

toml::table parseToml(const std::filesystem::path& file) {
    const std::optional<std::string> text = fileContent(file);
    if (!text) throw CaseError({{file.string(), 0, "", "", readFault(file), "give the path of a TOML file"}});
    try {
        return toml::parse(*text, file.string());
    } catch (const toml::parse_error& e) {
        throw CaseError({{file.string(), static_cast<int>(e.source().begin.line), "", "",
                          "is not TOML: " + std::string(e.description()), "mend it"}});
    }
}

std::map<std::string, Setting> settingsOf(const toml::table& table) {
    std::map<std::string, Setting> settings;
    collect(table, "", settings);
    return settings;
}

Setting settingOf(const std::string& text) {
    return {text, numberIn(text)};
}

}  // namespace vkdose::report
