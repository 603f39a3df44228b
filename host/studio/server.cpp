#include "host/studio/server.h"

#include <fmt/format.h>
#include <httplib.h>

#include <charconv>
#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

#include "host/core/csv_table.h"
#include "host/core/error.h"
#include "host/core/file.h"
#include "host/core/json.h"
#include "host/core/printable.h"
#include "host/model/case.h"
#include "host/report/player_data.h"
#include "host/studio/gate.h"
#include "host/studio/own_law.h"
#include "host/studio/runs.h"
#include "host/studio/workspace.h"
#include "studio/parts.h"

namespace vkdose::studio {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using std::chrono::milliseconds;

constexpr std::size_t kMostBytes = 4 << 20;  // of a request
constexpr std::size_t kThreads = 16, kListeners = 8;
constexpr milliseconds kCheckLimit{20000}, kReportLimit{120000}, kHeartbeat{1000};
constexpr const char* kPolicy =
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; connect-src 'self'; "
    "base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

/// A request that cannot be done: its status, and why in words for the page.
struct Refused : std::runtime_error {
    Refused(int code, const std::string& why) : std::runtime_error(why), status(code) {}
    int status;
};

Json bodyOf(const httplib::Request& request) {
    // What is no JSON of the page, a form of another site say, is told apart by its type.
    if (request.get_header_value("Content-Type").rfind("application/json", 0) != 0)
        throw Refused(415, "the request is no JSON");
    Json body = Json::parse(request.body, nullptr, false);
    if (!body.is_object()) throw Refused(400, "the request is no JSON object");
    return body;
}

std::string textOf(const Json& body, const char* name) {
    if (!body.contains(name) || !body[name].is_string()) throw Refused(400, fmt::format("{} is missing", name));
    return body[name].get<std::string>();
}

/// A file beside a case for the time of a check, so that paths in the text mean what they will mean.
class Draft {
  public:
    Draft(const fs::path& beside, const std::string& text) {
        static std::atomic<int> count{0};
        file_ = beside.parent_path() / fmt::format(".{}-{}-{}.toml", beside.stem().string(), ::getpid(), ++count);
        replaceFile(file_, text);
    }
    ~Draft() {
        std::error_code ignored;
        fs::remove(file_, ignored);
    }
    Draft(const Draft&) = delete;
    Draft& operator=(const Draft&) = delete;
    const fs::path& file() const { return file_; }

  private:
    fs::path file_;
};

class Workbench {
  public:
    explicit Workbench(const ServerOptions& options)
        : workspace_(options.folder),
          program_(options.program),
          first_(options.first),
          runs_(program_, workspace_.folder()) {}

    void route(httplib::Server& server, const std::atomic<bool>& stop);

  private:
    using Answer = std::function<Json(const httplib::Request&)>;

    fs::path fileOf(const std::string& name) const {
        const auto file = workspace_.inside(name);
        if (!file) throw Refused(403, fmt::format("{} is not in the folder of this workbench", printable(name)));
        return *file;
    }
    fs::path caseOf(const std::string& name) const {
        fs::path file = fileOf(name);
        if (file.extension() != ".toml") throw Refused(403, fmt::format("{} is no case file (.toml)", printable(name)));
        return file;
    }
    /// The law that nobody has allowed yet; nothing if there is none.
    std::optional<OwnLaw> lawToAskFor(const fs::path& file) const {
        auto law = ownLawOf(file);
        if (law && laws_.has(law->text)) law.reset();
        return law;
    }
    void requireAllowed(const fs::path& file) const {
        if (const auto law = lawToAskFor(file))
            throw Refused(403, fmt::format("{} is a law that nobody has allowed; open the case", printable(law->file)));
    }
    /// What the program prints as one JSON object.
    Json asked(const std::vector<std::string>& arguments, milliseconds limit) const {
        std::string text;
        const Ended ended =
            Child(program_, arguments, workspace_.folder()).read([&](const std::string& l) { text += l; }, limit);
        Json json = Json::parse(text, nullptr, false);
        if (!json.is_discarded()) return json;
        throw Refused(500, ended.error.empty() ? fmt::format("the program ended with {}", ended.code) : ended.error);
    }

    Json folder() const;
    Json read(const std::string& name) const;
    Json check(const std::string& name, const std::string& text) const;
    Json save(const Json& body) const;
    Json start(const Json& body);
    Json resume(const std::string& run);
    Json stop(const std::string& run);
    Json frame(const std::string& run) const;
    Json history(const std::string& run) const;
    void events(const httplib::Request& request, httplib::Response& response, const std::atomic<bool>& stop);

