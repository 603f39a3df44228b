#include "host/vk/device_info.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>
#include <string_view>

#include "host/core/printable.h"
#include "shaders/shared/layout.h"

namespace vkdose::vk {

const std::uint32_t kStorageBuffers = gpu::kTables;

namespace {

std::string lower(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
    return text;
}

const char* typeName(VkPhysicalDeviceType type) {
    switch (type) {
        case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
            return "discrete GPU";
        case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
            return "integrated GPU";
        case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
            return "virtual GPU";
        case VK_PHYSICAL_DEVICE_TYPE_CPU:
            return "CPU";
        default:
            return "other";
    }
}

int preference(const std::string& type) {
    constexpr std::string_view order[] = {"discrete GPU", "integrated GPU", "virtual GPU", "CPU", "other"};
    return int(std::find(std::begin(order), std::end(order), type) - std::begin(order));
}

std::string versionText(std::uint32_t v) {
    return fmt::format("{}.{}.{}", VK_API_VERSION_MAJOR(v), VK_API_VERSION_MINOR(v), VK_API_VERSION_PATCH(v));
}

/// A text of a driver, which may lack its end and hold what moves a terminal's cursor.
template <std::size_t N>
std::string textIn(const char (&text)[N]) {
    return printable(std::string(text, strnlen(text, N)));
}

/// What a device says of itself that no Vulkan device may say, and that would lead to divisions by zero here; empty if
/// there is nothing. Of a driver that says so, other limits are not to be believed either.
std::string impossible(const VkPhysicalDeviceLimits& l) {
    struct Row {
        const char* what;
        std::uint32_t has, least;
    };
    const Row rows[] = {{"invocations of a workgroup", l.maxComputeWorkGroupInvocations, 128},
                        {"invocations of a workgroup along x", l.maxComputeWorkGroupSize[0], 128},
                        {"workgroups along x", l.maxComputeWorkGroupCount[0], 1},
                        {"workgroups along y", l.maxComputeWorkGroupCount[1], 1},
                        {"workgroups along z", l.maxComputeWorkGroupCount[2], 1},
                        {"bytes of push constants", l.maxPushConstantsSize, 128}};
    for (const Row& row : rows)
        if (row.has < row.least)
            return fmt::format("has a broken driver: it allows {} {}, and every Vulkan device at least {}", row.has,
                               row.what, row.least);
    return "";
}

std::vector<VkQueueFamilyProperties> queueFamilies(VkPhysicalDevice physical) {
    std::uint32_t n = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(physical, &n, nullptr);
    std::vector<VkQueueFamilyProperties> families(n);
    vkGetPhysicalDeviceQueueFamilyProperties(physical, &n, families.data());
    return families;
}

std::string driverText(VkPhysicalDevice physical, const VkPhysicalDeviceProperties& base) {
    std::string number = fmt::format("{:#x}", base.driverVersion);
    if (base.apiVersion < VK_API_VERSION_1_2) return number;
    VkPhysicalDeviceDriverProperties driver{};
    driver.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES;
    VkPhysicalDeviceProperties2 all{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, &driver, {}};
    vkGetPhysicalDeviceProperties2(physical, &all);
    const std::string name = textIn(driver.driverName), version = textIn(driver.driverInfo);
    return fmt::format("{}: {}", name, version.empty() ? number : version);
}

DeviceInfo describe(VkPhysicalDevice physical, int index) {
    VkPhysicalDeviceProperties base{};
    vkGetPhysicalDeviceProperties(physical, &base);
    DeviceInfo info;
    info.index = index;
    info.name = textIn(base.deviceName);
    info.type = typeName(base.deviceType);
    info.apiVersion = versionText(base.apiVersion);
    info.maxStorageBufferRange = base.limits.maxStorageBufferRange;
    info.driver = driverText(physical, base);
    if (base.apiVersion < VK_API_VERSION_1_1) {
        info.reason = "needs Vulkan 1.1, has " + info.apiVersion;
    } else if (computeFamily(physical) < 0) {
        info.reason = "has no compute queue";
    } else if (base.limits.maxPerStageDescriptorStorageBuffers < kStorageBuffers) {
        info.reason = fmt::format("needs {} storage buffers per stage, has {}", kStorageBuffers,
                                  base.limits.maxPerStageDescriptorStorageBuffers);
    } else if (info.reason = impossible(base.limits); info.reason.empty()) {
        info.usable = true;
        const float period = base.limits.timestampPeriod;
        if (std::isfinite(period) && period > 0)
            info.timestampBits = queueFamilies(physical)[std::size_t(computeFamily(physical))].timestampValidBits;
        VkPhysicalDeviceSubgroupProperties subgroup{
            VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_PROPERTIES, nullptr, 0, 0, 0, VK_FALSE};
        VkPhysicalDeviceProperties2 all{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, &subgroup, {}};
        vkGetPhysicalDeviceProperties2(physical, &all);
        info.subgroupSize = subgroup.subgroupSize;
    }
    return info;
}

std::string choices(const std::vector<DeviceInfo>& infos) {
    std::string text;
    for (const DeviceInfo& d : infos) {
        text += fmt::format("{}{} ({})", text.empty() ? "" : ", ", d.index, d.name);
        if (!d.usable) text += " " + d.reason;
    }
    return text;
}

}  // namespace

int computeFamily(VkPhysicalDevice physical) {
    const std::vector<VkQueueFamilyProperties> families = queueFamilies(physical);
    for (std::size_t i = 0; i < families.size(); ++i)
        if (families[i].queueFlags & VK_QUEUE_COMPUTE_BIT) return int(i);
    return -1;
}

std::vector<DeviceInfo> describeAll(const std::vector<VkPhysicalDevice>& devices) {
    std::vector<DeviceInfo> infos;
    for (std::size_t i = 0; i < devices.size(); ++i) infos.push_back(describe(devices[i], int(i)));
    if (infos.empty())
        throw DeviceError("no Vulkan device: install a driver (Debian: mesa-vulkan-drivers brings a software one)");
    return infos;
}

std::vector<DeviceInfo> bestOf(const std::vector<DeviceInfo>& devices) {
    std::vector<DeviceInfo> best;
    for (const DeviceInfo& d : devices) {
        if (!d.usable) continue;
        if (!best.empty() && preference(d.type) < preference(best.front().type)) best.clear();
        if (best.empty() || d.type == best.front().type) best.push_back(d);
    }
    return best;
}

DeviceInfo choose(const std::vector<DeviceInfo>& infos, const std::string& wanted) {
    if (wanted.empty()) {
        const std::vector<DeviceInfo> best = bestOf(infos);
        if (best.empty()) throw DeviceError(fmt::format("none of the Vulkan devices can be used: {}", choices(infos)));
        return best.front();
    }
    const bool number = std::all_of(wanted.begin(), wanted.end(), [](unsigned char c) { return std::isdigit(c); });
    const auto found = std::find_if(infos.begin(), infos.end(), [&](const DeviceInfo& d) {
        return number ? std::to_string(d.index) == wanted : lower(d.name).find(lower(wanted)) != std::string::npos;
    });
    if (found == infos.end())
        throw DeviceError(fmt::format("no Vulkan device '{}'; there are: {}", wanted, choices(infos)));
    if (!found->usable) throw DeviceError(fmt::format("device {} ({}) {}", found->index, found->name, found->reason));
    return *found;
}

DeviceInfo chooseAgain(const std::vector<DeviceInfo>& infos, const std::string& name) {
    const auto model = [](const std::string& full) { return full.substr(0, full.rfind(" (")); };
    for (const bool exact : {true, false})
        for (const DeviceInfo& d : infos)
            if (d.usable && (exact ? d.name == name : model(d.name) == model(name))) return d;
    throw DeviceError(
        fmt::format("the run was made on '{}', which is not here or cannot be used; there are: {}; name one "
                    "with --device",
                    name, choices(infos)));
}

}  // namespace vkdose::vk
