// The powders that are known.
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "host/app/calibration_text.h"
#include "host/app/commands.h"
#include "host/app/confirm.h"
#include "host/app/exit_code.h"
#include "host/app/find_case.h"
#include "host/app/like.h"
#include "host/app/tell.h"
#include "host/app/text.h"
#include "host/core/csv_table.h"
#include "host/core/printable.h"
#include "host/model/powder_file.h"

namespace vkdose {

namespace {

using Json = nlohmann::ordered_json;

/// "23.4 +- 0.3 degrees"
std::string valueText(double value, const std::optional<double>& error, const std::string& unit = "") {
    const std::string text = error ? withError(value, *error) : fmt::format("{:.4g}", value);
    return unit.empty() ? text : text + " " + unit;
}

std::size_t fittedOf(const PowderFile& p) {
    return std::size_t(std::count_if(p.held.begin(), p.held.end(), [](const PowderFile::Held& h) { return h.fitted; }));
}

std::string heldText(const PowderFile& p) {
    const std::size_t fitted = fittedOf(p);
    if (p.held.empty()) return "held against nothing";
    return fmt::format("{} fitted, {} predicted", fitted, p.held.size() - fitted);
}

std::string listText(const std::vector<PowderFile>& powders) {
    std::size_t name = 0, title = 0;
    for (const PowderFile& p : powders) {
        name = std::max(name, p.file.stem().string().size());
        title = std::max(title, p.title.size());
    }
    std::string text;
    for (const PowderFile& p : powders)
        text += fmt::format("{:<{}}  {:<{}}  {}; {}{}\n", p.file.stem().string(), name, printable(p.title), title,
                            counted(p.laboratory.size(), "published figure"), heldText(p), p.draws ? "; draws" : "");
    return text + "next     vkdose powders NAME, or vkdose run CASE --powder NAME\n";
}

Json listJson(const std::vector<PowderFile>& powders) {
    Json list = Json::array();
    for (const PowderFile& p : powders) {
        const std::size_t fitted = fittedOf(p);
        list.push_back({{"name", p.file.stem().string()},
                        {"title", printable(p.title)},
                        {"published", p.laboratory.size()},
                        {"fitted", fitted},
                        {"predicted", p.held.size() - fitted},
                        {"draws", p.draws.has_value()}});
    }
    return list;
}

std::string powderText(const PowderFile& p) {
    std::string text = fmt::format("{} ({})\n", printable(p.title), printable(p.file.string()));
    for (const PowderFile::Laboratory& l : p.laboratory)
        text += fmt::format("published  {} {}{}\n           {}\n", printable(l.figure),
                            valueText(l.value, l.error, printable(l.unit)),
                            l.method.empty() ? "" : ", " + printable(l.method), printable(l.source));
    for (const PowderFile::Held& h : p.held)
        text += fmt::format("{:<10} {} of {}: simulated {}, measured {}{}\n", h.fitted ? "fitted" : "predicted",
                            printable(h.figure), printable(h.test), valueText(h.simulated, h.simulatedError),
                            valueText(h.measured, h.measuredError), h.note.empty() ? "" : "; " + printable(h.note));
    if (p.held.empty()) text += "held       against nothing yet\n";
    if (p.draws)
        text += fmt::format("draws      {} of its parameters, in {}\n", Table::read(*p.draws, LastLine::Whole).rows(),
                            printable(p.draws->filename().string()));
    if (!p.limits.empty()) text += fmt::format("limits     {}\n", printable(p.limits));
    return text;
}

}  // namespace

int powdersCommand(const PowdersOptions& options) {
    if (!options.like.empty()) return likeCommand(options);
    if (options.confirm > 0) return confirmCommand(options);
    if (!options.name.empty()) {
        tell("{}", powderText(readPowderFile(findPowder(options.name))));
        return kOk;
    }
    std::vector<PowderFile> powders;
    for (const std::filesystem::path& file : powderFiles()) powders.push_back(readPowderFile(file));
    if (options.json) {
        tell("{}\n", listJson(powders).dump());
        return kOk;
    }
    tell("{}", powders.empty() ? "no powders: there is no folder cases/powders here\n" : listText(powders));
    return kOk;
}

}  // namespace vkdose
