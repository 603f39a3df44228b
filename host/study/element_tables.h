#pragma once
// A table of element tests: what a test says of powders that fill a box of parameters.

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host/core/csv_table.h"
#include "host/study/calibration_aim.h"
#include "host/study/sampled_points.h"

namespace vkdose {

inline constexpr const char* kBondNumber = "contact.bond_number";

/// An element test over the parameters.
struct ElementTable {
    std::vector<FreeParameter> box;
    Table figures;                   ///< figures.csv of its sweep
    std::vector<Parameters> points;  ///< of each row
    double density = 0;              ///< of its spheres [kg/m3]
};

/// A figure that a table has, in the unit of laboratory sheets.
struct TableFigure {
    const char* name;
    const char* title;
    const char* unit;
    const char* test;
    double (*read)(const ElementTable& table, std::size_t row);  ///< NaN where the row has none
};
std::span<const TableFigure> tableFigures();
const TableFigure& tableFigure(std::string_view name);

/// Normal stress of the pre-shear in the ring shear test, mean over all rows [Pa].
double preShearStress(const ElementTable& ringShear);

/// The tables of a folder, each read when it is first asked for: the study TEST.toml, and its figures as TEST.csv.
class ElementTables {
  public:
    explicit ElementTables(std::filesystem::path folder) : folder_(std::move(folder)) {}

    /// Throws CaseError if a file is missing or damaged.
    const ElementTable& of(const std::string& test);
    bool has(const std::string& test) const;

  private:
    std::filesystem::path folder_;
    std::map<std::string, ElementTable> read_;
};

}  // namespace vkdose
