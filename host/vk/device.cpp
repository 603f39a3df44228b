#include "host/vk/device.h"

#include <algorithm>
#include <cstring>
#include <mutex>

#include "host/vk/drivers.h"
#include "host/vk/instance.h"

namespace vkdose::vk {

/// Messages of the validation layer, which may speak from a thread of its own.
struct ValidationMessages {
    std::mutex mutex;
    std::vector<std::string> list;
};

namespace {

VKAPI_ATTR VkBool32 VKAPI_CALL onMessage(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                         const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
    auto& messages = *static_cast<ValidationMessages*>(user);
    const std::lock_guard lock(messages.mutex);
    messages.list.emplace_back(data->pMessage);
    return VK_FALSE;
}

}  // namespace

std::vector<DeviceInfo> listDevices() {
    const Instance instance = openInstance(false);
    return describeAll(devicesOf(instance.get()));
}

void Device::createInstance(bool validation) {
    messages_ = std::make_unique<ValidationMessages>();
    const bool validate = validation && validationInstalled();
    instance_ = openInstance(validate).release();
    if (!validate) return;
    VkDebugUtilsMessengerCreateInfoEXT create{};
    create.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT;
    create.messageSeverity =
        VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    create.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_TYPE_GENERAL_BIT_EXT;
    create.pfnUserCallback = onMessage;
    create.pUserData = messages_.get();
    auto make = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
        vkGetInstanceProcAddr(instance_, "vkCreateDebugUtilsMessengerEXT"));
    check(make(instance_, &create, nullptr, &messenger_), "vkCreateDebugUtilsMessengerEXT");
}

void Device::createDevice(std::uint32_t family, std::uint32_t apiVersion) {
    float priority = 1.0f;
    VkDeviceQueueCreateInfo queue{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO, nullptr, 0, family, 1, &priority};
    VkDeviceCreateInfo create{};
    create.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
    create.queueCreateInfoCount = 1;
    create.pQueueCreateInfos = &queue;
    VkPhysicalDeviceFeatures has{}, wanted{};
    vkGetPhysicalDeviceFeatures(physical_, &has);
    wanted.shaderInt64 = has.shaderInt64;
    int64_ = has.shaderInt64 == VK_TRUE;
    create.pEnabledFeatures = &wanted;
    VkPhysicalDeviceBufferDeviceAddressFeatures addresses{};
    addresses.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_BUFFER_DEVICE_ADDRESS_FEATURES;
    const char* const extension = VK_KHR_BUFFER_DEVICE_ADDRESS_EXTENSION_NAME;  // a part of Vulkan from 1.2 on
    const bool inCore = apiVersion >= VK_API_VERSION_1_2;
    if (inCore || hasExtension(extension)) {
        VkPhysicalDeviceFeatures2 all{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, &addresses, {}};
        vkGetPhysicalDeviceFeatures2(physical_, &all);
    }
    addresses_ = addresses.bufferDeviceAddress == VK_TRUE;
    if (addresses_) {
        addresses.bufferDeviceAddressCaptureReplay = addresses.bufferDeviceAddressMultiDevice = VK_FALSE;
        create.pNext = &addresses;
        create.enabledExtensionCount = inCore ? 0 : 1;
        create.ppEnabledExtensionNames = &extension;
    }
    addressOf_ = inCore ? vkGetBufferDeviceAddress : vkGetBufferDeviceAddressKHR;
    check(vkCreateDevice(physical_, &create, nullptr, &device_), "vkCreateDevice");
    vkGetDeviceQueue(device_, family, 0, &queue_);
    VkCommandPoolCreateInfo pool{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO, nullptr,
                                 VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT, family};
    check(vkCreateCommandPool(device_, &pool, nullptr, &pool_), "vkCreateCommandPool");
}

// Each class here that owns Vulkan objects delegates to a constructor that owns nothing yet, so that its destructor
// cleans up when the rest throws.
Device::Device() = default;

std::vector<std::string> Device::validationMessages() const {
    // Newer layers tell what they found on the device only when it is idle. A lost device has nothing more to tell.
    if (validated()) vkDeviceWaitIdle(device_);
    const std::lock_guard lock(messages_->mutex);
    return messages_->list;
}

