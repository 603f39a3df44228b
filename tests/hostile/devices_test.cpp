// Devices that lack something or fail on the way: what the user is told, and what goes on working.
#include <filesystem>

#include "host/vk/buffer.h"
#include "tests/app/sandbox.h"
#include "tests/support/fault.h"
#include "tests/support/gpu.h"

using namespace vkdose;
using namespace vkdose::test;
using Catch::Contains;

namespace {

/// The reason why a device with too few is refused, under the fault "few-buffers".
std::string fewBuffers() {
    return "needs " + std::to_string(vk::kStorageBuffers) + " storage buffers per stage, has 4";
}

/// A heap of odd size in the canister, falling on the coil.
Particles heap(int count) {
    Particles p;
    for (int i = 0; i < count; ++i)
        p.add({-6e-3 + 3e-3 * (i % 5), 0.0135 + 2.9e-3 * (i / 75), 3e-3 + 3e-3 * (i / 5 % 15)}, 1.4e-3, {0, -0.5, 0});
    return p;
}

struct End {
    Sensors sensors;
    Particles particles;
};

End run(Backend& backend, std::uint32_t steps = 1500, int count = 131) {
    backend.load(canisterWorld(), heap(count));
    return {backend.advance(steps, -9.0), backend.particles()};
}

/// To the bit, after contacts and rebuilds.
void checkSame(const End& end, const End& expected) {
    CHECK(end.particles.position == expected.particles.position);
    CHECK(end.particles.spin == expected.particles.spin);
    CHECK(end.sensors.coilTorque == expected.sensors.coilTorque);
    CHECK(end.sensors.maxOverlapRatio > 0);
    CHECK(end.sensors.rebuilds > 1);
}

std::string failure() {
    try {
        const auto backend = makeVulkanBackend(VulkanOptions{{testDevice().name, false}});
        run(*backend, 64);
    } catch (const DeviceError& error) {
        return error.what();
    }
    return "nothing failed";
}

/// The mini case cut to a few hundred steps.
const std::string kRun = "run '" VKDOSE_SOURCE_DIR
                         "/cases/mini.toml' --set settle.time_s=0.05 --set dose.rotate_s=0.005 --set dose.rest_s=0.002 "
                         "--set stop.max_doses=1 --set sensors.interval_s=0.001 --out out ";

}  // namespace

TEST_CASE("a device that lacks something is refused with what it lacks") {
    struct Row {
        std::string fault;
        std::string says;
    };
    const std::vector<Row> rows{
        {"no-device", "no Vulkan device: install a driver"},
        {"no-compute", "has no compute queue"},
        {"vulkan-1.0", "needs Vulkan 1.1, has 1.0"},
        {"few-buffers", fewBuffers()},
        {"small-range,no-addresses", "allows storage buffers of 65536 bytes: use fewer particles or another device"},
        {"few-groups", "nothing failed"},  // but dispatches have more layers
        {"no-groups", "has a broken driver: it allows 0 workgroups along x"},
        {"one-invocation", "has a broken driver: it allows 1 invocations of a workgroup"},
        {"endless-list", "vkEnumeratePhysicalDevices failed"},
    };
    CHECK(failure() == "nothing failed");
    for (const Row& row : rows) {
        INFO(row.fault);
        const Fault fault(row.fault, false);
        CHECK_THAT(failure(), Contains(row.says));
    }
}

TEST_CASE("a call that fails is named with what to do") {
    struct Row {
        std::string fault;
        std::string call;
        std::string says;
    };
    const std::vector<Row> rows{
        {"no-queue", "vkCreateDevice", "try another with --device"},
        {"no-memory", "for the shapes of the bodies failed",
         "out of device memory: use fewer particles or another device"},
        {"no-memory:3", "for the particle state failed", "out of device memory"},
        {"no-map", "vkMapMemory", "cannot be mapped"},
        {"no-pipeline", "vkCreateComputePipelines", "out of host memory: use fewer particles"},
        {"lost", "vkQueueSubmit", "the device was lost"},
        {"lost:12", "vkQueueSubmit", "the device was lost"},
        {"lost-waiting:13", "vkWaitForFences", "run again, on another device if it happens again"},
    };
    CHECK(failure() == "nothing failed");  // and the store trial, which is made once, is over
    for (const Row& row : rows) {
        INFO(row.fault);
        const Fault fault(row.fault, false);
        const std::string told = failure();
        CHECK_THAT(told, Contains(row.call) && Contains(row.says));
    }
}

