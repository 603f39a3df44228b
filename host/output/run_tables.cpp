#include "host/output/run_tables.h"

#include <tuple>

#include "host/analysis/cycles.h"
#include "host/output/field_row.h"
#include "host/output/frames.h"
#include "host/output/particle_row.h"
#include "host/sim/dose.h"
#include "host/sim/sample.h"

namespace vkdose {

std::vector<OutputTable> runTables() {
    const auto when = columnTexts(kFieldWhenColumns);
    std::vector<ColumnText> heights = when, maps = when;
    heights.push_back({"height_m_at_z_Z_m", "m",
                       "Height of the powder at z = Z; a column for each point of the grid along z, named by its z."});
    maps.push_back({"file", "", "Name of the file that holds the map, in the same folder."});
    return {
        {"timeseries.csv", "A line for every sensor interval and for the end of every phase.",
         columnTexts(kSampleColumns)},
        {"timeseries.csv, with sensors.energy", "These columns follow in the same line.", columnTexts(kEnergyColumns)},
        {"timeseries.csv, with domain.periodic", "These columns follow in the same line.",
         columnTexts(kThroughColumns)},
        {"timeseries.csv, with bodies",
         "These columns follow in the same line, for each `[[body]]` and, behind them, for `[coil]` as the body coil. "
         "The name of the body and a dot stand before each.",
         columnTexts(kBodyColumns)},
        {"timeseries.csv, with bodies that move freely",
         "These columns follow in the same line, for each `[[body]]` of `kind = \"free\"` or `\"hinge\"`, "
         "likewise.",
         columnTexts(kFreeBodyColumns)},
        {"timeseries.csv, with bodies on a hinge",
         "These columns follow behind those of a body that moves freely, for each `[[body]]` of `kind = \"hinge\"`.",
         columnTexts(kHingedBodyColumns)},
        {"doses.csv, with bodies",
         "These columns follow in the same line, for each `[[body]]` and, behind them, for `[coil]` as the body coil. "
         "The name of the body and a dot stand before each.",
         columnTexts(kDoseBodyColumns)},
        {"timeseries.csv, with regions",
         "These columns follow in the same line, for each `[[region]]`. The name of the region and a dot stand before "
         "each.",
         columnTexts(kRegionSampleColumns)},
        {"doses.csv, with regions", "These columns follow in the same line, for each `[[region]]`, likewise.",
         columnTexts(kRegionColumns)},
        {"timeseries.csv, with several powders",
         "These columns follow in the same line, for each powder. The name of the powder and a dot stand before each.",
         columnTexts(kPowderColumns)},
        {"doses.csv", "A line for every dose.", columnTexts(kDoseColumns)},
        {"doses.csv, with several powders", "These columns follow in the same line, for each powder, likewise.",
         columnTexts(kPowderDoseColumns)},
        {"cycles.csv",
         "A line for every [cycle](../analysis/README.md#mass-by-cycle) of the device, at the end of the run. There is "
         "no such file where nothing repeats itself.",
         columnTexts(kCycleColumns)},
        {"particles.csv", "A line for every particle, at the end of the run.", columnTexts(kParticleColumns)},
        {"particles.csv, with several powders",
         "This column follows in the same line.",
         {{"powder", "", "Name of its powder."}}},
        {"frames/frames.csv", "A line for every frame.", columnTexts(kFrameColumns)},
        {"fields/NAME.csv", "Of a field in one direction or none: a line for every point of the grid at every time.",
         columnTexts(std::tuple_cat(kFieldWhenColumns, kPlaceColumns, kQuantityColumns))},
        {"fields/NAME.csv, with stress", "These columns follow in the same line.", columnTexts(kStressColumns)},
        {"fields/NAME.csv, of a height profile", "A line for every time.", heights},
        {"fields/NAME.csv, of a map", "Of a field in two or three directions: a line for every map.", maps},
        {"fields/NAME_000000.csv", "A map in two directions: a line for every point of the grid.",
         columnTexts(std::tuple_cat(kPlaceColumns, kQuantityColumns))},
        {"fields/NAME_000000.csv, with stress", "These columns follow in the same line.", columnTexts(kStressColumns)},
    };
}

}  // namespace vkdose
