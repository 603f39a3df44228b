#include "host/studio/server.h"

#include <fmt/format.h>
#include <httplib.h>

#include <chrono>
#include <thread>

#include "host/core/error.h"
#include "host/core/printable.h"
#include "host/studio/gate.h"
#include "host/studio/workbench.h"
#include "studio/parts.h"

namespace vkdose::studio {

namespace {

using std::chrono::milliseconds;

constexpr std::size_t kThreads = 16;
constexpr const char* kFile = "/file";  // what runs have left; pages among it have a policy of their own
constexpr const char* kPolicy =
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; connect-src 'self'; "
    "base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

void putJson(httplib::Response& response, const Json& json) {
    answerWith(response, json.dump(-1, ' ', false, Json::error_handler_t::replace), "application/json");
}

void route(httplib::Server& server, Workbench& bench) {
    using Request = httplib::Request;
    const auto get = [&](const char* path, const std::function<Json(const Request&)>& make) {
        server.Get(path, [make](const Request& request, httplib::Response& response) {
            response.set_header("Cache-Control", "no-store");
            putJson(response, make(request));
        });
    };
    const auto post = [&](const char* path, const std::function<Json(const Json&)>& make) {
        server.Post(path, [make](const Request& request, httplib::Response& response) {
            putJson(response, make(bodyOf(request)));
        });
    };
    get("/api/folder", [&](const Request&) { return bench.folder(); });
    get("/api/case", [&](const Request& r) { return bench.read(r.get_param_value("name")); });
    get("/api/keys", [&](const Request& r) { return bench.keys(r.has_param("study")); });
    get("/api/powders", [&](const Request&) { return bench.powders(); });
    get("/api/running", [&](const Request&) { return bench.running(); });
    get("/api/history", [&](const Request& r) { return bench.history(r.get_param_value("run")); });
    get("/api/members", [&](const Request& r) { return bench.members(r.get_param_value("run")); });
    get("/api/frame", [&](const Request& r) { return bench.frame(r.get_param_value("run")); });
    post("/api/check", [&](const Json& b) { return bench.check(textOf(b, "name"), textOf(b, "text")); });
    post("/api/allow", [&](const Json& b) {
        bench.allow(textOf(b, "text"));
        return Json::object();
    });
    post("/api/edit", [](const Json& b) { return Workbench::edit(b); });
    post("/api/new", [&](const Json& b) { return bench.make(b); });
    post("/api/save", [&](const Json& b) { return bench.save(b); });
    post("/api/run", [&](const Json& b) { return bench.start(b); });
    post("/api/resume", [&](const Json& b) { return bench.resume(textOf(b, "run")); });
    post("/api/stop", [&](const Json& b) { return bench.stop(textOf(b, "run")); });
    post("/api/order", [&](const Json& b) { return bench.order(textOf(b, "run"), textOf(b, "order")); });
    post("/api/report", [&](const Json& b) { return bench.report(textOf(b, "run")); });
    post("/api/compare", [&](const Json& b) { return bench.compare(b); });
    post("/api/picture", [&](const Json& b) { return bench.picture(textOf(b, "run"), b.value("film", false)); });
    server.Post("/api/mesh", [&](const Request& request, httplib::Response& response) {
        if (request.get_header_value("Content-Type") != "application/octet-stream")
            throw Refused(415, "the request is no file");
        putJson(response, bench.mesh(request.get_param_value("name"), request.body));
    });
    server.Get("/api/events", [&](const Request& r, httplib::Response& s) { bench.events(r, s); });
    server.Get(kFile, [&](const Request& r, httplib::Response& s) {
        bench.file(r.get_param_value("run"), r.get_param_value("name"), s);
    });
    for (const parts::Part& part : parts::kParts)
        server.Get(part.path, [part](const Request&, httplib::Response& response) {
            response.set_header("Cache-Control", "no-cache");
            answerWith(response, part.text, part.type);
        });
}

void guard(httplib::Server& server, const Gate& gate) {
    server.set_payload_max_length(kMostMesh);
    server.set_read_timeout(10);
    server.set_write_timeout(10);
    server.new_task_queue = [] { return new httplib::ThreadPool(kThreads); };
    server.set_pre_routing_handler([&gate](const httplib::Request& request, httplib::Response& response) {
        const Caller caller{request.get_header_value("Host"), request.get_header_value("Origin"),
                            request.get_header_value("Cookie"), request.get_param_value("token")};
        // A report has a policy of its own, by the hashes of what stands in it.
        response.set_header("Content-Security-Policy", request.path == kFile ? "frame-ancestors 'none'" : kPolicy);
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
            putJson(response, error);
        });
}

}  // namespace

void serve(const ServerOptions& options, const std::function<void(const std::string& address)>& listening,
           const std::atomic<bool>& stop) {
    Workbench workbench(options.folder, options.program, options.first, stop);
    httplib::Server server;
    const int port = options.port == 0                                ? server.bind_to_any_port("127.0.0.1")
                     : server.bind_to_port("127.0.0.1", options.port) ? options.port
                                                                      : -1;
    if (port <= 0)
        throw RunError(options.port == 0 ? "studio: no port can be opened"
                                         : fmt::format("studio: port {} is taken; leave --port out", options.port));
    const Gate gate(port);
    guard(server, gate);
    route(server, workbench);
    const std::jthread watcher([&](const std::stop_token& over) {
        // A server can be stopped once it listens, not before.
        while (!over.stop_requested() && !(stop && server.is_running())) std::this_thread::sleep_for(milliseconds(100));
        server.stop();
    });
    listening(gate.address());
    server.listen_after_bind();
}

}  // namespace vkdose::studio
