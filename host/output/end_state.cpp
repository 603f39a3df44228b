#include "host/output/end_state.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "host/core/error.h"
#include "host/core/file.h"
#include "host/model/particle_list.h"
#include "host/model/powders.h"
#include "host/output/summary.h"

namespace vkdose {

namespace {

using Json = nlohmann::ordered_json;

double numberIn(const Json& summary, const char* key, const std::filesystem::path& file) {
    const auto found = summary.find(key);
    if (found == summary.end() || !found->is_number())
        throw OutputError(fmt::format("{}: no number \"{}\" in it", file.string(), key));
    return found->get<double>();
}

}  // namespace

Frame readEndState(const std::filesystem::path& folder, const Case& c) {
    const std::filesystem::path file = folder / "summary.json", list = folder / "particles.csv";
    if (!InputFile::open(file)) throw OutputError(unreadable(file));
    const std::optional<Json> read = readSummary(folder);
    if (!read) throw OutputError(fmt::format("{}: no summary", file.string()));
    const Json& summary = *read;
    Frame frame;
    frame.time = numberIn(summary, "simulated_time_s", file);
    frame.step = std::uint64_t(numberIn(summary, "steps", file));
    frame.coilAngle = numberIn(summary, "coil_angle_rad", file);
    for (const Json& body : summary.value("bodies", Json::array())) {
        if (!body.is_object() || !body.contains("moved_s")) continue;
        Moved& moved = frame.bodiesMoved.emplace_back(numberIn(body, "moved_s", file));
        if (body.contains("turned_rad")) moved.angle = numberIn(body, "turned_rad", file);
        if (!body.contains("moved_x_m")) continue;
        moved.shift = {numberIn(body, "moved_x_m", file), numberIn(body, "moved_y_m", file),
                       numberIn(body, "moved_z_m", file)};
    }
    if (frame.bodiesMoved.size() != c.world.bodies.size()) frame.bodiesMoved.clear();
    const Json doses = summary.value("doses", Json::array());
    frame.dose = int(doses.size());
    frame.phase = frame.dose == 0 ? Phase::Settle : Phase::Rest;
    const Json ledger = summary.value("ledger", Json::object());
    if (ledger.value("canister_count", 1) + ledger.value("throat_count", 1) == 0)
        return frame;  // no particles are left, so none are read
    std::vector<Diagnostic> faults;
    std::vector<ListedPowder> powders;
    for (const PowderOf& p : powdersOf(c)) powders.push_back({p.name, p.material});
    frame.particles = readParticleList(list, faults, powders);
    if (!faults.empty()) throw OutputError(faults.front().text());
    return frame;
}

}  // namespace vkdose
