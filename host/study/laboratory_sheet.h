#pragma once
// What a laboratory measured of a powder, in the figures by which a table of element tests is asked.

#include <span>
#include <string_view>
#include <vector>

namespace vkdose {

struct SheetFigure {
    const char* name = "";  ///< "repose"
    const char* unit = "";
    const char* meaning = "";
    /// The standard error that is taken where none is given: a part of the value, or an amount in the unit.
    double relative = 0, absolute = 0;

    double usualError(double value) const { return relative * value + absolute; }
};

inline constexpr SheetFigure kSheetFigures[] = {
    {"density", "kg/m3", "of the grains, with the pores inside of them", 0.03, 0},
    {"bulk", "kg/m3", "bulk density, poured", 0.03, 0},
    {"tapped", "kg/m3", "bulk density, tapped", 0.03, 0},
    {"hausner", "1", "tapped over poured density", 0, 0.03},
    {"repose", "degrees", "angle of a heap that a lifted tube leaves, seen from the side", 0, 2},
    {"drum", "degrees", "angle of the surface in a drum, seen through its front glass", 0, 2},
    {"ffc", "1", "consolidation stress over unconfined strength, of a ring shear tester", 0.15, 0},
    {"effective", "degrees", "effective angle of internal friction, of the same", 0, 1.5},
    {"steady", "degrees", "angle of steady flow, of the same", 0, 1.5},
    {"bond", "1",
     "pull of a contact over the weight of a grain, of grains of which it is known: 0 if they do not stick", 0, 0.5},
    {"load", "Pa", "normal stress of the pre-shear in that tester", 0, 0},
};

struct SheetValue {
    const SheetFigure* figure = nullptr;
    double value = 0;
    double error = 0;     ///< standard error
    bool fitted = false;  ///< parameters were chosen by it
};

struct LaboratorySheet {
    std::vector<SheetValue> values;  ///< no figure twice, each above 0; a Bond number may be 0

    /// Null if the sheet does not have the figure.
    const SheetValue* find(std::string_view name) const {
        for (const SheetValue& v : values)
            if (v.figure->name == name) return &v;
        return nullptr;
    }
};

}  // namespace vkdose