TEST_CASE("memory that runs out while a law is tried is told as that, not as a missing driver") {
    const Sandbox box;
    const Fault fault("no-memory", false);
    const auto o = box.vkdose("check '" VKDOSE_SOURCE_DIR "/cases/laws/liquid-bridge.toml'");
    CAPTURE(o.out, o.err);
    CHECK_THAT(o.out, Contains("tried in double precision") && Contains("could not be tried on a device") &&
                          Contains("out of device memory") && !Contains("install") && !Contains("there is none"));
    const auto run = box.vkdose("run '" VKDOSE_SOURCE_DIR "/cases/laws/liquid-bridge.toml' --out run");
    CAPTURE(run.err);
    CHECK(run.code == 4);
    CHECK_THAT(run.err, Contains("out of device memory"));
}

TEST_CASE("the validation layer takes the lowered limits for the device's own") {
    const Fault fault("least-limits");
    const vk::Device device(testDevice());
    REQUIRE(device.limits().maxTexelBufferElements == 65536);
    const vk::Buffer fits(device, "a view that fits", 4UL * 65536, VK_FORMAT_R32_UINT);
    CHECK(device.validationMessages().empty());
    const vk::Buffer tooLarge(device, "a view too large", 4UL * 65537, VK_FORMAT_R32_UINT);
    REQUIRE_FALSE(device.validationMessages().empty());
    CHECK_THAT(device.validationMessages().front(), Contains("maxTexelBufferElements"));
}

TEST_CASE("a device of the least limits gives the same bits") {
    // So many that their tables have more than 65536 elements: no texel views of them then.
    constexpr int kMany = 911;
    const auto good = gpu();
    const End expected = run(*good, 1200, kMany);
    const Fault fault("least-limits");
    const auto least = gpu();
    const End end = run(*least, 1200, kMany);
    checkSame(end, expected);
    requireClean(*least);
}

TEST_CASE("a device that says too much of itself gives the same bits") {
    const auto good = gpu();
    const End expected = run(*good);
    const Fault fault(GENERATE("huge-limits", "many-types", "no-period", "strange-name"), false);
    const auto liar = makeVulkanBackend(VulkanOptions{{testDevice().name, false}});
    checkSame(run(*liar), expected);
}

TEST_CASE("a name without an end is cut, and what it holds is shown and not obeyed") {
    const Sandbox box;
    const Fault fault("strange-name", false);
    const auto o = box.vkdose("devices");
    CAPTURE(o.err);
    CHECK(o.code == 0);
    CHECK(o.out.find('\033') == std::string::npos);
    CHECK(o.out.size() < 4000);
}

TEST_CASE("a device that binds less than a table gives the same bits where it has addresses") {
    constexpr int kMany = 1511;
    const auto good = gpu();
    const End expected = run(*good, 1200, kMany);
    const FieldRequest fields{
        {Vec3(-0.0115, -0.0115, 0), Vec3(0.0115, 0.05, 0.07), {1, 9, 11}}, Kernel::Lucy, 9e-3, true, {}};
    const FieldPoints field = good->fields(fields);
    // The history and the weights of the fields are longer; the tables of the bodies, which are always bound, are not.
    const Fault fault("small-range:200000");
    const auto least = gpu();
    const End end = run(*least, 1200, kMany);
    checkSame(end, expected);
    const FieldPoints got = least->fields(fields);
    for (std::size_t n = 0; n < field.size(); ++n) CHECK(got[n].numbers() == field[n].numbers());
    requireClean(*least);
}

TEST_CASE("a device whose memory the host cannot map, or only a part of it, gives the same bits") {
    const auto good = gpu();
    const End expected = run(*good);
    const auto contacts = good->contacts();
    const double torque = good->advance(100, -9.0).coilTorque;  // of these steps alone
    // The tables take a few hundred kilobytes, so that some of them get into a heap of 100,000 bytes.
    const Fault fault(GENERATE("split-memory", "small-window:100000", "small-window:100000000", "little-local:100000"));
    const auto split = gpu();
    const End end = run(*split);
    CHECK(end.particles.position == expected.particles.position);
    CHECK(end.particles.spin == expected.particles.spin);
    CHECK(end.sensors.kineticEnergy == expected.sensors.kineticEnergy);
    REQUIRE(split->contacts().size() == contacts.size());
    REQUIRE_FALSE(contacts.empty());
    CHECK(end.sensors.coilTorque == expected.sensors.coilTorque);
    CHECK(split->advance(100, -9.0).coilTorque == torque);
    CHECK(torque != 0);
    requireClean(*split);
}

