#include "host/output/field_files.h"

#include <fmt/format.h>

#include <system_error>
#include <utility>

#include "host/core/error.h"

namespace vkdose {

namespace fs = std::filesystem;

namespace {

constexpr const char* kAxes[] = {"x", "y", "z"};
constexpr const char* kFolder = "fields";

bool isMap(const FieldSensor& s) {
    return s.request.grid.resolvedDirections() > 1;
}
bool isProfile(const FieldSensor& s) {
    return s.preset == FieldSensor::Preset::HeightProfile && !isMap(s);
}

/// ",0.001,0.002": the point's coordinates in the directions that are resolved.
std::string place(const FieldGrid& grid, std::size_t point) {
    std::string text;
    for (int d = 0; d < 3; ++d)
        if (grid.resolved(d)) text += fmt::format(",{:.9g}", grid.point(point)[d]);
    return text;
}

std::string placeNames(const FieldGrid& grid) {
    std::string text;
    for (int d = 0; d < 3; ++d)
        if (grid.resolved(d)) text += fmt::format(",{}_m", kAxes[d]);
    return text;
}

}  // namespace

FieldFiles::FieldFiles(fs::path run, const Case& c)
    : folder_(std::move(run) / kFolder), sensors_(c.fields), density_(c.world.density) {
    if (sensors_.empty()) return;
    std::error_code error;
    fs::create_directories(folder_, error);
    if (error) throw OutputError(fmt::format("cannot create {}: {}", folder_.string(), error.message()));
    for (const FieldSensor& s : sensors_) files_.emplace_back(folder_ / (s.name + ".csv"), header(s));
}

FieldFiles::FieldFiles(fs::path run, const Case& c, const std::vector<std::uint64_t>& bytes)
    : folder_(std::move(run) / kFolder), sensors_(c.fields), density_(c.world.density) {
    if (bytes.size() != sensors_.size()) throw OutputError("the checkpoint has another number of fields than the case");
    for (std::size_t k = 0; k < sensors_.size(); ++k)
        files_.emplace_back(folder_ / (sensors_[k].name + ".csv"), bytes[k]);
}

std::string FieldFiles::quantityNames(const FieldSensor& s) const {
    std::string names = ",density_kg_m3,volume_fraction";
    for (const char* a : kAxes) names += fmt::format(",momentum_{}_kg_m2_s", a);
    for (const char* a : kAxes) names += fmt::format(",velocity_{}_m_s", a);
    if (!s.stress) return names;
    names += ",coordination,granular_temperature_m2_s2";
    for (const char* ab : {"xx", "yy", "zz", "yz", "zx", "xy"}) names += fmt::format(",kinetic_stress_{}_Pa", ab);
    for (const char* a : kAxes)
        for (const char* b : kAxes) names += fmt::format(",contact_stress_{}{}_Pa", a, b);
    return names;
}

std::string FieldFiles::quantities(const FieldSensor& s, const FieldPoint& p) const {
    const Vec3 v = p.velocity();
    std::string text = fmt::format(",{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g}", p.density,
                                   p.density / density_, p.momentum.x, p.momentum.y, p.momentum.z, v.x, v.y, v.z);
    if (!s.stress) return text;
    text += fmt::format(",{:.9g},{:.9g}", p.coordination(), p.temperature());
    for (const double k : p.kineticStress) text += fmt::format(",{:.9g}", k);
    for (const Vec3& row : p.contactStress) text += fmt::format(",{:.9g},{:.9g},{:.9g}", row.x, row.y, row.z);
    return text;
}

std::string FieldFiles::header(const FieldSensor& s) const {
    const std::string when = "time_s,phase,dose";
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
    const std::string when = fmt::format("{:.9g},{},{}", f.time, phaseName(f.phase), f.dose);
    if (isMap(s)) {
        const std::string name = fmt::format("{}_{:06}.csv", s.name, f.number);
        writeMap(s, f, name);  // before the line that names it
        csv.line(when + "," + name);
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

std::vector<std::uint64_t> FieldFiles::store() {
    std::vector<std::uint64_t> bytes;
    for (CsvFile& file : files_) bytes.push_back(file.store());
    return bytes;
}

void FieldFiles::remove(const fs::path& run) {
    std::error_code ignored;
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(run / kFolder, ignored))
        if (entry.path().extension() == ".csv") files.push_back(entry.path());
    for (const fs::path& file : files) fs::remove(file, ignored);
    fs::remove(run / kFolder, ignored);  // unless something else is in it
}

}  // namespace vkdose
