// Drivers that do not work beside one that does: it is used, and they are named.
#include "host/vk/drivers.h"

#include <algorithm>
#include <filesystem>

#include "tests/app/sandbox.h"
#include "tests/support/gpu.h"

using namespace vkdose;
using namespace vkdose::test;
using Catch::Contains;
namespace fs = std::filesystem;

namespace {

/// The description of a driver whose library is that file.
std::string description(const std::string& library) {
    return R"({"file_format_version": "1.0.0", "ICD": {"library_path": ")" + library + R"(", "api_version": "1.1.0"}})";
}

/// The drivers that these tests run on.
std::string goodDrivers() {
    std::string list;
    for (const fs::path& file : vk::driverFiles()) list += (list.empty() ? "" : ":") + file.string();
    return list;
}

std::string deviceName() {
    return vk::Device(testDevice()).info().name;
}

/// The environment that names these drivers, as shell in front of a command.
std::string drivers(const std::string& list) {
    return "env -u VK_ADD_DRIVER_FILES VK_DRIVER_FILES='" + list + "' VK_ICD_FILENAMES='" + list + "' ";
}

/// The mini case cut to a few hundred steps.
const std::string kRun = "run '" VKDOSE_SOURCE_DIR
                         "/cases/mini.toml' --set settle.time_s=0.01 --set dose.rotate_s=0.005 --set dose.rest_s=0.002 "
                         "--set stop.max_doses=1 --quiet ";

struct Broken {
    const char* kind;  ///< of broken_driver.cpp
    std::string description;
    const char* says;  ///< in the loader's words, or ours
};
const std::vector<Broken> kBroken{
    {"enumerate", description(VKDOSE_BROKEN_DRIVER), "vkEnumeratePhysicalDevices"},
    {"memory", description(VKDOSE_BROKEN_DRIVER), "vkCreateInstance failed"},
    {"create", description(VKDOSE_BROKEN_DRIVER), "CreateInstance"},
    {"", description("/nowhere/libgone.so"), "libgone.so"},
    {"", description(VKDOSE_NO_DRIVER), "vk_icdGetInstanceProcAddr"},
    {"", "no JSON", "bad.json"},
};

}  // namespace

TEST_CASE("a driver that does not work hides no other, and is named with what is wrong") {
    const std::string good = goodDrivers(), device = deviceName();
    for (const Broken& row : kBroken) {
        const Sandbox box;
        box.write("bad.json", row.description);
        const std::string bad = (box / "bad.json").string(),
                          kind = std::string("VKDOSE_BROKEN_DRIVER=") + row.kind + " ";
        for (const std::string& list : {good + ":" + bad, bad + ":" + good}) {
            const auto o = box.vkdose("devices", kind + drivers(list));
            CAPTURE(row.kind, row.says, list, o.out, o.err);
            CHECK(o.code == 0);
            CHECK_THAT(o.out, Contains(device));
            CHECK_THAT(o.out, Contains("driver " + bad + " cannot be used") && Contains(row.says));
            const auto none = box.vkdose(kRun + "--device 'no such device'", kind + drivers(list));
            CHECK(none.code == 4);
            CHECK_THAT(none.err, Contains(device) && Contains("driver " + bad + " cannot be used"));
        }
        const auto o = box.vkdose(kRun + "--out out", kind + drivers(bad + ":" + good));
        CAPTURE(row.kind, row.says, o.err);
        CHECK(o.code == 0);
        CHECK_THAT(readText(box / "out/summary.json"), Contains(device));
        const auto alone = box.vkdose("devices", kind + drivers(bad));
        CAPTURE(alone.out, alone.err);
        CHECK(alone.code == 4);
        CHECK_THAT(alone.err,
                   Contains("driver " + bad + " cannot be used") && Contains(row.says) && !Contains("fewer particles"));
    }
}

TEST_CASE("a driver that only finds no hardware is not called broken") {
    const Sandbox box;
    box.write("bad.json", description(VKDOSE_BROKEN_DRIVER));
    const std::string bad = (box / "bad.json").string(), kind = "VKDOSE_BROKEN_DRIVER=none ";
    const auto o = box.vkdose("devices", kind + drivers(bad + ":" + goodDrivers()));
    CAPTURE(o.out, o.err);
    CHECK(o.code == 0);
    CHECK_THAT(o.out, Contains(deviceName()) && !Contains("cannot be used"));
    const auto alone = box.vkdose("devices", kind + drivers(bad));
    CAPTURE(alone.out, alone.err);
    CHECK(alone.code == 4);
    CHECK_THAT(alone.err, Contains("install") && !Contains("cannot be used"));
}

TEST_CASE("the drivers of the loader's search path are tried likewise") {
    const Sandbox box;
    fs::create_directories(box / "data/vulkan/icd.d");
    fs::create_directories(box / "home/.config/vulkan/icd.d");
    box.write("home/.config/vulkan/icd.d/bad.json", description(VKDOSE_BROKEN_DRIVER));
    int count = 0;
    for (const fs::path& file : vk::driverFiles())
        fs::create_symlink(fs::canonical(file), box / ("data/vulkan/icd.d/" + std::to_string(count++) + ".json"));
    const std::string path =
        "env -u VK_ADD_DRIVER_FILES -u VK_DRIVER_FILES -u VK_ICD_FILENAMES -u XDG_CONFIG_HOME -u "
        "XDG_DATA_HOME XDG_CONFIG_DIRS=/nowhere XDG_DATA_DIRS='" +
        (box / "data").string() + "' HOME='" + (box / "home").string() + "' VKDOSE_BROKEN_DRIVER=enumerate ";
    const auto o = box.vkdose("devices", path);
    CAPTURE(o.out, o.err);
    CHECK(o.code == 0);
    CHECK_THAT(o.out, Contains(deviceName()) && Contains("home/.config/vulkan/icd.d/bad.json cannot be used"));
}

TEST_CASE("the variables that name drivers are read as the loader reads them, and put back") {
    const auto is = [](const char* name, const char* value) {
        const char* now = std::getenv(name);
        return now != nullptr && std::string(now) == value;
    };
    const Sandbox box;
    fs::create_directory(box / "folder");
    for (const char* name : {"folder/b.json", "folder/a.json", "folder/a.txt", "one.json"}) box.write(name, "");
    // The tests' own drivers are put back at the end.
    const vk::OnlyDrivers whole({box / "one.json", box / "folder", box / "one.json"});
    CHECK(vk::driverFiles() == std::vector<fs::path>{box / "one.json", box / "folder/a.json", box / "folder/b.json"});
    setenv("VK_DRIVER_FILES", "x.json::y.json", 1);
    setenv("VK_ICD_FILENAMES", "z.json", 1);
    CHECK(vk::driverFiles() == std::vector<fs::path>{"x.json", "y.json"});
    {
        const vk::OnlyDrivers only({"w.json"});
        CHECK(vk::driverFiles() == std::vector<fs::path>{"w.json"});
        CHECK((is("VK_DRIVER_FILES", "w.json") && is("VK_ICD_FILENAMES", "w.json")));
    }
    CHECK((is("VK_DRIVER_FILES", "x.json::y.json") && is("VK_ICD_FILENAMES", "z.json")));
    unsetenv("VK_DRIVER_FILES");
    CHECK(vk::driverFiles() == std::vector<fs::path>{"z.json"});
    { const vk::OnlyDrivers only({"w.json"}); }
    CHECK(std::getenv("VK_DRIVER_FILES") == nullptr);
}
