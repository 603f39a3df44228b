// The workbench, asked as its page asks it and as no page should.

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "host/app/new_study.h"
#include "host/app/new_template.h"
#include "tests/studio/bench.h"

using namespace vkdose;
using test::Bench;
using test::Folder;
using test::mini;
using Json = nlohmann::json;
namespace fs = std::filesystem;

TEST_CASE("the workbench answers who has its token, and no other site") {
    const Folder folder;
    const Bench bench(folder.path());
    CHECK(bench.get("/")->status == 200);
    CHECK_THAT(bench.get("/")->get_header_value("Content-Security-Policy"), Catch::Contains("script-src 'self'"));
    CHECK(bench.get("/page/studio.js")->status == 200);
    // Nothing is packed: that would take longer than sending it, from the processor that the run is on.
    httplib::Headers offers = bench.headers;
    offers.emplace("Accept-Encoding", "br, gzip, deflate");
    for (const char* path : {"/page/three.js", "/api/folder"}) {
        const auto plain = bench.client->Get(path, offers);
        CHECK(plain->status == 200);
        CHECK_FALSE(plain->has_header("Content-Encoding"));
        CHECK(plain->get_header_value("Content-Length") == std::to_string(plain->body.size()));
    }
    CHECK(bench.client->Get("/")->status == 403);
    CHECK(bench.client->Get("/?token=00000000000000000000000000000000")->status == 403);
    CHECK(bench.client->Get("/page/studio.js")->status == 403);
    const auto with = [&](const char* name, const char* value) {
        httplib::Headers other = bench.headers;
        other.erase(name);
        other.emplace(name, value);
        return bench.client->Get("/api/folder", other)->status;
    };
    CHECK(with("Host", "evil.example") == 403);
    CHECK(with("Origin", "http://evil.example") == 403);
    CHECK(with("Accept", "*/*") == 200);
    // A form of another site can send text, and no JSON.
    const auto form = bench.client->Post("/api/save", bench.headers, R"({"name":"a.toml","text":""})", "text/plain");
    CHECK(form->status == 415);
    CHECK(fs::is_empty(folder.path()));
}

TEST_CASE("the workbench reads and writes cases in its folder, and nothing else") {
    const Folder outer;
    outer.write("outside.toml", "secret");
    fs::create_directory(outer.path() / "work");
    const Bench bench(outer.path() / "work");
    bench.asked("/api/save", {{"name", "sub/my.toml"}, {"text", "a = 1\n"}, {"before", nullptr}});
    CHECK(fileContent(outer.path() / "work/sub/my.toml") == "a = 1\n");
    CHECK(Json::parse(bench.get("/api/case?name=sub/my.toml")->body)["text"] == "a = 1\n");
    CHECK(Json::parse(bench.get("/api/folder")->body)["cases"] == Json{"sub/my.toml"});
    // It replaces what the page has read, and nothing that another program has written since.
    bench.asked("/api/save", {{"name", "sub/my.toml"}, {"text", "a = 2\n"}, {"before", "a = 1\n"}});
    CHECK(bench.post("/api/save", {{"name", "sub/my.toml"}, {"text", "a = 3\n"}, {"before", "a = 1\n"}})->status ==
          409);
    CHECK(bench.post("/api/save", {{"name", "sub/my.toml"}, {"text", "a = 3\n"}, {"before", nullptr}})->status == 409);
    CHECK(fileContent(outer.path() / "work/sub/my.toml") == "a = 2\n");
    for (const char* name : {"../outside.toml", "/etc/passwd", "my.txt", ".."}) {
        CAPTURE(name);
        CHECK(bench.get(std::string("/api/case?name=") + name)->status == 403);
        CHECK(bench.post("/api/save", {{"name", name}, {"text", "x"}, {"before", nullptr}})->status == 403);
        CHECK(bench.post("/api/check", {{"name", name}, {"text", "x"}})->status == 403);
        CHECK(bench.post("/api/run", {{"name", name}})->status == 403);
    }
    for (const char* run : {"../work2", "/tmp", "sub/.."}) {
        CAPTURE(run);
        CHECK(bench.get(std::string("/file?name=report.html&run=") + run)->status == 403);
        CHECK(bench.get(std::string("/api/members?run=") + run)->status == 403);
        CHECK(bench.post("/api/picture", {{"run", run}})->status == 403);
        CHECK(bench.post("/api/compare", {{"runs", {run, run}}})->status == 403);
        CHECK(bench.get(std::string("/api/frame?run=") + run)->status == 403);
        CHECK(bench.get(std::string("/api/history?run=") + run)->status == 403);
        CHECK(bench.get(std::string("/api/events?run=") + run)->status == 403);
        CHECK(bench.post("/api/report", {{"run", run}})->status == 403);
        CHECK(bench.post("/api/resume", {{"run", run}})->status == 403);
    }
    CHECK(bench.post("/api/save", "text")->status == 400);
    CHECK(bench.post("/api/save", {{"name", 4}})->status == 400);
    CHECK(bench.post("/api/save", {{"name", "large.toml"}, {"text", std::string(5 << 20, 'x')}})->status == 413);
    CHECK(bench.get("/api/case?name=none.toml")->status == 404);
    CHECK(bench.get("/nothing")->status == 404);
    CHECK(fileContent(outer.path() / "outside.toml") == "secret");
    CHECK_FALSE(fs::exists(outer.path() / "work/large.toml"));
}

