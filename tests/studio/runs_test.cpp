// Runs and studies of the workbench: their events, how they are stopped and go on, and their members.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <thread>
#include <vector>

#include "host/core/error.h"
#include "host/studio/runs.h"
#include "tests/studio/bench.h"

using namespace vkdose;
using test::Bench;
using test::Folder;
using test::mini;
using Json = nlohmann::json;
namespace fs = std::filesystem;

TEST_CASE("a run of the workbench tells its events to who comes early and late, and is stopped and goes on") {
    const Folder folder;
    folder.write("my.toml", mini() + "\n[frames]\ninterval_s = 0.02\n");
    const Bench bench(folder.path());
    CHECK(bench.asked("/api/run", {{"name", "my.toml"}})["run"] == "out/my");
    // The stream ends with the run.
    const auto events = [&](const httplib::Headers& more = {},
                            const std::function<void(const std::string&)>& heard = {}) {
        httplib::Headers headers = bench.headers;
        headers.insert(more.begin(), more.end());
        std::string text;
        httplib::Client listener("http://" + bench.host);
        listener.set_read_timeout(300);
        const auto r = listener.Get("/api/events?run=out/my", headers, [&](const char* data, std::size_t size) {
            text.append(data, size);
            if (heard) heard(text);
            return true;
        });
        REQUIRE(r);
        CHECK(r->status == 200);
        return text;
    };
    const std::string all = events();
    CHECK_THAT(all, Catch::StartsWith("id: 0\ndata: {\"event\":\"run\"") && Catch::Contains("\"event\":\"dose\"") &&
                        Catch::Contains("event: over\ndata: {\"known\":true,\"code\":0"));
    CHECK(events() == all);
    CHECK_THAT(events({{"Last-Event-ID", "2"}}), Catch::StartsWith("id: 3\n"));
    CHECK(bench.post("/api/stop", {{"run", "out/my"}})->status == 409);
    CHECK(bench.post("/api/run", {{"name", "my.toml"}})->status == 409);  // a former run is there
    CHECK(Json::parse(bench.get("/api/folder")->body)["runs"] == Json{"out/my"});
    const Json history = Json::parse(bench.get("/api/history?run=out/my")->body);
    CHECK(history["doses"]["dose"] == Json{1, 2});
    CHECK(history["samples"]["time_s"].size() > 50);
    const Json frame = Json::parse(bench.get("/api/frame?run=out/my")->body);
    CHECK(frame["particles"] == 111);
    CHECK(frame["frames"]["time_s"].size() == 1);
    CHECK(frame["frames"]["dose"][0] == 2);
    bench.asked("/api/report", {{"run", "out/my"}});
    CHECK_THAT(bench.get("/file?run=out/my&name=report.html")->body, Catch::Contains("<html"));
    CHECK_THAT(bench.get("/file?run=out/my&name=doses.csv")->get_header_value("Content-Disposition"),
               Catch::Contains("attachment"));
    CHECK(bench.get("/file?run=out/my&name=film.mp4")->status == 404);
    CHECK(bench.get("/file?run=out/my&name=../../my.toml")->status == 403);
    CHECK(bench.post("/api/compare", {{"runs", {"out/my"}}})->status == 400);
    fs::copy(folder.path() / "out/my", folder.path() / "out/other");
    CHECK(bench.asked("/api/compare", {{"runs", {"out/my", "out/other"}}}) ==
          Json{{"run", "out"}, {"name", "comparison.html"}});
    CHECK_THAT(bench.get("/file?run=out&name=comparison.html")->body, Catch::Contains("<html"));

    // Stopped as soon as it is under way, it goes on where it was.
    bench.asked("/api/run", {{"name", "my.toml"}, {"force", true}});
    CHECK(bench.post("/api/run", {{"name", "my.toml"}, {"force", true}})->status == 500);  // it is going on
    bool stopped = false;
    const std::string cut = events({}, [&](const std::string& text) {
        if (stopped || text.find("\"event\":\"sample\"") == std::string::npos) return;
        stopped = true;
        bench.asked("/api/stop", {{"run", "out/my"}});
    });
    CHECK(stopped);
    CHECK_THAT(cut, Catch::Contains("\"code\":130"));
    bench.asked("/api/resume", {{"run", "out/my"}});
    CHECK_THAT(events(), Catch::Contains("\"code\":0"));
    CHECK(Json::parse(bench.get("/api/history?run=out/my")->body)["doses"] == history["doses"]);
}

