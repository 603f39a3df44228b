#include "host/bench/results_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace vkdose::bench {

namespace {

using Json = nlohmann::ordered_json;

Json figuresOf(const Row& r) {
    Json j{{"particles", r.particles},
           {"copies", r.copies},
           {"members", r.members},
           {"repeats", r.repeats},
           {"particle_steps_per_s", r.speed.particleSteps.median},
           {"particle_steps_per_s_low", r.speed.particleSteps.low},
           {"particle_steps_per_s_high", r.speed.particleSteps.high}};
    if (r.members > 1) j["table_bytes_per_particle"] = r.tableBytes;
    if (r.onlySpeed()) return j;
    j["steps"] = r.speed.steps;
    j["cores_busy"] = r.speed.coresBusy.median;
    j["listed_per_particle"] = r.listed;
    j["touching_per_particle"] = r.coordination.touching;
    if (r.plain) return j;
    j["walls_per_particle"] = r.coordination.walls;
    j["contacts_per_s"] = r.contactsPerSecond;
    j["rebuilds_per_1000_steps"] = r.rebuildsPer1000;
    j["refreshes_per_1000_steps"] = r.refreshesPer1000;
    j["start_up_s"] = r.startUp;
    j["table_bytes_per_particle"] = r.tableBytes;
    j["bytes_per_particle_step_estimated"] = r.stepBytes;
    j["bandwidth_estimated_bytes_per_s"] = r.bandwidth();
    j["bandwidth_of_copy_bytes_per_s"] = r.copyBandwidth;
    for (const PassTime& p : r.passes) j["pass_" + p.name + "_s"] = p.seconds;
    if (!r.passes.empty()) j["rebuild_s"] = r.rebuildSeconds;
    return j;
}

Json rowOf(const Row& r) {
    Json j{{"workload", r.workload}, {"on", r.on}};
    if (!r.driver.empty()) j["driver"] = r.driver;
    if (!r.processor.empty()) j["processor"] = r.processor;
    if (r.refused.empty())
        j.update(figuresOf(r));
    else
        j["refused"] = r.refused;
    return j;
}

std::string cell(const Json& value) {
    if (!value.is_string()) return value.dump();
    std::string quoted = "\"";
    for (const char c : value.get<std::string>()) quoted += c == '"' ? "\"\"" : std::string(1, c);
    return quoted + "\"";
}

}  // namespace

std::string headLine() {
    return fmt::format("{:<20} {:>9} {:>9} {:>17} {:>10} {:>7} {:>7} {:>7} {:>9} {:>6}", "workload", "particles",
                       "Mps/s", "low ... high", "Mcontact/s", "listed", "touch", "walls", "rebuilds", "cores");
}

std::string tableLine(const Row& r) {
    const std::string several = r.copies > 1    ? fmt::format(" x{}", r.copies)
                                : r.members > 1 ? fmt::format(", {} in one", r.members)
                                                : "";
    const std::string name = r.plain ? "  plain loop" : r.workload + several;
    if (!r.refused.empty()) return fmt::format("{:<20} {:>9} refused: {}", name, r.particles, r.refused);
    const Spread& s = r.speed.particleSteps;
    std::string speed = fmt::format("{:<20} {:>9} {:>9.3f} {:>17}", name, r.particles, s.median * 1e-6,
                                    fmt::format("{:.3f} ... {:.3f}", s.low * 1e-6, s.high * 1e-6));
    if (r.onlySpeed()) return speed;
    const std::string own = r.plain ? fmt::format("{:>10}", "") : fmt::format("{:>10.2f}", r.contactsPerSecond * 1e-6);
    const std::string rest = r.plain ? fmt::format("{:>7} {:>9}", "", "")
                                     : fmt::format("{:>7.2f} {:>9.2f}", r.coordination.walls, r.rebuildsPer1000);
    return fmt::format("{} {} {:>7.2f} {:>7.2f} {} {:>6.2f}", speed, own, r.listed, r.coordination.touching, rest,
                       r.speed.coresBusy.median);
}

std::string detailLines(const Row& r) {
    if (r.plain || r.onlySpeed() || !r.refused.empty()) return {};
    std::string text;
    if (r.passes.empty()) {
        text += "    this device keeps no time for its passes\n";
    } else {
        text += "    us per step ";
        for (const PassTime& p : r.passes) text += fmt::format(" {} {:.1f}", p.name, p.seconds * 1e6);
        text += fmt::format("; one rebuild {:.0f}; {:.1f} refreshes in 1000 steps\n", r.rebuildSeconds * 1e6,
                            r.refreshesPer1000);
    }
    return text + fmt::format(
                      "    tables {:.0f} B/particle; a step moves about {:.0f} B/particle (estimated): {:.2f} GB/s "
                      "of a copy's {:.2f}; first step after {:.2f} s",
                      r.tableBytes, r.stepBytes, r.bandwidth() * 1e-9, r.copyBandwidth * 1e-9, r.startUp);
}

std::string machineLines(const Row& r) {
    std::string text = "on " + r.on;
    if (!r.driver.empty()) text += "\ndriver " + r.driver;
    if (!r.processor.empty()) text += "\nprocessor " + r.processor;
    return text;
}

std::string jsonTable(const std::vector<Row>& rows) {
    Json j = Json::array();
    for (const Row& r : rows) j.push_back(rowOf(r));
    return Json{{"results", j}}.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string ratioLine(const std::vector<Row>& rows, const std::string& name, const std::string& without) {
    const auto speedOf = [&rows](const std::string& workload) {
        for (const Row& r : rows)
            if (r.workload == workload && !r.plain && r.refused.empty()) return r.speed.particleSteps.median;
        return 0.0;
    };
    const double speed = speedOf(name), before = speedOf(without);
    if (!(speed > 0) || !(before > 0)) return "";
    return fmt::format("{}: a step of a sphere takes {:.2f} times as long as in {}", name, before / speed, without);
}

std::string csvTable(const std::vector<Row>& rows) {
    std::vector<std::string> columns;
    for (const Row& r : rows) {
        const Json j = rowOf(r);
        for (auto it = j.begin(); it != j.end(); ++it)
            if (std::find(columns.begin(), columns.end(), it.key()) == columns.end()) columns.push_back(it.key());
    }
    std::string text;
    for (const std::string& c : columns) text += (text.empty() ? "" : ",") + c;
    text += "\n";
    for (const Row& r : rows) {
        const Json j = rowOf(r);
        std::string line;
        for (const std::string& c : columns) line += "," + (j.contains(c) ? cell(j[c]) : "");
        text += line.substr(1) + "\n";
    }
    return text;
}

}  // namespace vkdose::bench
