#include "host/report/fields_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "host/core/csv_table.h"
#include "host/core/error.h"
#include "host/core/json.h"
#include "host/report/deflate.h"
#include "host/report/thinning.h"

namespace vkdose::report {

namespace fs = std::filesystem;

namespace {

constexpr std::array<const char*, 3> kAxes{"x", "y", "z"};
constexpr std::size_t kMostProfiles = 600;

enum class Scale { Linear, Root, Signed };
constexpr std::array<const char*, 3> kScaleNames{"linear", "root", "signed"};

struct Quantity {
    std::string name, unit;
    Scale scale = Scale::Linear;
    std::vector<std::string> columns;  ///< whose mean it is
    double most = 0;
};

/// Which of a grid's two resolved directions goes across the page, and which up.
struct Plane {
    explicit Plane(const FieldGrid& grid)
        : across(grid.resolved(2) ? 2 : 0), up(grid.resolved(1) ? 1 : 0), over(3 - across - up), grid_(grid) {}

    std::size_t columns() const { return grid_.cells[std::size_t(across)]; }
    std::size_t rows() const { return grid_.cells[std::size_t(up)]; }
    /// Of the grid's points, counted along x first, then y, then z; row 0 is the uppermost.
    std::size_t point(std::size_t row, std::size_t column) const {
        std::array<std::size_t, 3> cell{};
        cell[std::size_t(across)] = column;
        cell[std::size_t(up)] = rows() - 1 - row;
        return (cell[2] * grid_.cells[1] + cell[1]) * grid_.cells[0] + cell[0];
    }

    int across, up, over;

