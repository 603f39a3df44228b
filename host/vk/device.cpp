#include "host/vk/device.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <mutex>
#include <type_traits>

#include "host/vk/driver_variable.h"

namespace vkdose::vk {

/// Messages of the validation layer, which may speak from a thread of its own.
struct ValidationMessages {
    std::mutex mutex;
    std::vector<std::string> list;
};

namespace {

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";

const char* resultName(VkResult r) {
    switch (r) {
        case VK_ERROR_OUT_OF_HOST_MEMORY:
            return "out of host memory: use fewer particles or end other programs";
        case VK_ERROR_OUT_OF_DEVICE_MEMORY:
            return "out of device memory: use fewer particles or another device";
        case VK_ERROR_INITIALIZATION_FAILED:
            return "initialisation failed: the driver does not start; try another with --device or update it";
        case VK_ERROR_DEVICE_LOST:
            return "the device was lost: the driver reset it, or it was unplugged or hung; run again, on another "
                   "device if it happens again";
        case VK_ERROR_MEMORY_MAP_FAILED:
            return "memory of the device cannot be mapped: free some memory of this machine";
        case VK_ERROR_TOO_MANY_OBJECTS:
            return "too many objects: end other programs that use the device";
        case VK_ERROR_LAYER_NOT_PRESENT:
            return "a layer is not installed";
        case VK_ERROR_EXTENSION_NOT_PRESENT:
            return "an extension is not supported";
        case VK_ERROR_FEATURE_NOT_PRESENT:
            return "a feature is not supported";
        case VK_ERROR_INCOMPATIBLE_DRIVER:
            return "no Vulkan driver that works: install one (Debian: mesa-vulkan-drivers); VK_LOADER_DEBUG=error "
                   "tells why one was passed over";
        default:
            return "error";
    }
}

/// Finds the loader on this machine; once.
void requireLoader() {
    static const VkResult found = volkInitialize();
    if (found != VK_SUCCESS)
        throw DeviceError(
            "no Vulkan loader (libvulkan.so.1): install it and a driver (Debian: libvulkan1, mesa-vulkan-drivers), or "
            "use --backend reference");
}

bool layerInstalled() {
    std::uint32_t n = 0;
    vkEnumerateInstanceLayerProperties(&n, nullptr);
    std::vector<VkLayerProperties> layers(n);
    vkEnumerateInstanceLayerProperties(&n, layers.data());
    return std::any_of(layers.begin(), layers.end(),
                       [](const VkLayerProperties& l) { return std::strcmp(l.layerName, kValidationLayer) == 0; });
}

VKAPI_ATTR VkBool32 VKAPI_CALL onMessage(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                         const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
    auto& messages = *static_cast<ValidationMessages*>(user);
    const std::lock_guard lock(messages.mutex);
    messages.list.emplace_back(data->pMessage);
    return VK_FALSE;
}

VkInstance makeInstance(bool validation) {
    VkApplicationInfo application{
        VK_STRUCTURE_TYPE_APPLICATION_INFO, nullptr, "vkdose", 1, "vkdose", 1, VK_API_VERSION_1_2};
    VkInstanceCreateInfo create{
        VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO, nullptr, 0, &application, 0, nullptr, 0, nullptr};
    const char* extension = VK_EXT_DEBUG_UTILS_EXTENSION_NAME;
    VkValidationFeatureEnableEXT enable = VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
    VkValidationFeaturesEXT features{VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT, nullptr, 1, &enable, 0, nullptr};
    if (validation) {
        create.enabledLayerCount = 1;
        create.ppEnabledLayerNames = &kValidationLayer;
        create.enabledExtensionCount = 1;
        create.ppEnabledExtensionNames = &extension;
        create.pNext = &features;
    }
    keepPassesOfOneLength();
    VkInstance instance = VK_NULL_HANDLE;
    const VkResult result = vkCreateInstance(&create, nullptr, &instance);
    // The loader says so of a driver's file that it cannot make sense of.
    if (result == VK_ERROR_OUT_OF_HOST_MEMORY)
        throw DeviceError(
            "vkCreateInstance failed: a driver's description cannot be read, or there is no memory left: look at the "
            "files in VK_ICD_FILENAMES or /usr/share/vulkan/icd.d (VK_LOADER_DEBUG=error names the one), or use "
            "--backend reference (VkResult -1)");
    check(result, "vkCreateInstance");
    volkLoadInstance(instance);
    return instance;
}

std::vector<VkPhysicalDevice> physicalDevices(VkInstance instance) {
    std::uint32_t n = 0;
    check(vkEnumeratePhysicalDevices(instance, &n, nullptr), "vkEnumeratePhysicalDevices");
    std::vector<VkPhysicalDevice> devices(n);
    if (n > 0) check(vkEnumeratePhysicalDevices(instance, &n, devices.data()), "vkEnumeratePhysicalDevices");
    return devices;
}

}  // namespace

void check(VkResult result, const char* call) {
    if (result != VK_SUCCESS)
        throw DeviceError(fmt::format("{} failed: {} (VkResult {})", call, resultName(result), int(result)));
}

std::vector<DeviceInfo> listDevices() {
    requireLoader();
    const auto destroy = [](VkInstance instance) { vkDestroyInstance(instance, nullptr); };
    const std::unique_ptr<std::remove_pointer_t<VkInstance>, decltype(destroy)> instance(makeInstance(false), destroy);
    return describeAll(physicalDevices(instance.get()));
}

void Device::createInstance(bool validation) {
    requireLoader();
    messages_ = std::make_unique<ValidationMessages>();
    bool validate = validation && layerInstalled();
    instance_ = makeInstance(validate);
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
    std::vector<VkPhysicalDevice> devices = physicalDevices(instance_);
    std::vector<DeviceInfo> infos = describeAll(devices);
    info_ = choose(infos, choice.name);
    physical_ = devices[std::size_t(info_.index)];
    VkPhysicalDeviceProperties properties{};
    vkGetPhysicalDeviceProperties(physical_, &properties);
    limits_ = properties.limits;
    vkGetPhysicalDeviceMemoryProperties(physical_, &memory_);
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
    for (std::uint32_t h = 0; h < all.memoryProperties.memoryHeapCount; ++h) {
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
        const bool roomy = memory_.memoryHeaps[memory_.memoryTypes[i].heapIndex].size >= size;
        if ((typeBits & (1u << i)) && (memoryFlags(i) & wanted) == wanted && roomy) types.push_back(i);
    }
    return types;
}

}  // namespace vkdose::vk