TEST_CASE("of two pages that save at once one is told that it came too late") {
    const Folder folder;
    folder.write("my.toml", "# at first\n");
    const Bench bench(folder.path());
    for (int round = 0; round < 40; ++round) {
        const std::string before = fileContent(folder.path() / "my.toml").value();
        std::array<int, 2> told{};
        const auto save = [&](std::size_t page) {
            httplib::Client client("http://" + bench.host);
            const Json body{{"name", "my.toml"}, {"text", fmt::format("# {} {}\n", round, page)}, {"before", before}};
            const auto answer = client.Post("/api/save", bench.headers, body.dump(), "application/json");
            told[page] = answer ? answer->status : 0;
        };
        std::thread other(save, 1);
        save(0);
        other.join();
        CAPTURE(round, told[0], told[1]);
        CHECK(std::min(told[0], told[1]) == 200);
        CHECK(std::max(told[0], told[1]) == 409);
        CHECK(fileContent(folder.path() / "my.toml") == fmt::format("# {} {}\n", round, told[0] == 200 ? 0 : 1));
    }
}

TEST_CASE("the workbench makes what vkdose new makes, in its folder and under a name that is free") {
    const Folder outer;
    fs::create_directory(outer.path() / "work");
    outer.write("outside.toml", mini());
    const fs::path work = outer.path() / "work";
    const Bench bench(work);
    bench.asked("/api/new", {{"name", "first.toml"}, {"like", "mini"}});
    CHECK(fileContent(work / "first.toml") == mini());
    bench.asked("/api/new", {{"name", "sub/dosator.toml"}, {"like", "dosator"}});
    CHECK(fs::exists(work / "sub/dosator-tube.csv"));
    bench.asked("/api/new",
                {{"name", "tin.toml"}, {"like", "canister"}, {"canister", "16x14x40mm"}, {"coil", "3x6mm"}});
    CHECK_THAT(fileContent(work / "tin.toml").value(), Catch::Contains("length_mm = 16"));
    bench.asked("/api/new", {{"name", "millet.toml"},
                             {"like", "canister"},
                             {"canister", "16x14x40mm"},
                             {"coil", "3x6mm"},
                             {"powder", "millet"}});
    CHECK_THAT(fileContent(work / "millet.toml").value(), Catch::Contains("millet"));
    const Json powders = Json::parse(bench.get("/api/powders")->body);
    CHECK(std::any_of(powders.begin(), powders.end(), [](const Json& p) { return p["name"] == "millet"; }));
    bench.asked("/api/new", {{"name", "study.toml"}, {"like", "sweep"}, {"of", "sub/dosator.toml"}});
    CHECK_THAT(fileContent(work / "study.toml").value(), Catch::Contains("base = \"sub/dosator.toml\""));

    const auto refused = [&](const Json& body, int status) {
        CAPTURE(body.dump());
        CHECK(bench.post("/api/new", body)->status == status);
    };
    for (const char* like : {"mini", "dosator", "canister"}) refused({{"name", "tin.toml"}, {"like", like}}, 409);
    refused({{"name", "a.toml"}, {"like", "canister"}, {"canister", "16mm --mesh=/etc/passwd"}}, 409);
    for (const char* powder : {"../outside.toml", "sand", ""})
        refused({{"name", "a.toml"}, {"like", "canister"}, {"canister", "16x14x40mm"}, {"powder", powder}}, 400);
    refused({{"name", "a.toml"}, {"like", "--help"}}, 400);
    refused({{"name", "a.toml"}, {"like", "design"}, {"of", "../outside.toml"}}, 403);
    refused({{"name", "../a.toml"}, {"like", "tray"}}, 403);
    refused({{"name", "a.toml"}, {"like", "sweep"}}, 400);
    refused({{"name", "none/a.toml"}, {"like", "--help"}}, 400);
    CHECK_FALSE(fs::exists(work / "a.toml"));
    CHECK_FALSE(fs::exists(work / "none"));

    // Page and server know all that the command line has ready.
    const std::string page = bench.get("/")->body;
    for (const DeviceTemplate& device : kDeviceTemplates) {
        const std::string name = device.name;
        CHECK_THAT(page, Catch::Contains("value=\"" + name + "\""));
        bench.asked("/api/new", {{"name", "each-" + name + ".toml"}, {"like", name}});
    }
    for (const StudyTemplate& study : kStudyTemplates) {
        const std::string name = study.command;
        CHECK_THAT(page, Catch::Contains("value=\"" + name + "\""));
        bench.asked("/api/new", {{"name", name + "-tin.toml"}, {"like", name}, {"of", "tin.toml"}});
    }
}