  private:
    const FieldGrid& grid_;
};

struct Entry {
    double time = 0;
    std::string phase;
    int dose = 0;
    std::string file;
};

/// Values of one map, a list for each quantity, rows from above.
using Map = std::vector<std::vector<double>>;

std::vector<Quantity> quantitiesOf(const FieldSensor& s, const Plane& plane) {
    const auto velocity = [](int axis) { return fmt::format("velocity_{}_m_s", kAxes[std::size_t(axis)]); };
    std::vector<Quantity> list{{"density", "kg/m³", Scale::Linear, {"density_kg_m3"}, 0},
                               {"velocity across", "m/s", Scale::Signed, {velocity(plane.across)}, 0},
                               {"velocity up", "m/s", Scale::Signed, {velocity(plane.up)}, 0}};
    if (!s.stress) return list;
    list.push_back({"pressure of contacts",
                    "Pa",
                    Scale::Root,
                    {"contact_stress_xx_Pa", "contact_stress_yy_Pa", "contact_stress_zz_Pa"},
                    0});
    list.push_back({"coordination", "", Scale::Linear, {"coordination"}, 0});
    list.push_back({"granular temperature", "m²/s²", Scale::Root, {"granular_temperature_m2_s2"}, 0});
    return list;
}

std::vector<Entry> keptMaps(const fs::path& list) {
    const Table table = Table::read(list);
    std::vector<Entry> entries;
    std::error_code code;
    for (std::size_t i = 0; i < table.rows(); ++i) {
        if (!fs::exists(list.parent_path() / table.text(i, "file"), code))
            table.refuse(i, "file", "names a map that is not there", "put the map back, or run the case again");
        entries.push_back({table.number(i, "time_s"), table.text(i, "phase"), static_cast<int>(table.number(i, "dose")),
                           table.text(i, "file")});
    }
    return entries;
}

Map readMap(const fs::path& file, const std::vector<Quantity>& quantities, const FieldGrid& grid, const Plane& plane) {
    const Table table = Table::read(file, LastLine::Whole);
    if (table.rows() != grid.points())
        throw CaseError({{file.string(), 0, "", "", fmt::format("has {} points", table.rows()),
                          fmt::format("the field's grid has {}; run the case again", grid.points())}});
    Map map;
    for (const Quantity& q : quantities) {
        std::vector<double> sum(table.rows(), 0);
        for (const std::string& name : q.columns) {
            const std::vector<double> values = table.column(name);
            for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += values[i] / static_cast<double>(q.columns.size());
        }
        std::vector<double>& values = map.emplace_back();
        for (std::size_t row = 0; row < plane.rows(); ++row)
            for (std::size_t column = 0; column < plane.columns(); ++column)
                values.push_back(sum[plane.point(row, column)]);
    }
    return map;
}

std::uint8_t levelOf(double value, const Quantity& q) {
    const double part = q.most > 0 && std::isfinite(value) ? std::clamp(value / q.most, -1.0, 1.0) : 0;
    switch (q.scale) {
        case Scale::Linear:
            return static_cast<std::uint8_t>(std::lround(255 * std::max(part, 0.0)));
        case Scale::Root:
            return static_cast<std::uint8_t>(std::lround(255 * std::sqrt(std::max(part, 0.0))));
        case Scale::Signed:
            break;
    }
    return static_cast<std::uint8_t>(128 + std::lround(std::copysign(127 * std::sqrt(std::abs(part)), part)));
}

/// Sets `most` of every quantity from the maps since dosing began, or from all maps if it has not begun. Only cells
/// with powder count. The two velocities share one `most`.
void findScales(std::vector<Quantity>& quantities, const std::vector<Entry>& entries, const std::vector<Map>& maps) {
    const bool dosing = std::any_of(entries.begin(), entries.end(), [](const Entry& e) { return e.dose > 0; });
    const auto each = [&](auto look) {
        for (std::size_t f = 0; f < maps.size(); ++f)
            if (!dosing || entries[f].dose > 0) look(maps[f]);
    };
    double densest = 0;
    each([&](const Map& map) {
        for (const double rho : map[0]) densest = std::max(densest, rho);
    });
    each([&](const Map& map) {
        for (std::size_t q = 0; q < quantities.size(); ++q)
            for (std::size_t i = 0; i < map[q].size(); ++i)
                if (map[0][i] * 255 >= densest * kSparseLevel && std::isfinite(map[q][i]))
                    quantities[q].most = std::max(quantities[q].most, std::abs(map[q][i]));
    });
    quantities[1].most = quantities[2].most = std::max(quantities[1].most, quantities[2].most);
}

std::string packed(const std::vector<Quantity>& quantities, const std::vector<Map>& maps, std::size_t points) {
    Deflate stream;
    std::vector<std::vector<std::uint8_t>> before(quantities.size(), std::vector<std::uint8_t>(points, 0));
    for (const Map& map : maps)
        for (std::size_t q = 0; q < quantities.size(); ++q) {
            std::vector<std::uint8_t> change(points);
            for (std::size_t i = 0; i < points; ++i) {
                const std::uint8_t level = levelOf(map[q][i], quantities[q]);
                change[i] = static_cast<std::uint8_t>(level - before[q][i]);
                before[q][i] = level;
            }
            stream.add(change);
        }
    return base64(stream.finish());
}

Json planeJson(const FieldSensor& s, const Plane& plane) {
    const FieldGrid& g = s.request.grid;
    const auto pair = [&](const Vec3& v) { return Json{jsonNumber(v[plane.across]), jsonNumber(v[plane.up])}; };
    return {{"axes", {kAxes[std::size_t(plane.across)], kAxes[std::size_t(plane.up)]}},
            {"cells", {plane.columns(), plane.rows()}},
            {"low_m", pair(g.low)},
            {"high_m", pair(g.high)},
            {"over",
             {{"axis", kAxes[std::size_t(plane.over)]},
              {"low_m", jsonNumber(g.low[plane.over])},
              {"high_m", jsonNumber(g.high[plane.over])}}}};
}

Json mapJson(const fs::path& folder, const FieldSensor& s, std::size_t mostBytes) {
    const Plane plane(s.request.grid);
    std::vector<Quantity> quantities = quantitiesOf(s, plane);
    const std::vector<Entry> all = keptMaps(folder / (s.name + ".csv"));
    if (all.empty()) return nullptr;
    const std::size_t points = s.request.grid.points(), most = mostBytes / (points * quantities.size());

    Json j = planeJson(s, plane);
    j["name"] = s.name;
    j["kernel"] = s.request.kernel == Kernel::Gaussian ? "Gaussian" : "Lucy";
    j["width_m"] = jsonNumber(s.request.width);
    j["average"] = s.average;
    j["stored"] = all.size();
    j["sparse_level"] = kSparseLevel;
    j["stream"] = nullptr;
    if (most < std::min<std::size_t>(all.size(), 2)) return j;

    const std::size_t stride = all.size() <= most ? 1 : 1 + (all.size() - 2) / (most - 1);
    const std::vector<Entry> entries = thinned(all, stride);
    std::vector<Map> maps;
    for (const Entry& e : entries) maps.push_back(readMap(folder / e.file, quantities, s.request.grid, plane));
    findScales(quantities, entries, maps);
    for (const char* name : {"time_s", "phase", "dose", "quantities"}) j[name] = Json::array();
    for (const Entry& e : entries) {
        j["time_s"].push_back(jsonNumber(e.time));
        j["phase"].push_back(e.phase);
        j["dose"].push_back(e.dose);
    }
    for (const Quantity& q : quantities)
        j["quantities"].push_back({{"name", q.name},
                                   {"unit", q.unit},
                                   {"scale", kScaleNames[static_cast<std::size_t>(q.scale)]},
                                   {"most", jsonNumber(q.most)}});
    j["stream"] = packed(quantities, maps, points);
    return j;
}

/// To a micrometre: a page has no use for more digits.
double rounded(double height) {
    return std::round(height * 1e6) / 1e6;
}

/// All rows; or every n-th row, the last row, and the last row of each dose (0: the settled bed).
Json profileJson(const fs::path& folder, const FieldSensor& s) {
    const Table table = Table::read(folder / (s.name + ".csv"));
    if (table.rows() == 0) return nullptr;
    constexpr std::size_t kPlace = 3;  // time, phase, dose
    const FieldGrid& grid = s.request.grid;
    if (table.names().size() != kPlace + grid.points())
        throw CaseError(
            {{(folder / (s.name + ".csv")).string(), 0, "", "", fmt::format("has {} columns", table.names().size()),
              fmt::format("the field has {} places; run the case again", grid.points())}});
    std::vector<double> z;
    for (std::size_t n = 0; n < grid.points(); ++n) z.push_back(grid.point(n).z);
    const auto row = [&](std::size_t i) {
        std::vector<double> heights;
        for (std::size_t n = 0; n < grid.points(); ++n)
            heights.push_back(rounded(table.number(i, table.names()[kPlace + n])));
        return Json{{"time_s", jsonNumber(table.number(i, "time_s"))},
                    {"dose", static_cast<int>(table.number(i, "dose"))},
                    {"height_m", jsonNumbers(heights)}};
    };
    std::vector<std::size_t> all(table.rows());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
    Json states = Json::array(), rows = Json::array();
    for (const std::size_t i : all)
        if (i + 1 == all.size() || table.text(i, "dose") != table.text(i + 1, "dose")) states.push_back(row(i));
    for (const std::size_t i : thinned(all, (all.size() + kMostProfiles - 1) / kMostProfiles)) rows.push_back(row(i));
    return {{"name", s.name},
            {"length_m", jsonNumber(grid.high.z - grid.low.z)},
            {"z_m", jsonNumbers(z)},
            {"states", states},
            {"rows", rows}};
}

}  // namespace

Json fieldsJson(const fs::path& folder, const Case& c, std::size_t mostBytes) {
    const fs::path fields = folder / "fields";
    std::vector<const FieldSensor*> maps, profiles;
    for (const FieldSensor& s : c.fields) {
        const int directions = s.request.grid.resolvedDirections();
        if (!fs::exists(fields / (s.name + ".csv"))) continue;
        if (directions == 2) maps.push_back(&s);
        if (directions == 1 && s.preset == FieldSensor::Preset::HeightProfile) profiles.push_back(&s);
    }
    Json j{{"maps", Json::array()}, {"profiles", Json::array()}};
    for (const FieldSensor* s : maps)
        if (Json map = mapJson(fields, *s, mostBytes / maps.size()); !map.is_null())
            j["maps"].push_back(std::move(map));
    for (const FieldSensor* s : profiles)
        if (Json profile = profileJson(fields, *s); !profile.is_null()) j["profiles"].push_back(std::move(profile));
    return j["maps"].empty() && j["profiles"].empty() ? Json(nullptr) : j;
}

std::size_t streamCharacters(const Json& fields) {
    std::size_t characters = 0;
    if (!fields.is_null())
        for (const Json& map : fields["maps"])
            if (map["stream"].is_string()) characters += map["stream"].get_ref<const std::string&>().size();
    return characters;
}

}  // namespace vkdose::report
