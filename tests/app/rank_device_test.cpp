// Which device each of several ranks on a machine takes.

#include "host/app/backends.h"
#include "tests/support/catch.h"

using namespace vkdose;

namespace {

vk::DeviceInfo device(int index, const std::string& type, bool usable = true) {
    vk::DeviceInfo d;
    d.index = index;
    d.name = "one of four of a name";
    d.type = type;
    d.usable = usable;
    return d;
}

std::vector<std::string> devicesOf(int ranks, const std::vector<vk::DeviceInfo>& devices, const BackendChoice& choice) {
    std::vector<std::string> taken;
    for (int rank = 0; rank < ranks; ++rank) taken.push_back(choiceOfRank(choice, devices, rank).device);
    return taken;
}

using Names = std::vector<std::string>;

}  // namespace

TEST_CASE("ranks on a machine take turns at its GPUs of the best kind") {
    const std::vector<vk::DeviceInfo> devices{device(0, "CPU"),          device(1, "integrated GPU"),
                                              device(2, "discrete GPU"), device(3, "discrete GPU", false),
                                              device(4, "discrete GPU"), device(5, "virtual GPU")};
    CHECK(devicesOf(5, devices, {}) == Names{"2", "4", "2", "4", "2"});
    CHECK(devicesOf(2, {device(0, "CPU"), device(1, "integrated GPU")}, {}) == Names{"1", "1"});
    CHECK(choiceOfRank({"vulkan", "", true}, devices, 1).validation);
}

TEST_CASE("a device that is asked for, the reference and the processor are left as they are") {
    const std::vector<vk::DeviceInfo> gpus{device(0, "discrete GPU"), device(1, "discrete GPU")};
    CHECK(devicesOf(2, gpus, {"vulkan", "radeon", false}) == Names{"radeon", "radeon"});
    CHECK(devicesOf(2, gpus, {"reference", "", false}) == Names{"", ""});
    // Two drivers for one processor: their bits differ, and there is no more of it.
    CHECK(devicesOf(2, {device(0, "CPU"), device(1, "CPU")}, {}) == Names{"", ""});
    CHECK(devicesOf(2, {device(0, "discrete GPU", false)}, {}) == Names{"", ""});
}