    Workspace workspace_;
    fs::path program_, first_;
    AllowedLaws laws_;
    Runs runs_;
    std::atomic<std::size_t> listeners_{0};
};

Json Workbench::folder() const {
    Json cases = Json::array(), runs = Json::array();
    for (const Workspace::Entry& e : workspace_.entries()) (e.run ? runs : cases).push_back(printable(e.name));
    return {{"folder", printable(workspace_.folder().string())}, {"cases", cases}, {"runs", runs}};
}

Json Workbench::read(const std::string& name) const {
    const fs::path file = caseOf(name);
    const auto text = fileContent(file);
    if (!text) throw Refused(404, fmt::format("{} cannot be read", printable(name)));
    if (text->size() > kMostBytes) throw Refused(413, fmt::format("{} is larger than 4 MiB", printable(name)));
    return {{"name", name}, {"text", *text}};
}

Json Workbench::check(const std::string& name, const std::string& text) const {
    const fs::path file = caseOf(name);
    std::error_code code;
    if (!fs::is_directory(file.parent_path(), code))
        throw Refused(404, fmt::format("there is no folder for {}", printable(name)));
    const Draft draft(file, text);
    if (const auto law = lawToAskFor(draft.file())) return {{"law", {{"file", law->file}, {"text", law->text}}}};
    Json json = asked({"check", draft.file().string(), "--json", "--assume", "--scene"}, kCheckLimit);
    for (Json& error : json["errors"])
        if (error.value("file", "") == printable(draft.file().string())) error["file"] = "";
    json.erase("file");
    return json;
}

/// `before` is the text that the page has read; null for a new case. A file that has changed since is not replaced.
Json Workbench::save(const Json& body) const {
    const std::string name = textOf(body, "name"), text = textOf(body, "text");
    const fs::path file = caseOf(name);
    const auto there = fileContent(file);
    const bool fresh = !body.contains("before") || body["before"].is_null();
    if (fresh && there) throw Refused(409, fmt::format("{} is there already; choose another name", printable(name)));
    if (!fresh && there && *there != textOf(body, "before") && *there != text)
        throw Refused(409, fmt::format("{} was changed by another program; open it again", printable(name)));
    std::error_code code;
    fs::create_directories(file.parent_path(), code);
    replaceFile(file, text);
    return {{"name", name}};
}

Json Workbench::start(const Json& body) {
    const fs::path file = caseOf(textOf(body, "name"));
    requireAllowed(file);
    const std::string run = "out/" + file.stem().string();
    const fs::path out = fileOf(run);
    const bool force = body.value("force", false);
    std::error_code code;
    if (!force && fs::exists(out / "case.toml", code))
        throw Refused(409, fmt::format("{} holds a former run", printable(run)));
    std::vector<std::string> words{"run", file.string(), "--events", "--out", out.string()};
    if (force) words.emplace_back("--force");
    runs_.start(run, words);
    return {{"run", run}};
}

Json Workbench::resume(const std::string& run) {
    const fs::path folder = fileOf(run);
    requireAllowed(folder / "case.toml");
    runs_.start(run, {"resume", folder.string(), "--events"});
    return {{"run", run}};
}

Json Workbench::stop(const std::string& run) {
    if (!runs_.stop(run)) throw Refused(409, fmt::format("{} does not run", printable(run)));
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
    return {
        {"samples", columns("timeseries.csv", {"time_s", "dosed_mass_kg", "coil_torque_Nm"})},
        {"doses", columns("doses.csv", {"dose", "mass_kg", "cumulative_mass_kg", "complete", "closed_form_mass_kg"})}};
}

/// Server-sent events: each event of the run with its number, so that a page that was cut off goes on where it was.
void Workbench::events(const httplib::Request& request, httplib::Response& response, const std::atomic<bool>& stop) {
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
        [this, run, from, &stop](std::size_t, httplib::DataSink& sink) mutable {
            const Runs::State state = runs_.eventsOf(run, from, kHeartbeat);
            std::string text;
            for (std::size_t i = 0; i < state.events.size(); ++i)
                text += fmt::format("id: {}\ndata: {}\n\n", from + i, state.events[i]);
            from = state.next;
            const bool over = !state.running || stop;
            if (over)
                text += fmt::format(
                    "event: over\ndata: {}\n\n",
                    Json{{"known", state.known}, {"code", state.code}, {"error", printable(state.error)}}.dump(
                        -1, ' ', false, Json::error_handler_t::replace));
            if (text.empty()) text = ":\n\n";  // a page that is gone is noticed by this
            const bool heard = sink.write(text.data(), text.size());
            if (over && heard) sink.done();
            return heard;
        },
        [this](bool) { --listeners_; });
}

