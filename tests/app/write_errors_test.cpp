// A file system that cannot sync, or that interrupts a call, forbids no run; one that fails is an error.

#include <map>

#include "tests/app/sandbox.h"
#include "tests/support/catch.h"
#include "tests/support/io_faults.h"

using namespace vkdose::test;

namespace {

const std::string kRun =
    "run '" VKDOSE_SOURCE_DIR
    "/cases/mini.toml' --backend reference --quiet --set settle.time_s=0.01 --set dose.rotate_s=0.01 --set "
    "dose.rest_s=0.01 --set stop.max_doses=1 --set frames.interval_s=0.01 --out run --force";
const std::vector<std::string> kFiles{"run/timeseries.csv", "run/doses.csv", "run/case.toml", "run/particles.csv",
                                      "run/frames/frames.csv"};

std::map<std::string, std::string> texts(const Sandbox& box) {
    std::map<std::string, std::string> all;
    for (const std::string& file : kFiles) all[file] = readText(box / file);
    return all;
}

}  // namespace

TEST_CASE("a file system that knows no sync, no locks, or interrupts every other call, takes a run as any other") {
    const Sandbox box;
    REQUIRE(box.vkdose(kRun).code == 0);
    const auto whole = texts(box);
    for (const auto& [file, faults] : std::vector<std::pair<std::string, std::string>>{
             {"timeseries.csv", "fsync:EINVAL"},
             {"doses.csv", "fsync:ENOTSUP"},
             {"case.toml.new", "fsync:EINVAL,close:EINTR,open:EINTR:0:1"},
             {"settled.h5.new", "fsync:EROFS"},
             {"run", "fsync:EINVAL"},
             {"run", "flock:EINTR:0:3,open:EINTR:0:2"},
             {"run", "flock:ENOLCK"},
             {"timeseries.csv", "write:EINTR:0:3,write:short:5,fsync:EINTR:0:2,open:EINTR:0:1"},
             {"summary.json.new", "write:EINTR:1:2,write:short:100,fsync:EINTR:0:1"},
             {"summary.json", "rename:EINTR:0:1"},
             {"particles.csv", "write:short:1000"}}) {
        const Sandbox other;
        const auto o = other.vkdose(kRun, onBadDisk(file, faults));
        CAPTURE(file, faults, o.err);
        CHECK(o.code == 0);
        CHECK_FALSE(readText(other / "told").empty());
        CHECK(texts(other) == whole);
    }
}

TEST_CASE("a disk that fails at a write, a sync or a move is an error that names the file") {
    for (const auto& [file, faults] :
         std::vector<std::pair<std::string, std::string>>{{"timeseries.csv", "fsync:EIO"},
                                                          {"timeseries.csv", "write:EIO:1"},
                                                          {"timeseries.csv", "write:short:7,write:ENOSPC:3"},
                                                          {"doses.csv", "open:EROFS"},
                                                          {"summary.json.new", "fsync:EIO"},
                                                          {"summary.json", "rename:EIO"},
                                                          {"case.toml.new", "close:EIO"},
                                                          {"run", "fsync:EIO"}}) {
        const Sandbox box;
        const auto o = box.vkdose(kRun, onBadDisk(file, faults));
        CAPTURE(file, faults, o.err);
        CHECK(o.code == 5);
        CHECK_THAT(o.err, Catch::Contains(file.substr(0, file.find(".new"))));
        CHECK_FALSE(readText(box / "told").empty());
    }
}