namespace {
int copies = 0;
PFN_vkCmdCopyBuffer copyBuffer = nullptr;
VKAPI_ATTR void VKAPI_CALL countedCopy(VkCommandBuffer commands, VkBuffer from, VkBuffer to, std::uint32_t count,
                                       const VkBufferCopy* regions) {
    ++copies;
    copyBuffer(commands, from, to, count, regions);
}
}  // namespace

TEST_CASE("what the host would read slowly from a card's window is copied first, unless it is a few words") {
    const Fault fault("small-window:100000000");
    const vk::Device device(testDevice());
    std::vector<std::uint32_t> numbers(2500000);  // more than are copied at once
    vk::Buffer buffer(device, "test", numbers.size() * sizeof(std::uint32_t));
    for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = std::uint32_t(i * i);
    copyBuffer = vkCmdCopyBuffer;
    vkCmdCopyBuffer = countedCopy;
    copies = 0;
    buffer.writeAll(numbers);
    CHECK(copies == 0);
    CHECK(buffer.readAll<std::uint32_t>(numbers.size()) == numbers);
    CHECK(copies == 3);
    CHECK(buffer.readAll<std::uint32_t>(2, 4000) == std::vector{numbers[1000], numbers[1001]});
    CHECK(copies == 3);
    std::vector<std::uint32_t> ends(2000);
    buffer.clear({{400, 8}, {8000, 4}});
    buffer.read({{0, 4000}, {8000, 4000}}, ends.data());
    CHECK(copies == 5);
    numbers[100] = numbers[101] = numbers[2000] = 0;
    CHECK(std::equal(ends.begin(), ends.begin() + 1000, numbers.begin()));
    CHECK(std::equal(ends.begin() + 1000, ends.end(), numbers.begin() + 2000));
    vkCmdCopyBuffer = copyBuffer;
    CHECK(device.validationMessages().empty());
}

TEST_CASE("a card reads no table through a texel view, because passes write those tables too") {
    const auto reads = [] {
        const auto backend = gpu();
        run(*backend, 64);
        return profile(*backend, 64, 0).texelReads;
    };
    if (vk::Device(testDevice()).info().type == "CPU") CHECK(reads());
    const Fault fault("discrete-gpu");
    CHECK_FALSE(reads());
}

TEST_CASE("a device lost on the way ends the run with code 4 and keeps what was computed") {
    const Sandbox box;
    const Fault fault("lost:120", false);
    const auto o = box.vkdose(kRun);
    CAPTURE(o.err, o.out);
    CHECK(o.code == 4);
    CHECK_THAT(o.err, Contains("the device was lost"));
    CHECK_THAT(readText(box / "out/summary.json"), Contains("\"stop_reason\": \"device_error\""));
    CHECK(readCsv(box / "out/timeseries.csv").size() > 2);
}

TEST_CASE("a device that cannot be used is code 4 of every command, and nothing is written") {
    const Sandbox box;
    for (const std::string fault : {"no-device", "no-compute", "few-buffers", "no-queue"}) {
        const Fault spoilt(fault, false);
        const auto o = box.vkdose(kRun);
        CAPTURE(fault, o.err);
        CHECK(o.code == 4);
        CHECK_THAT(o.err, Contains("vkdose: "));
        if (fault != "no-queue") CHECK(box.vkdose("devices").code == 4);
    }
    CHECK(box.files().empty());
    const Fault fault("few-buffers", false);
    CHECK_THAT(box.vkdose("devices").out, Contains("not usable: " + fewBuffers()));
}

TEST_CASE("without a Vulkan loader the reference runs and the rest says what to install") {
    const Sandbox box;
    // Files of the loader's names that are no libraries hide the real one.
    std::filesystem::create_directory(box / "lib");
    box.write("lib/libvulkan.so.1", "no library");
    box.write("lib/libvulkan.so", "no library");
    const std::string hide = "LD_LIBRARY_PATH='" + (box / "lib").string() + "' ";
    for (const std::string& command : {kRun, std::string("devices")}) {
        const auto o = box.vkdose(command, hide);
        CAPTURE(command, o.err);
        CHECK(o.code == 4);
        CHECK_THAT(o.err, Contains("no Vulkan loader") && Contains("libvulkan1"));
    }
    CHECK(box.vkdose(kRun + "--backend reference --quiet", hide).code == 0);
    CHECK(box.vkdose("check '" VKDOSE_SOURCE_DIR "/cases/mini.toml'", hide).code == 0);
}
