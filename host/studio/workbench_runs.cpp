// Runs and studies: started, watched, ordered about, stopped and gone on with.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <thread>

#include "host/core/csv_table.h"
#include "host/core/file.h"
#include "host/core/json.h"
#include "host/core/printable.h"
#include "host/model/case.h"
#include "host/report/player_data.h"
#include "host/studio/workbench.h"

namespace vkdose::studio {

namespace fs = std::filesystem;
using std::chrono::milliseconds;

namespace {

constexpr std::size_t kListeners = 8, kMostMembers = 500;
constexpr milliseconds kHeartbeat{1000}, kGather{250};

/// A run tells JSON, a study lines of text.
std::string eventOf(const std::string& line) {
    if (line.starts_with("{")) return line;
    return Json{{"event", "line"}, {"text", printable(line)}}.dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// The columns of the members' keys, which stand between seed and status.
std::vector<std::string> keysIn(const fs::path& members) {
    const std::vector<std::string> names = Table::salvage(members).names();
    const auto seed = std::find(names.begin(), names.end(), "seed"), status = std::find(seed, names.end(), "status");
    return seed == names.end() ? std::vector<std::string>() : std::vector<std::string>(seed + 1, status);
}

}  // namespace

Json Workbench::start(const Json& body) {
    const fs::path file = caseOf(textOf(body, "name"));
    requireAllowed(file);
    std::string run = "out/" + file.stem().string();
    for (int n = 2; body.value("beside", false) && fs::exists(fileOf(run)); ++n)
        run = fmt::format("out/{}-{}", file.stem().string(), n);
    const fs::path out = fileOf(run);
    if (const char* command = commandOfStudy(fileContent(file).value_or(""))) {
        runs_.start(run, {command, file.string(), "--out", out.string()});  // it goes on if it was there
        return {{"run", run}};
    }
    const bool force = body.value("force", false);
    std::error_code code;
    if (!force && fs::exists(out / "case.toml", code))
        throw Refused(409, fmt::format("{} holds a former run", printable(run)));
    std::vector<std::string> words{"run", file.string(), "--events", "--orders", "--out", out.string()};
    if (force) words.emplace_back("--force");
    runs_.start(run, words);
    return {{"run", run}};
}

Json Workbench::resume(const std::string& run) {
    const fs::path folder = fileOf(run);
    requireAllowed(folder / "case.toml");
    runs_.start(run, {"resume", folder.string(), "--events", "--orders"});
    return {{"run", run}};
}

Json Workbench::stop(const std::string& run) {
    if (!runs_.stop(run)) throw Refused(409, fmt::format("{} does not run", printable(run)));
    return {{"run", run}};
}

Json Workbench::order(const std::string& run, const std::string& line) {
    if (line.find('\n') != std::string::npos || line.size() > 200) throw Refused(400, "an order is one short line");
    if (!runs_.tell(run, line)) throw Refused(409, fmt::format("{} takes no orders now", printable(run)));
    return {{"run", run}};
}

/// The newest picture of a run as the player takes it; null as long as there is none.
Json Workbench::frame(const std::string& run) const {
    const fs::path folder = fileOf(run);
    const auto text = fileContent(folder / "case.toml");
    std::error_code code;
    if (!text || !fs::exists(folder / kFramesFolder / kFramesIndex, code)) return nullptr;
    report::FrameSource frames = report::framesOf(folder);
    if (frames.entries.empty()) return nullptr;
    frames.entries = {frames.entries.back()};
    return report::playerJson(loadResolvedCase(*text, folder / "case.toml"), frames, 0);
}

/// The columns of a run's tables so far: what its events were before this workbench began, or before it went on.
Json Workbench::history(const std::string& run) const {
    const fs::path folder = fileOf(run);
    const auto columns = [&](const char* file, std::initializer_list<const char*> names) {
        const Table table = Table::salvage(folder / file);
        Json json = Json::object();
        for (const char* name : names) json[name] = table.has(name) ? jsonNumbers(table.column(name)) : Json::array();
        return json;
    };
    std::error_code code;
    return {
        {"study", fs::exists(folder / "members.csv", code)},
        {"samples", columns("timeseries.csv", {"time_s", "dosed_mass_kg", "coil_torque_Nm"})},
        {"doses", columns("doses.csv", {"dose", "mass_kg", "cumulative_mass_kg", "complete", "closed_form_mass_kg"})}};
}

/// The members of a study so far, a row each as text; once it is over, with the figures of each.
Json Workbench::members(const std::string& study) const {
    const fs::path folder = fileOf(study);
    std::error_code code;
    const bool over = fs::exists(folder / "figures.csv", code);
    const Table table = Table::salvage(folder / (over ? "figures.csv" : "members.csv"));
    Json rows = Json::array();
    for (std::size_t i = 0; i < std::min(table.rows(), kMostMembers); ++i) {
        Json& row = rows.emplace_back(Json::array());
        for (const std::string& field : table.row(i)) row.push_back(printable(field));
    }
    std::size_t ended = 0;  // one that was interrupted will be run again
    for (std::size_t i = 0; i < table.rows(); ++i)
        ended += !table.has("status") || table.text(i, "status") != "interrupted" ? 1 : 0;
    return {{"columns", table.names()}, {"keys", keysIn(folder / "members.csv")}, {"rows", rows}, {"ended", ended}};
}

void Workbench::events(const httplib::Request& request, httplib::Response& response) {
    const std::string run = request.get_param_value("run");
    (void)fileOf(run);
    std::size_t from = 0;
    const std::string last = request.get_header_value("Last-Event-ID");
    if (std::from_chars(last.data(), last.data() + last.size(), from).ec == std::errc()) ++from;
    if (++listeners_ > kListeners) {
        --listeners_;
        throw Refused(503, "too many pages of this workbench are open; close one");
    }
    response.set_header("Cache-Control", "no-store");
    response.set_chunked_content_provider(
        "text/event-stream",
        [this, run, from](std::size_t, httplib::DataSink& sink) mutable {
            const Runs::State state = runs_.eventsOf(run, from, kHeartbeat);
            std::string text;
            for (std::size_t i = 0; i < state.events.size(); ++i)
                text += fmt::format("id: {}\ndata: {}\n\n", from + i, eventOf(state.events[i]));
            from = state.next;
            const bool over = !state.running || stop_;
            if (over)
                text += fmt::format(
                    "event: over\ndata: {}\n\n",
                    Json{{"known", state.known}, {"code", state.code}, {"error", printableLines(state.error)}}.dump(
                        -1, ' ', false, Json::error_handler_t::replace));
            if (text.empty()) text = ":\n\n";  // a page that is gone is noticed by this
            const bool heard = sink.write(text.data(), text.size());
            if (over && heard) sink.done();
            // Each message wakes the browser, whose work takes from the run; so what comes meanwhile goes together.
            if (!over && heard && !state.events.empty()) std::this_thread::sleep_for(kGather);
            return heard;
        },
        [this](bool) { --listeners_; });
}

}  // namespace vkdose::studio
