#pragma once
// A workbench, and a browser that has opened it.

#include <httplib.h>

#include <atomic>
#include <future>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "host/core/file.h"
#include "host/studio/server.h"
#include "tests/support/catch.h"
#include "tests/support/folder.h"
#include "tests/support/places.h"

namespace vkdose::test {

inline std::string mini() {
    return fileContent(VKDOSE_SOURCE_DIR "/cases/mini.toml").value();
}

/// A workbench on a folder, in a thread, and a browser that has opened it.
class Bench {
  public:
    explicit Bench(const std::filesystem::path& folder) {
        std::promise<std::string> address;
        studio::ServerOptions options{folder, VKDOSE_SOURCE_DIR "/cases/mini.toml", 0, programFile()};
        thread_ = std::thread([this, options, &address] {
            studio::serve(
                options, [&](const std::string& a) { address.set_value(a); }, stop_);
        });
        const std::string all = address.get_future().get();
        const std::size_t slash = all.find("/?");
        host = all.substr(7, slash - 7);
        query = all.substr(slash);
        client = std::make_unique<httplib::Client>("http://" + host);
        client->set_read_timeout(120);
        const auto first = client->Get(query);
        REQUIRE(first);
        REQUIRE(first->status == 302);
        const std::string cookie = first->get_header_value("Set-Cookie");
        headers = {{"Cookie", cookie.substr(0, cookie.find(';'))}, {"Origin", "http://" + host}};
    }
    ~Bench() {
        stop_ = true;
        thread_.join();
    }

    Bench(const Bench&) = delete;
    Bench& operator=(const Bench&) = delete;

    httplib::Result get(const std::string& path) const { return client->Get(path, headers); }
    httplib::Result post(const std::string& path, const nlohmann::json& body) const {
        return client->Post(path, headers, body.dump(), "application/json");
    }
    nlohmann::json asked(const std::string& path, const nlohmann::json& body) const {
        const auto r = post(path, body);
        REQUIRE(r);
        CAPTURE(path, r->body);
        REQUIRE(r->status == 200);
        return nlohmann::json::parse(r->body);
    }

    std::string host, query;
    httplib::Headers headers;
    std::unique_ptr<httplib::Client> client;

  private:
    std::atomic<bool> stop_{false};
    std::thread thread_;
};

}  // namespace vkdose::test