Device::Device(const DeviceChoice& choice) : Device() {
    createInstance(choice.validation);
    const std::vector<VkPhysicalDevice> devices = devicesOf(instance_);
    const std::vector<DeviceInfo> infos = describeAll(devices);
    try {
        info_ = choose(infos, choice.name);
    } catch (const DeviceError& e) {
        throw DeviceError(e.what() + textOf(tryDrivers().broken));
    }
    physical_ = devices[std::size_t(info_.index)];
    VkPhysicalDeviceProperties properties{};
    vkGetPhysicalDeviceProperties(physical_, &properties);
    limits_ = properties.limits;
    vkGetPhysicalDeviceMemoryProperties(physical_, &memory_);
    memory_.memoryTypeCount = std::min<std::uint32_t>(memory_.memoryTypeCount, VK_MAX_MEMORY_TYPES);
    memory_.memoryHeapCount = std::min<std::uint32_t>(memory_.memoryHeapCount, VK_MAX_MEMORY_HEAPS);
    createDevice(std::uint32_t(computeFamily(physical_)), properties.apiVersion);
}

Device::~Device() {
    if (device_ != VK_NULL_HANDLE) {
        vkDeviceWaitIdle(device_);
        vkDestroyCommandPool(device_, pool_, nullptr);
        vkDestroyDevice(device_, nullptr);
    }
    if (messenger_ != VK_NULL_HANDLE) {
        auto destroy = reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(
            vkGetInstanceProcAddr(instance_, "vkDestroyDebugUtilsMessengerEXT"));
        destroy(instance_, messenger_, nullptr);
    }
    if (instance_ != VK_NULL_HANDLE) vkDestroyInstance(instance_, nullptr);
}

bool Device::hasExtension(const char* name) const {
    std::uint32_t n = 0;
    check(vkEnumerateDeviceExtensionProperties(physical_, nullptr, &n, nullptr),
          "vkEnumerateDeviceExtensionProperties");
    std::vector<VkExtensionProperties> has(n);
    check(vkEnumerateDeviceExtensionProperties(physical_, nullptr, &n, has.data()),
          "vkEnumerateDeviceExtensionProperties");
    return std::any_of(has.begin(), has.end(),
                       [name](const VkExtensionProperties& e) { return std::strcmp(e.extensionName, name) == 0; });
}

VkDeviceAddress Device::addressOf(VkBuffer buffer) const {
    const VkBufferDeviceAddressInfo which{VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO, nullptr, buffer};
    return addressOf_(device_, &which);
}

VkDeviceSize Device::longestBuffer() const {
    if (!addresses_) return limits_.maxStorageBufferRange;
    VkPhysicalDeviceMaintenance3Properties allocations{};
    allocations.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_3_PROPERTIES;
    VkPhysicalDeviceProperties2 all{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, &allocations, {}};
    vkGetPhysicalDeviceProperties2(physical_, &all);
    return std::max<VkDeviceSize>(allocations.maxMemoryAllocationSize, limits_.maxStorageBufferRange);
}

std::uint64_t Device::freeMemory() const {
    const bool told = hasExtension(VK_EXT_MEMORY_BUDGET_EXTENSION_NAME);
    VkPhysicalDeviceMemoryBudgetPropertiesEXT budget{};
    budget.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MEMORY_BUDGET_PROPERTIES_EXT;
    VkPhysicalDeviceMemoryProperties2 all{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MEMORY_PROPERTIES_2, nullptr, {}};
    if (told) all.pNext = &budget;
    vkGetPhysicalDeviceMemoryProperties2(physical_, &all);
    std::uint64_t most = 0;
    for (std::uint32_t h = 0; h < memory_.memoryHeapCount; ++h) {
        if ((all.memoryProperties.memoryHeaps[h].flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT) == 0) continue;
        const std::uint64_t size = all.memoryProperties.memoryHeaps[h].size;
        const std::uint64_t left = budget.heapBudget[h] - std::min(budget.heapBudget[h], budget.heapUsage[h]);
        most = std::max(most, told ? std::min(size, left) : size);
    }
    return most;
}

std::vector<std::uint32_t> Device::memoryTypes(std::uint32_t typeBits, VkMemoryPropertyFlags wanted,
                                               VkDeviceSize size) const {
    std::vector<std::uint32_t> types;
    for (std::uint32_t i = 0; i < memory_.memoryTypeCount; ++i) {
        const std::uint32_t heap = memory_.memoryTypes[i].heapIndex;
        const bool roomy = heap < memory_.memoryHeapCount && memory_.memoryHeaps[heap].size >= size;
        if ((typeBits & (1u << i)) && (memoryFlags(i) & wanted) == wanted && roomy) types.push_back(i);
    }
    return types;
}

}  // namespace vkdose::vk
