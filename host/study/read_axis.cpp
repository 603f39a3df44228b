#include "host/study/read_axis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "host/core/csv_table.h"
#include "host/core/number.h"
#include "host/model/named_file.h"
#include "host/study/normal_distribution.h"
#include "host/study/study_keys.h"

namespace vkdose {

namespace {

constexpr const char* kKeyRemedy = "give a key of the base case with its table, e.g. \"contact.friction\"";

/// The value of a range as it would have been written.
Node rangeValue(const Node& place, double value, bool whole) {
    Node node;
    node.file = place.file;
    node.line = place.line;
    node.kind = whole ? Node::Kind::Integer : Node::Kind::Float;
    // Twelve digits: 0.3, not 0.30000000000000004.
    node.text = fmt::format("{:.12g}", value);
    node.number = nearestDecimal(value, 12);
    node.integer = whole ? std::llround(value) : 0;
    return node;
}

void readRange(CaseReader& reader, Section& table, const std::string& path, Axis& axis) {
    const double from = table.number("from");
    const double to = table.number("to");
    const std::int64_t steps = table.integer("steps");
    const Node* first = table.node("from");
    const Node* last = table.node("to");
    if (axis.keys.size() > 1)
        reader.fault(path + ".from", "a range is for a single key", "give values, a row for each point");
    if (from == to) reader.fault(path + ".to", "the range is empty", "give another end than from");
    if (first == nullptr || last == nullptr || !std::isfinite(from) || !std::isfinite(to)) return;
    bool whole = first->kind == Node::Kind::Integer && last->kind == Node::Kind::Integer;
    const auto at = [&](std::int64_t i) { return from + (to - from) * double(i) / double(steps - 1); };
    for (std::int64_t i = 0; i < steps; ++i) whole = whole && at(i) == std::round(at(i));
    for (std::int64_t i = 0; i < steps; ++i) axis.points.push_back({rangeValue(*first, at(i), whole)});
}

void readValues(CaseReader& reader, const Node& values, bool rows, const std::string& path, Axis& axis) {
    if (values.kind != Node::Kind::Array || values.children.empty()) {
        reader.fault(path, "is not a list of values", rows ? "give values = [[..., ...], ...]" : "give values = [...]");
        return;
    }
    std::set<std::string> seen;
    for (const Node& value : values.children) {
        if (!rows) {
            axis.points.push_back({value});
        } else if (value.kind == Node::Kind::Array && value.children.size() == axis.keys.size()) {
            axis.points.push_back(value.children);
        } else {
            reader.fault(path, fmt::format("{} is not a row of {} values", valueText(value), axis.keys.size()),
                         "give each point a value for each of the keys, in their order");
            return;
        }
        if (!seen.insert(valueText(value)).second)
            reader.fault(path, fmt::format("{} is there twice", valueText(value)), "name every point once");
    }
}

/// The numbers of a bound: one, or with `keys` one for each. Nothing after a fault.
std::optional<std::vector<double>> boundOf(CaseReader& reader, Section& table, const char* name,
                                           const std::string& path, std::size_t keys, bool rows) {
    const Node* node = table.node(name);
    std::vector<double> bound;
    if (node != nullptr && !rows && node->isNumber()) bound.push_back(node->number);
    if (node != nullptr && rows && node->kind == Node::Kind::Array)
        for (const Node& value : node->children)
            if (value.isNumber()) bound.push_back(value.number);
    if (bound.size() == keys) return bound;
    reader.fault(fmt::format("{}.{}", path, name), rows ? "is not a number for each of the keys" : "is not a number",
                 rows ? "give [..., ...] in the order of keys" : "give the bound in the unit of the key");
    return {};
}

/// Points of the Halton sequence. They fill the box evenly however many are taken, so that more may follow later.
void readBox(CaseReader& reader, Section& table, const std::string& path, bool rows, Axis& axis) {
    const std::size_t keys = axis.keys.size();
    const auto low = boundOf(reader, table, "low", path, keys, rows),
               high = boundOf(reader, table, "high", path, keys, rows);
    if (!table.has("points")) reader.fault(path + ".points", "is missing", "give the number of points in the box");
    const std::int64_t points = table.has("points") ? table.integer("points") : 0;
    if (!low || !high) return;
    for (std::size_t k = 0; k < keys; ++k)
        if (!((*low)[k] < (*high)[k]))
            return reader.fault(path + ".high", fmt::format("{:.6g} is not above {:.6g}", (*high)[k], (*low)[k]),
                                "give a higher bound");
    for (std::size_t k = 0; k < keys; ++k) axis.box.push_back({axis.keys[k], (*low)[k], (*high)[k]});
    for (int i = 1; i <= int(points); ++i) {
        const std::vector<double> at = haltonPoint(i, keys);
        std::vector<Node> point;
        for (std::size_t k = 0; k < keys; ++k) {
            const double value = nearestDecimal((*low)[k] + at[k] * ((*high)[k] - (*low)[k]), 6);
            point.push_back(rangeValue(*table.node("low"), value, false));
        }
        axis.points.push_back(std::move(point));
    }
}

/// A cell of a table as it would have been written in the study.
Node cellValue(const Node& place, const std::string& text) {
    Node node;
    node.file = place.file;
    node.line = place.line;
    node.text = text;
    const std::optional<double> number = numberOf(text);
    if (!number) {
        node.kind = Node::Kind::String;
        node.string = text;
        return node;
    }
    const bool whole = text.find_first_not_of("0123456789+-") == std::string::npos && std::abs(*number) < 1e15;
    node.kind = whole ? Node::Kind::Integer : Node::Kind::Float;
    node.number = *number;
    node.integer = whole ? std::llround(*number) : 0;
    return node;
}

/// The first rows of a table, as if they had been written at `place`.
std::vector<std::vector<Node>> rowsOf(const Table& csv, const Node& place, std::size_t count) {
    std::vector<std::vector<Node>> points;
    for (std::size_t row = 0; row < count; ++row) {
        std::vector<Node>& point = points.emplace_back();
        for (const std::string& cell : csv.row(row)) point.push_back(cellValue(place, cell));
    }
    return points;
}

/// The points are the rows of a CSV whose columns are keys.
void readTable(CaseReader& reader, Section& table, const std::string& path, const std::filesystem::path& folder,
               Axis& axis, std::set<std::string>& used) {
    const std::filesystem::path file = folder / table.string("table");
    if (!table.isString("table")) return;
    if (!requireFile(reader, path + ".table", file, "give the path of a CSV, relative to the study's folder")) return;
    const Table csv = Table::read(file, LastLine::Whole);
    axis.keys = csv.names();
    for (const std::string& key : axis.keys) checkKey(reader, path + ".table", key, used);
    const std::size_t points =
        table.has("points") ? std::size_t(std::max<std::int64_t>(0, table.integer("points"))) : csv.rows();
    if (points > csv.rows() || csv.rows() == 0)
        return reader.fault(path + (table.has("points") ? ".points" : ".table"),
                            fmt::format("{} has {} rows", file.filename().string(), csv.rows()),
                            "give no more points than it has, at least one");
    axis.points = rowsOf(csv, *table.node("table"), points);
}

void readKeys(CaseReader& reader, Section& table, const std::string& path, Axis& axis, std::set<std::string>& used) {
    const bool rows = table.has("keys");
    if (rows && table.has("key")) reader.fault(path + ".keys", "key is there too", "give key or keys, not both");
    const Node* keys = table.node("keys");
    const bool single = table.has("key") || !rows;
    if (single) axis.keys.push_back(table.string("key"));
    if (!single && keys->kind == Node::Kind::Array)
        for (const Node& key : keys->children) axis.keys.push_back(key.string);
    if (axis.keys.empty()) reader.fault(path + ".keys", "is not a list of keys", kKeyRemedy);
    if (!single || table.isString("key"))
        for (const std::string& key : axis.keys) checkKey(reader, path + (single ? ".key" : ".keys"), key, used);
}

}  // namespace

Axis axisOfTable(const std::filesystem::path& file, int points) {
    const Table csv = Table::read(file, LastLine::Whole);
    CaseReader reader(file.string(), Node{}, studyKeys());
    std::set<std::string> used;
    for (const std::string& key : csv.names()) checkKey(reader, "table", key, used);
    if (std::size_t(points) > csv.rows())
        reader.fault("table", fmt::format("has {} rows, and {} are asked for", csv.rows(), points),
                     "ask for no more than it has");
    reader.throwIfFaulty();
    Node place;
    place.file = file.string();
    return {csv.names(), rowsOf(csv, place, std::size_t(points)), {}};
}

bool checkKey(CaseReader& reader, const std::string& path, const std::string& key, std::set<std::string>& used) {
    if (!isKeyPath(key)) {
        reader.fault(path, fmt::format("\"{}\" is not the path of a key", key), kKeyRemedy);
    } else if (key == "seed") {
        reader.fault(path, "the seed is not an axis", "give seeds = [1, 2, 3]");
    } else if (key == "base" || key == "name" || key == "reason") {
        reader.fault(path, fmt::format("{} cannot be varied", key), kKeyRemedy);
    } else if (!used.insert(key).second) {
        reader.fault(path, fmt::format("{} is given twice", key), "keep it in one place");
    } else {
        return true;
    }
    return false;
}

Axis readAxis(CaseReader& reader, Section& table, const std::string& path, const std::filesystem::path& folder,
              std::set<std::string>& used) {
    Axis axis;
    const bool range = table.has("from") || table.has("to") || table.has("steps");
    const bool box = table.has("low") || table.has("high");
    const bool rows = table.has("keys");
    const std::pair<const char*, bool> ways[] = {
        {"table", table.has("table")}, {"low", box}, {"from", range}, {"values", table.has("values")}};
    for (const char* key : {"from", "to", "steps", "low", "high", "points", "table"}) table.know(key);
    const auto given = std::count_if(std::begin(ways), std::end(ways), [](const auto& way) { return way.second; });
    if (given > 1)
        for (const auto& [key, has] : ways)
            if (has && std::string_view(key) != "from")
                reader.fault(fmt::format("{}.{}", path, key), "the points are given in another way too",
                             "give values, a range, a box or a table");
    if (table.has("table")) {
        for (const char* key : {"key", "keys"})
            if (table.has(key))
                reader.fault(fmt::format("{}.{}", path, key), "the keys are the columns of the table", "leave it out");
        for (const char* key : {"key", "keys"}) table.know(key);
        readTable(reader, table, path, folder, axis, used);
        return axis;
    }
    readKeys(reader, table, path, axis, used);
    if (table.has("points") && !box)
        reader.fault(path + ".points", "is of a box or of a table", "give low and high, or table");
    if (box)
        readBox(reader, table, path, rows, axis);
    else if (range)
        readRange(reader, table, path, axis);
    else if (const Node* values = table.node("values"))
        readValues(reader, *values, rows && !table.has("key"), path + ".values", axis);
    else
        reader.fault(path, "has no values", "give values, or from, to and steps, or low, high and points, or a table");
    return axis;
}

}  // namespace vkdose