TEST_CASE("a study tells what it will run, its members as they end, and each of them can be opened") {
    const Folder folder;
    folder.write("my.toml", mini());
    const std::string study =
        "base = \"my.toml\"\n[set]\n\"settle.time_s\" = 0.05\n\"dose.rotate_s\" = 0.1\n\"stop.max_doses\" = "
        "1\n[[axis]]\nkey = \"contact.friction\"\nvalues = [0.3, 0.5]\n";
    folder.write("study.toml", study);
    const Bench bench(folder.path());
    const Json listed = Json::parse(bench.get("/api/folder")->body);
    CHECK(listed["cases"] == Json{"my.toml"});
    CHECK(listed["studies"] == Json{"study.toml"});
    const Json plan = bench.asked("/api/check", {{"name", "study.toml"}, {"text", study}});
    CHECK(plan["study"] == "sweep");
    CHECK(plan["error"] == "");
    CHECK_THAT(plan["plan"].get<std::string>(), Catch::Contains("contact.friction 0.5"));
    const Json bad = bench.asked("/api/check", {{"name", "study.toml"}, {"text", study + "step = 3\n"}});
    CHECK_THAT(bad["error"].get<std::string>(), Catch::Contains("study.toml:9"));
    CHECK(bench.asked("/api/run", {{"name", "study.toml"}})["run"] == "out/study");
    httplib::Client listener("http://" + bench.host);
    listener.set_read_timeout(300);
    const auto told = listener.Get("/api/events?run=out/study", bench.headers);
    REQUIRE(told);
    CHECK_THAT(told->body, Catch::Contains("{\"event\":\"line\",\"text\":") && Catch::Contains("\"code\":0"));
    const Json members = Json::parse(bench.get("/api/members?run=out/study")->body);
    CHECK(members["ended"] == 2);
    CHECK(members["columns"][0] == "member");
    CHECK(Json::parse(bench.get("/api/folder")->body)["sweeps"] == Json{"out/study"});
    CHECK(Json::parse(bench.get("/api/history?run=out/study")->body)["study"] == true);
    const Json member = Json::parse(bench.get("/api/history?run=out/study/members/0001")->body);
    CHECK(member["doses"]["dose"] == Json{1});
    // A study that was changed finds a folder beside that of the former one.
    CHECK(bench.asked("/api/run", {{"name", "study.toml"}, {"beside", true}})["run"] == "out/study-2");
}

TEST_CASE("of pages that start a run at once one is told yes, and the others that it is going on") {
    const Folder folder;
    studio::Runs runs("/bin/cat", folder.path());  // reads its orders until it is stopped
    constexpr int kPages = 4, kRounds = 50;
    for (int round = 0; round < kRounds; ++round) {
        std::atomic<int> ready = 0, begun = 0, refused = 0;
        const auto start = [&] {
            ++ready;
            while (ready < kPages) std::this_thread::yield();
            try {
                runs.start("out/my", {});
                ++begun;
            } catch (const RunError&) {
                ++refused;
            }
        };
        std::vector<std::jthread> pages;
        for (int page = 0; page < kPages; ++page) pages.emplace_back(start);
        pages.clear();
        CHECK(begun == 1);
        CHECK(refused == kPages - 1);
        CHECK(runs.stop("out/my"));
        while (!runs.running().empty()) std::this_thread::yield();
    }
}
