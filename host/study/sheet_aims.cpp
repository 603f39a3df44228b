#include "host/study/sheet_aims.h"

#include <cmath>

namespace vkdose {

namespace {

/// The volume fraction of a bed of which nothing is known, between the loosest and the densest.
constexpr double kUsualFraction = 0.54;

double relative(const SheetValue& v) {
    return v.error / v.value;
}

}  // namespace

std::vector<SheetAim> aimsOf(const LaboratorySheet& sheet) {
    std::vector<SheetAim> aims;
    const auto add = [&](const char* name, double value, double error, bool fitted) {
        aims.push_back({&tableFigure(name), {value, error, 1}, fitted});
    };
    const auto ratio = [&](const char* name, const SheetValue& above, const SheetValue& below) {
        const double value = above.value / below.value;
        add(name, value, value * std::hypot(relative(above), relative(below)), above.fitted && below.fitted);
    };
    const SheetValue *density = sheet.find("density"), *bulk = sheet.find("bulk"), *tapped = sheet.find("tapped");
    if (density != nullptr && bulk != nullptr) ratio("poured", *bulk, *density);
    if (density != nullptr && tapped != nullptr) ratio("tapped", *tapped, *density);
    if (density == nullptr && bulk != nullptr && tapped != nullptr) ratio("hausner", *tapped, *bulk);
    for (const char* name : {"hausner", "repose", "drum", "effective", "steady", "bond"})
        if (const SheetValue* v = sheet.find(name)) add(name, v->value, v->error, v->fitted);
    if (const SheetValue* ffc = sheet.find("ffc"))
        add("strength", 1 / ffc->value, relative(*ffc) / ffc->value, ffc->fitted);
    return aims;
}

double sphereDensity(const LaboratorySheet& sheet, const ElementTable& table) {
    if (const SheetValue* given = sheet.find("density")) return given->value;
    if (const SheetValue* bulk = sheet.find("bulk")) return bulk->value / kUsualFraction;
    return table.density;
}

double preShearLoad(const LaboratorySheet& sheet, const ElementTable& ringShear) {
    const SheetValue* given = sheet.find("load");
    return given != nullptr ? given->value
                            : preShearStress(ringShear) * sphereDensity(sheet, ringShear) / ringShear.density;
}

double bondScale(const LaboratorySheet& sheet, const ElementTable& ringShear) {
    return ringShear.density / sphereDensity(sheet, ringShear) * preShearLoad(sheet, ringShear) /
           preShearStress(ringShear);
}

}  // namespace vkdose
