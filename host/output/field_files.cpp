#include "host/output/field_files.h"

#include <fmt/format.h>

#include <array>
#include <system_error>
#include <utility>

#include "host/core/csv_table.h"
#include "host/core/error.h"
#include "host/core/file.h"
#include "host/model/powders.h"
#include "host/output/field_row.h"
#include "host/output/hdf5.h"
#include "host/output/series.h"
#include "host/output/vtkhdf.h"

namespace vkdose {

namespace fs = std::filesystem;

namespace {

bool isMap(const FieldSensor& s) {
    return s.request.grid.resolvedDirections() > 1;
}
bool isVolume(const FieldSensor& s) {
    return s.request.grid.resolvedDirections() == 3;
}
bool isProfile(const FieldSensor& s) {
    return s.preset == FieldSensor::Preset::HeightProfile && !isMap(s);
}

/// Calls `visit` with the columns of the directions that are resolved.
template <class Visit>
void forEachPlace(const FieldGrid& grid, const Visit& visit) {
    int direction = 0;
    forEachColumn(kPlaceColumns, [&](const auto& c) {
        if (grid.resolved(direction++)) visit(c);
    });
}

/// ",0.001,0.002": the point's coordinates in the directions that are resolved.
std::string place(const FieldGrid& grid, std::size_t point) {
    const FieldRow row{grid.point(point), {}, 1};
    std::string text;
    forEachPlace(grid, [&](const auto& c) { text += "," + cellText(c.of(row), c.digits); });
    return text;
}

std::string placeNames(const FieldGrid& grid) {
    std::string text;
    forEachPlace(grid, [&](const auto& c) { text += std::string(",") + c.name; });
    return text;
}

/// Density of the particles of each field, of which its volume fraction is [kg/m3].
std::vector<double> solidDensities(const Case& c) {
    std::vector<double> densities;
    for (const FieldSensor& s : c.fields) densities.push_back(solidDensity(c, s.request.material));
    return densities;
}

}  // namespace

FieldFiles::FieldFiles(const fs::path& run, const Case& c)
    : folder_(run / kFieldsFolder), sensors_(c.fields), densities_(solidDensities(c)), properties_(c.world.properties) {
    if (sensors_.empty()) return;
    createFolder(folder_);
    for (const FieldSensor& s : sensors_) files_.emplace_back(folder_ / (s.name + ".csv"), header(s));
}

FieldFiles::FieldFiles(const fs::path& run, const Case& c, const std::vector<CsvMark>& marks)
    : folder_(run / kFieldsFolder), sensors_(c.fields), densities_(solidDensities(c)), properties_(c.world.properties) {
    if (marks.size() != sensors_.size()) throw OutputError("the checkpoint has another number of fields than the case");
    for (std::size_t k = 0; k < sensors_.size(); ++k)
        files_.emplace_back(folder_ / (sensors_[k].name + ".csv"), marks[k]);
}

std::string FieldFiles::quantityNames(const FieldSensor& s) const {
    std::string names = "," + csvHeader(kQuantityColumns) + (s.stress ? "," + csvHeader(kStressColumns) : "");
    for (const std::string& property : properties_) names += "," + property;
    return names;
}

std::string FieldFiles::quantities(const FieldSensor& s, const FieldPoint& p) const {
    const FieldRow row{Vec3(0), p, densities_[std::size_t(&s - sensors_.data())]};
    std::string line = "," + csvRow(kQuantityColumns, row) + (s.stress ? "," + csvRow(kStressColumns, row) : "");
    for (std::size_t k = 0; k < properties_.size(); ++k) line += "," + cellText(p.property(k), 9);
    return line;
}

std::string FieldFiles::header(const FieldSensor& s) const {
    const std::string when = csvHeader(kFieldWhenColumns);
    if (isMap(s)) return when + ",file";
    if (!isProfile(s)) return when + placeNames(s.request.grid) + quantityNames(s);
    std::string heights = when;
    for (std::size_t n = 0; n < s.request.grid.points(); ++n)
        heights += fmt::format(",height_m_at_z_{:.6g}_m", s.request.grid.point(n).z);
    return heights;
}

void FieldFiles::write(const FieldSample& f) {
    const FieldSensor& s = sensors_[f.field];
    CsvFile& csv = files_[f.field];
    const std::string when = csvRow(kFieldWhenColumns, f);
    if (isMap(s)) {
        const std::string name = fmt::format("{}_{:06}{}", s.name, f.number, isVolume(s) ? kVolumeExtension : ".csv");
        if (isVolume(s))  // before the line that names it
            replaceFile(folder_ / name, hdf5::made(folder_ / name, [&] { return image(s, f); }));
        else
            writeMap(s, f, name);
        csv.line(when + "," + csvLine({name}));
    } else if (isProfile(s)) {
        std::string line = when;
        for (const double h : f.heights) line += fmt::format(",{:.9g}", h);
        csv.line(line);
    } else {
        for (std::size_t n = 0; n < f.points.size(); ++n)
            csv.line(when + place(s.request.grid, n) + quantities(s, f.points[n]));
    }
    csv.flush();
}

void FieldFiles::writeMap(const FieldSensor& s, const FieldSample& f, const std::string& name) const {
    CsvFile map(folder_ / name, (placeNames(s.request.grid) + quantityNames(s)).substr(1));
    for (std::size_t n = 0; n < f.points.size(); ++n)
        map.line((place(s.request.grid, n) + quantities(s, f.points[n])).substr(1));
    map.flush();
}

/// The bytes of a VTKHDF file.
std::string FieldFiles::image(const FieldSensor& s, const FieldSample& f) const {
    const FieldGrid& g = s.request.grid;
    vtkhdf::Image image{g.cells, g.point(0), g.cell(), {}, {}};
    const auto add = [&](const char* name, const char* unit, std::size_t components, auto value) {
        std::vector<double> values;
        values.reserve(components * f.points.size());
        for (const FieldPoint& p : f.points) {
            const auto numbers = value(p);
            values.insert(values.end(), numbers.begin(), numbers.end());
        }
        image.pointData.push_back({name, unit, components, std::move(values)});
    };
    using One = std::array<double, 1>;
    const auto three = [](const Vec3& v) { return std::array<double, 3>{v.x, v.y, v.z}; };
    add("density", "kg/m3", 1, [](const FieldPoint& p) { return One{p.density}; });
    add("volume_fraction", "", 1,
        [&](const FieldPoint& p) { return One{p.density / densities_[std::size_t(&s - sensors_.data())]}; });
    add("momentum", "kg/m2/s", 3, [&](const FieldPoint& p) { return three(p.momentum); });
    add("velocity", "m/s", 3, [&](const FieldPoint& p) { return three(p.velocity()); });
    for (std::size_t k = 0; k < properties_.size(); ++k)
        add(properties_[k].c_str(), "", 1, [k](const FieldPoint& p) { return One{p.property(k)}; });
    if (s.stress) {
        add("coordination", "", 1, [](const FieldPoint& p) { return One{p.coordination()}; });
        add("granular_temperature", "m2/s2", 1, [](const FieldPoint& p) { return One{p.temperature()}; });
        add("kinetic_stress", "Pa", 6, [](const FieldPoint& p) {  // VTK's order: xx yy zz xy yz xz
            const std::array<double, 6>& k = p.kineticStress;
            return std::array<double, 6>{k[0], k[1], k[2], k[5], k[3], k[4]};
        });
        add("contact_stress", "Pa", 9, [](const FieldPoint& p) {
            std::array<double, 9> rows{};
            for (std::size_t n = 0; n < 9; ++n) rows[n] = p.contactStress[n / 3][int(n % 3)];
            return rows;
        });
    }
    image.fieldData.push_back({"time", "s", 1, std::vector<double>{f.time}});
    return vtkhdf::file(image);
}

std::vector<CsvMark> FieldFiles::store() {
    std::vector<CsvMark> marks;
    for (std::size_t k = 0; k < files_.size(); ++k) {
        marks.push_back(files_[k].store());
        if (isVolume(sensors_[k])) writeSeriesOf(sensors_[k]);
    }
    return marks;
}

/// The series is made from the list of the kept maps, because several runs may have written them.
void FieldFiles::writeSeriesOf(const FieldSensor& s) const {
    std::vector<SeriesFile> files;
    try {
        const Table list = Table::read(folder_ / (s.name + ".csv"));
        for (std::size_t row = 0; row < list.rows(); ++row) {
            if (!isUtf8(list.text(row, "file")))
                list.refuse(row, "file", "is no text in UTF-8", "put the file back as vkdose wrote it, or run anew");
            files.push_back({list.text(row, "file"), list.number(row, "time_s")});
        }
    } catch (const CaseError& e) {  // somebody has changed the file
        throw OutputError(e.what());
    }
    writeSeries(folder_ / (s.name + kVolumeExtension + kSeriesExtension), files);
}

}  // namespace vkdose
