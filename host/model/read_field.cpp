// The tables [[field]]: fields that a run takes while it goes on.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "host/model/case_sections.h"

namespace vkdose {
namespace {

using Preset = FieldSensor::Preset;

/// The box of a preset and which of its directions it resolves.
struct Frame {
    Vec3 low, high;
    Vec3 along;  ///< 1 where it resolves
};

Frame frameOf(Preset preset, const Canister& can, double width) {
    const double half = can.width / 2, top = can.height - half, hole = can.outletDiameter / 2;
    const double end = can.length + can.throatLength;
    switch (preset) {
        case Preset::HeightProfile:
            return {{-half, -half, 0}, {half, top, can.length}, {0, 0, 1}};
        case Preset::MidPlane:
            return {{-width, -half, 0}, {width, top, end}, {0, 1, 1}};
        case Preset::Outlet:
            return {{-hole, -hole, can.length}, {hole, hole, end}, {0, 0, 0}};
        case Preset::None:
            break;
    }
    return {{-half, -half, 0}, {half, top, end}, {1, 1, 1}};
}

/// Default cells. They are as wide as the kernel's width, and half as wide for Lucy's kernel, which is zero beyond its
/// width.
Vec3 defaultCells(const Frame& frame, const FieldRequest& request) {
    const double cell = request.kernel == Kernel::Lucy ? request.width / 2 : request.width;
    Vec3 cells(1);
    for (int d = 0; d < 3; ++d)
        if (frame.along[d] > 0) cells[d] = std::max(1.0, std::ceil((frame.high[d] - frame.low[d]) / cell - 1e-9));
    return cells;
}

bool readCells(CaseReader& reader, Section& section, const Vec3& fallback, FieldGrid& grid) {
    const Vec3 cells = section.vector("cells", fallback);
    for (int d = 0; d < 3; ++d) {
        if (!std::isfinite(cells[d])) return false;
        if (cells[d] < 1 || cells[d] != std::round(cells[d]) || cells[d] > double(kMostFieldPoints)) {
            reader.fault(section.path("cells"), fmt::format("{} is no number of cells", cells[d]),
                         fmt::format("give whole numbers from 1 to {}", kMostFieldPoints));
            return false;
        }
        grid.cells[std::size_t(d)] = std::uint32_t(cells[d]);
    }
    return true;
}

bool finite(const Vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

void readGrid(CaseReader& reader, Section& section, const std::optional<Canister>& canister, FieldSensor& sensor) {
    FieldRequest& request = sensor.request;
    std::optional<Vec3> low, high;
    Frame frame{Vec3(0), Vec3(0), Vec3(1)};
    if (canister) {
        frame = frameOf(sensor.preset, *canister, request.width);
        low = frame.low;
        high = frame.high;
    } else if (sensor.preset != Preset::None) {
        reader.fault(section.path("preset"), "needs a canister", "leave it out and give low, high and cells");
        section.abandon();
        return;
    }
    frame.low = request.grid.low = section.vector("low", low);
    frame.high = request.grid.high = section.vector("high", high);
    const bool known = finite(frame.low) && finite(frame.high) && std::isfinite(request.width);
    if (!known) section.know("cells");
    if (!known || !readCells(reader, section, defaultCells(frame, request), request.grid)) return;
    if (const std::optional<std::string> fault = faultOf(request)) {
        const std::size_t colon = fault->find(": ");
        const bool box = fault->find("volume") != std::string::npos;
        reader.fault(section.path(box ? "low" : "cells"), fault->substr(0, colon), fault->substr(colon + 2));
    }
}

void checkName(CaseReader& reader, const std::string& path, const std::string& name, std::set<std::string>& names) {
    const auto bad = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '-' && c != '_'; };
    if (name.empty() || name.size() > 100 || std::any_of(name.begin(), name.end(), bad))
        reader.fault(path, fmt::format("\"{}\" is no name for a file", name.substr(0, 100)),
                     "give letters, digits, - and _");
    else if (!names.insert(name).second)
        reader.fault(path, fmt::format("there are two fields \"{}\"", name), "give each a name of its own");
}

}  // namespace

std::vector<FieldSensor> readFields(CaseReader& reader, Section& root, const std::vector<ListedPowder>& powders,
                                    const std::optional<Canister>& canister, double sensorInterval,
                                    std::optional<double> meanDiameter) {
    std::vector<FieldSensor> fields;
    std::set<std::string> names;
    for (Section* section : root.tables("field")) {
        FieldSensor sensor;
        const auto preset = section->choice("preset");
        sensor.preset = static_cast<Preset>(preset.value_or(0));
        const std::string fallback =
            sensor.preset == Preset::None ? fmt::format("field-{}", names.size() + 1) : section->node("preset")->string;
        sensor.name = section->string("name", fallback);
        if (!section->has("name") || section->isString("name"))
            checkName(reader, section->path("name"), sensor.name, names);
        FieldRequest& request = sensor.request;
        request.material = readPowderName(reader, *section, powders);
        request.kernel = static_cast<Kernel>(section->choice("kernel").value_or(0));
        const double width = (request.kernel == Kernel::Lucy ? 2 : 1) * meanDiameter.value_or(kNaN);
        request.width = section->number("width_mm", std::round(width * 1e9) / 1e6);
        sensor.average = section->boolean("average");
        sensor.stress = request.contactStress = section->boolean("stress");
        readGrid(reader, *section, canister, sensor);
        const bool map = request.grid.resolvedDirections() > 1;
        sensor.interval = section->number("interval_s", (map ? 10 : 1) * sensorInterval);
        if (sensor.preset == Preset::HeightProfile) sensor.initialHeight = section->number("initial_height_mm");
        fields.push_back(std::move(sensor));
    }
    return fields;
}

}  // namespace vkdose