void Workbench::route(httplib::Server& server, const std::atomic<bool>& stopped) {
    const auto answer = [](const Answer& make) {
        return [make](const httplib::Request& request, httplib::Response& response) {
            response.set_header("Cache-Control", "no-store");
            response.set_content(make(request).dump(-1, ' ', false, Json::error_handler_t::replace),
                                 "application/json");
        };
    };
    const auto name = [](const httplib::Request& request, const char* key) { return request.get_param_value(key); };
    server.Get("/api/folder", answer([this](const auto&) { return folder(); }));
    server.Get("/api/case", answer([this, name](const auto& r) { return read(name(r, "name")); }));
    server.Get("/api/first", answer([this](const auto&) { return Json{{"text", fileContent(first_).value_or("")}}; }));
    server.Get("/api/running", answer([this](const auto&) { return Json(runs_.running()); }));
    server.Get("/api/history", answer([this, name](const auto& r) { return history(name(r, "run")); }));
    server.Get("/api/frame", answer([this, name](const auto& r) { return frame(name(r, "run")); }));
    server.Post("/api/check", answer([this](const auto& r) {
                    const Json body = bodyOf(r);
                    return check(textOf(body, "name"), textOf(body, "text"));
                }));
    server.Post("/api/allow", answer([this](const auto& r) {
                    laws_.allow(textOf(bodyOf(r), "text"));
                    return Json::object();
                }));
    server.Post("/api/save", answer([this](const auto& r) { return save(bodyOf(r)); }));
    server.Post("/api/run", answer([this](const auto& r) { return start(bodyOf(r)); }));
    server.Post("/api/resume", answer([this](const auto& r) { return resume(textOf(bodyOf(r), "run")); }));
    server.Post("/api/stop", answer([this](const auto& r) { return stop(textOf(bodyOf(r), "run")); }));
    server.Post("/api/report", answer([this](const auto& r) {
                    const std::string run = textOf(bodyOf(r), "run");
                    const Ended ended = Child(program_, {"report", fileOf(run).string()}, workspace_.folder())
                                            .read([](const std::string&) {}, kReportLimit);
                    if (ended.code != 0) throw Refused(409, ended.error);
                    return Json{{"run", run}};
                }));
    server.Get("/api/events",
               [this, &stopped](const auto& request, auto& response) { events(request, response, stopped); });
    server.Get("/report", [this, name](const httplib::Request& request, httplib::Response& response) {
        const auto page = fileContent(fileOf(name(request, "run")) / "report.html");
        if (!page) throw Refused(404, "this run has no report yet");
        response.set_content(*page, "text/html; charset=utf-8");  // it has a policy of its own
    });
    for (const parts::Part& part : parts::kParts)
        server.Get(part.path, [part](const httplib::Request&, httplib::Response& response) {
            response.set_header("Cache-Control", "no-cache");
            response.set_content(part.text, part.type);
        });
}

void guard(httplib::Server& server, const Gate& gate) {
    server.set_payload_max_length(kMostBytes);
    server.set_read_timeout(10);
    server.set_write_timeout(10);
    server.new_task_queue = [] { return new httplib::ThreadPool(kThreads); };
    server.set_pre_routing_handler([&gate](const httplib::Request& request, httplib::Response& response) {
        const Caller caller{request.get_header_value("Host"), request.get_header_value("Origin"),
                            request.get_header_value("Cookie"), request.get_param_value("token")};
        // A report has a policy of its own, by the hashes of what stands in it.
        response.set_header("Content-Security-Policy", request.path == "/report" ? "frame-ancestors 'none'" : kPolicy);
        response.set_header("X-Content-Type-Options", "nosniff");
        response.set_header("Referrer-Policy", "no-referrer");
        if (const auto why = gate.refusal(caller)) {
            response.status = 403;
            response.set_content(*why + "\n", "text/plain; charset=utf-8");
            return httplib::Server::HandlerResponse::Handled;
        }
        if (!Gate::isFirst(caller)) return httplib::Server::HandlerResponse::Unhandled;
        // The token leaves the address, so that it is in no bookmark and no history of what comes.
        response.set_header("Set-Cookie", gate.cookie());
        response.set_redirect("/");
        return httplib::Server::HandlerResponse::Handled;
    });
    server.set_exception_handler(
        [](const httplib::Request&, httplib::Response& response, const std::exception_ptr& thrown) {
            Json error;
            try {
                std::rethrow_exception(thrown);
            } catch (const Refused& e) {
                response.status = e.status;
                error["error"] = printable(e.what());
            } catch (const std::exception& e) {
                response.status = 500;
                error["error"] = printable(e.what());
            }
            response.set_content(error.dump(-1, ' ', false, Json::error_handler_t::replace), "application/json");
        });
}

}  // namespace

void serve(const ServerOptions& options, const std::function<void(const std::string& address)>& listening,
           const std::atomic<bool>& stop) {
    Workbench workbench(options);
    httplib::Server server;
    const int port = options.port == 0                                ? server.bind_to_any_port("127.0.0.1")
                     : server.bind_to_port("127.0.0.1", options.port) ? options.port
                                                                      : -1;
    if (port <= 0)
        throw RunError(options.port == 0 ? "studio: no port can be opened"
                                         : fmt::format("studio: port {} is taken; leave --port out", options.port));
    const Gate gate(port);
    guard(server, gate);
    workbench.route(server, stop);
    std::thread watcher([&] {
        while (!stop && server.is_valid()) std::this_thread::sleep_for(milliseconds(100));
        server.stop();
    });
    listening(gate.address());
    server.listen_after_bind();
    watcher.join();
}

}  // namespace vkdose::studio
