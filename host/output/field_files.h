#pragma once
// The fields of a run, in fields/ of its output folder. Every field has a NAME.csv. For a map NAME.csv lists the maps
// that were kept, each a file of its own: NAME_000000.csv, ... in two resolved directions, NAME_000000.hdf, ... in
// three, with their times in NAME.hdf.series.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "host/model/case.h"
#include "host/output/csv.h"
#include "host/sim/field_watch.h"

namespace vkdose {

inline constexpr const char* kFieldsFolder = "fields";
inline constexpr const char* kVolumeExtension = ".hdf";  ///< of a map in three directions

class FieldFiles {
  public:
    /// Creates the folder and the files, if the case has fields. Throws OutputError.
    FieldFiles(const std::filesystem::path& run, const Case& c);

    /// Goes on with files as they were when `store` returned `marks`.
    FieldFiles(const std::filesystem::path& run, const Case& c, const std::vector<CsvMark>& marks);

    void write(const FieldSample& f);

    /// Makes everything written survive a crash, and brings the series up to date. Returns the state of every NAME.csv.
    std::vector<CsvMark> store();

  private:
    std::string header(const FieldSensor& s) const;
    std::string quantityNames(const FieldSensor& s) const;
    std::string quantities(const FieldSensor& s, const FieldPoint& p) const;
    void writeMap(const FieldSensor& s, const FieldSample& f, const std::string& name) const;
    void writeSeriesOf(const FieldSensor& s) const;
    std::string image(const FieldSensor& s, const FieldSample& f) const;

    std::filesystem::path folder_;
    std::vector<FieldSensor> sensors_;
    std::vector<double> densities_;        ///< of the particles, for each field [kg/m3]
    std::vector<std::string> properties_;  ///< World::properties
    std::vector<CsvFile> files_;
};

}  // namespace vkdose
