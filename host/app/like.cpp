#include "host/app/like.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/app/backends.h"
#include "host/app/calibration_text.h"
#include "host/app/exit_code.h"
#include "host/app/find_case.h"
#include "host/app/new_file.h"
#include "host/app/tell.h"
#include "host/app/text.h"
#include "host/core/number.h"
#include "host/core/printable.h"
#include "host/study/calibration_file.h"
#include "host/study/powder_table.h"

namespace vkdose {

namespace {

namespace fs = std::filesystem;

std::string unitText(std::string_view unit) {
    return unit.empty() || unit == "1" ? "" : fmt::format(" {}", unit);
}

std::string figureNames() {
    std::string names;
    for (const SheetFigure& f : kSheetFigures) names += fmt::format("{}{}", names.empty() ? "" : ", ", f.name);
    return names;
}

[[noreturn]] void refuse(const std::string& given, const std::string& problem) {
    throw UsageError(
        fmt::format("powders --like {}: {}; write {}", printable(given), problem, "repose=48 or repose=48+-2"));
}

/// "repose=48+-2"
SheetValue valueOf(const std::string& given) {
    const std::size_t equals = given.find('=');
    if (equals == std::string::npos) refuse(given, "has no value");
    const std::string name = given.substr(0, equals);
    SheetValue v;
    for (const SheetFigure& f : kSheetFigures)
        if (name == f.name) v.figure = &f;
    if (v.figure == nullptr)
        throw UsageError(fmt::format("powders --like {}: there is no such figure; give some of {}", printable(given),
                                     figureNames()));
    std::string text = given.substr(equals + 1);
    std::size_t sign = text.find("+-"), length = 2;
    if (sign == std::string::npos) sign = text.find("\u00b1");
    const std::optional<double> value = numberOf(text.substr(0, sign));
    const bool zero = value && *value == 0 && name == "bond";
    if (!value || !std::isfinite(*value) || (*value <= 0 && !zero)) refuse(given, "is no number above 0");
    v.value = *value;
    v.error = v.figure->usualError(v.value);
    if (sign == std::string::npos) return v;
    const std::optional<double> error = numberOf(text.substr(sign + length));
    if (!error || !std::isfinite(*error) || *error <= 0) refuse(given, "has an error that is no number above 0");
    v.error = *error;
    return v;
}

LaboratorySheet sheetOf(const std::vector<std::string>& given) {
    LaboratorySheet sheet;
    for (const std::string& text : given) {
        const SheetValue v = valueOf(text);
        if (sheet.find(v.figure->name) != nullptr) refuse(text, fmt::format("{} is given twice", v.figure->name));
        sheet.values.push_back(v);
    }
    const SheetValue *density = sheet.find("density"), *bulk = sheet.find("bulk"), *tapped = sheet.find("tapped");
    const auto order = [](const SheetValue* less, const SheetValue* more) {
        if (less == nullptr || more == nullptr || less->value < more->value) return;
        throw UsageError(fmt::format("powders --like: {} = {:.6g} is not below {} = {:.6g}", less->figure->name,
                                     less->value, more->figure->name, more->value));
    };
    order(bulk, tapped);
    order(bulk, density);
    order(tapped, density);
    if (bulk != nullptr && tapped != nullptr && sheet.find("hausner") != nullptr)
        throw UsageError("powders --like: hausner is tapped over bulk; give two of the three");
    return sheet;
}

std::string likeText(const LaboratorySheet& sheet, const LikePowder& like) {
    std::string text;
    for (const SheetValue& v : sheet.values)
        text += fmt::format("given      {} {}{}\n", v.figure->name,
                            v.figure->usualError(1) > 0 ? withError(v.value, v.error) : fmt::format("{:.4g}", v.value),
                            unitText(v.figure->unit));
    text += fitText(like.finding, "");
    text += fmt::format("density    {:.4g} kg/m3 of the spheres\n", like.density);
    for (const auto& f : like.foretold)
        text +=
            fmt::format("foretold   {} {}{}\n", f.name, withError(f.belief.mean, f.belief.deviation), unitText(f.unit));
    if (like.load > 0) text += fmt::format("load       figures of the ring shear tester are at {:.4g} Pa\n", like.load);
    for (const std::string& sentence : like.beyond) text += "beyond     " + sentence + "\n";
    return text;
}

}  // namespace

fs::path tablesFolder() {
    for (const fs::path& folder : caseFolders())
        if (fs::exists(folder / "powders" / "table")) return folder / "powders" / "table";
    throw UsageError("powders: the table of element tests, cases/powders/table, did not come with this program");
}

int likeCommand(const PowdersOptions& options) {
    const LaboratorySheet sheet = sheetOf(options.like);
    const fs::path folder = tablesFolder();
    fs::path draws = options.out;
    draws.replace_filename(options.out.stem().string() + "-draws.csv");
    if (!options.out.empty()) {
        requireNewFile(options.out);
        requireAbsent(draws);
    }
    const LikePowder like = powderLike(sheet, folder);
    tell("{}", likeText(sheet, like));
    if (options.out.empty()) return kOk;
    writeNew(draws, drawsText(like.finding));
    writeNew(options.out, powderFileText(sheet, like, folder, draws.filename().string()));
    const std::string powder = shellWord(options.out.string());
    tell(
        "wrote      {}\n           {}\nnext       vkdose powders {} --confirm 6\n           vkdose run CASE --powder "
        "{} --draws 16\n",
        printable(options.out.string()), printable(draws.string()), powder, powder);
    return kOk;
}

}  // namespace vkdose