TEST_CASE("the workbench checks a text as the command line does, and shows the device before anything runs") {
    const Folder folder;
    const Bench bench(folder.path());
    const Json good = bench.asked("/api/check", {{"name", "my.toml"}, {"text", mini()}});
    CHECK(good["errors"].empty());
    CHECK(good["figures"]["particles"] == 111);
    CHECK(good["scene"]["particles"] == 111);
    CHECK(good["scene"]["coil"]["pitch"].get<double>() > 0);
    CHECK(good["scene"]["motion"]["time_s"].size() == 101);
    CHECK(good["stated"][3] == Json{{"key", "accepted_warnings"}, {"line", 5}, {"text", "\"pinch\""}});
    CHECK(good["values"]["canister.floor"] == "\"trough\"");
    CHECK(good["values"].size() > good["stated"].size());
    std::string text = mini();
    text.replace(text.find("mass_g = 0.9"), 12, "mass_g = -3");
    const Json bad = bench.asked("/api/check", {{"name", "my.toml"}, {"text", text}});
    REQUIRE(bad["errors"].size() == 1);
    CHECK(bad["errors"][0]["file"] == "");
    CHECK(bad["errors"][0]["line"] == 11);
    CHECK(bad["errors"][0]["key"] == "particles.mass_g");
    CHECK(bench.asked("/api/check", {{"name", "my.toml"}, {"text", "["}})["errors"].size() == 1);
    CHECK(fs::is_empty(folder.path()));  // no draft is left
}

