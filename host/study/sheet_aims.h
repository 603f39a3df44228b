#pragma once
// What a laboratory sheet says in the figures of the element tables.

#include <vector>

#include "host/study/element_tables.h"
#include "host/study/laboratory_sheet.h"
#include "host/study/posterior.h"

namespace vkdose {

struct SheetAim {
    const TableFigure* figure;
    Goal goal;
    bool fitted = false;  ///< the parameters were chosen by all values that it follows from
};

/// In the order poured, tapped, Hausner ratio, then as the tables have them. May be empty.
std::vector<SheetAim> aimsOf(const LaboratorySheet& sheet);

/// Density of the spheres that stand for the powder of a sheet: that of the grains, or such that a usual bed of them
/// has the bulk density, or that of the table [kg/m3].
double sphereDensity(const LaboratorySheet& sheet, const ElementTable& table);

/// Normal stress of the pre-shear that the sheet's figures of a ring shear tester are at [Pa].
double preShearLoad(const LaboratorySheet& sheet, const ElementTable& ringShear);

/// By what the Bond numbers of the ring shear test are to be multiplied to be those of the sheet's powder. There
/// adhesion counts against the load, not against the weight: at twice the load, or half the density, twice the Bond
/// number does the same.
double bondScale(const LaboratorySheet& sheet, const ElementTable& ringShear);

}  // namespace vkdose