TEST_CASE("a law of a case's own is compiled for nobody who has not seen its text") {
    const Folder folder;
    const std::string law = fileContent(VKDOSE_SOURCE_DIR "/cases/laws/liquid-bridge.glsl").value();
    folder.write("liquid-bridge.glsl", law);
    fs::copy(VKDOSE_SOURCE_DIR "/cases/laws/liquid-bridge.csv", folder.path());
    std::string text = fileContent(VKDOSE_SOURCE_DIR "/cases/laws/liquid-bridge.toml").value();
    folder.write("my.toml", text);
    folder.write("upper.toml", "base = \"my.toml\"\n");
    const Bench bench(folder.path());
    for (const char* name : {"my.toml", "upper.toml"}) {
        CAPTURE(name);
        const Json asked =
            bench.asked("/api/check", {{"name", name}, {"text", fileContent(folder.path() / name).value()}});
        CHECK(asked == Json{{"law", {{"file", "liquid-bridge.glsl"}, {"text", law}}}});
        CHECK(bench.post("/api/run", {{"name", name}})->status == 403);
    }
    bench.asked("/api/allow", {{"text", law}});
    CHECK(bench.asked("/api/check", {{"name", "upper.toml"}, {"text", "base = \"my.toml\"\n"}})["errors"].empty());
    folder.write("liquid-bridge.glsl", law + "// changed\n");
    CHECK(bench.asked("/api/check", {{"name", "my.toml"}, {"text", text}}).contains("law"));
    CHECK(bench.post("/api/run", {{"name", "my.toml"}})->status == 403);
}

TEST_CASE("one key of a text is changed, and a text that is not TOML is told") {
    const Folder folder;
    const Bench bench(folder.path());
    const auto edit = [&](const Json& body) { return bench.post("/api/edit", body); };
    CHECK(bench.asked("/api/edit", {{"text", "a = 1  # one\n"}, {"key", "a"}, {"value", "2"}})["text"] ==
          "a = 2  # one\n");
    CHECK(bench.asked("/api/edit", {{"text", "a = 1\n"}, {"key", "a"}, {"value", nullptr}})["text"] == "");
    CHECK(edit({{"text", "a = "}, {"key", "a"}, {"value", "2"}})->status == 422);
    CHECK(edit({{"text", "a = 1\n"}, {"key", "a"}, {"value", "1 2"}})->status == 422);
    CHECK(edit({{"text", "a = 1\n"}, {"key", "a.b"}, {"value", "1"}})->status == 422);
    CHECK(edit({{"text", "a = 1\n"}})->status == 400);
    CHECK(Json::parse(bench.get("/api/keys")->body)["properties"]["contact"]["properties"].contains("friction"));
}

TEST_CASE("a mesh is taken with its size, and one that cannot be used is not kept") {
    const Folder folder;
    const Bench bench(folder.path());
    const auto send = [&](const std::string& name, const std::string& content,
                          const char* type = "application/octet-stream") {
        return bench.client->Post("/api/mesh?name=" + name, bench.headers, content, type);
    };
    const std::string facet = "v 0 0 0\nv 2 0 0\nv 0 3 0\nv 0 0 5\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
    const auto good = send("blade.obj", facet);
    REQUIRE(good->status == 200);
    const Json told = Json::parse(good->body);
    CHECK(told["size"] == Json{2.0, 3.0, 5.0});
    CHECK(told["triangles"] == 4);
    CHECK(told["closed"] == true);
    CHECK(fileContent(folder.path() / "blade.obj") == facet);
    CHECK(send("blade.obj", facet)->status == 200);
    CHECK(send("blade.obj", facet + "# another\n")->status == 409);
    CHECK(send("bad.stl", "solid nothing")->status == 422);
    CHECK(send("my.toml", facet)->status == 422);
    CHECK(send("../blade.obj", facet)->status == 403);
    CHECK(send("blade.obj", facet, "text/plain")->status == 415);
    CHECK(send("large.obj", std::string(33 << 20, ' '))->status == 413);
    CHECK(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()) == 1);
}
