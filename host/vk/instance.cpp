#include "host/vk/instance.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "host/core/printable.h"
#include "host/vk/device.h"
#include "host/vk/driver_variable.h"
#include "host/vk/drivers.h"

namespace vkdose::vk {

namespace {

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";
constexpr const char* kNoDevice =
    "no Vulkan device: install a driver (Debian: mesa-vulkan-drivers brings a software one)";

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
            return "no Vulkan driver that works: install one (Debian: mesa-vulkan-drivers)";
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

VKAPI_ATTR VkBool32 VKAPI_CALL onLoaderMessage(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                               const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
    static_cast<std::vector<std::string>*>(user)->push_back(printable(data->pMessage));
    return VK_FALSE;
}

VkDebugUtilsMessengerCreateInfoEXT listenerFor(std::vector<std::string>* said) {
    VkDebugUtilsMessengerCreateInfoEXT listener{};
    listener.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT;
    listener.messageSeverity =
        VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    listener.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_GENERAL_BIT_EXT;
    listener.pfnUserCallback = onLoaderMessage;
    listener.pUserData = said;
    return listener;
}

template <class Function>
Function functionOf(VkInstance instance, const char* name) {
    return reinterpret_cast<Function>(vkGetInstanceProcAddr(instance, name));
}

/// Makes an instance. With `said` the loader adds there what it has to say about errors.
VkResult make(bool validation, std::vector<std::string>* said, VkInstance* made) {
    VkApplicationInfo application{
        VK_STRUCTURE_TYPE_APPLICATION_INFO, nullptr, "vkdose", 1, "vkdose", 1, VK_API_VERSION_1_2};
    VkInstanceCreateInfo create{
        VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO, nullptr, 0, &application, 0, nullptr, 0, nullptr};
    const char* extension = VK_EXT_DEBUG_UTILS_EXTENSION_NAME;
    VkValidationFeatureEnableEXT enable = VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
    VkValidationFeaturesEXT features{VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT, nullptr, 1, &enable, 0, nullptr};
    const VkDebugUtilsMessengerCreateInfoEXT listener = listenerFor(said);
    if (validation) {
        create.enabledLayerCount = 1;
        create.ppEnabledLayerNames = &kValidationLayer;
        create.pNext = &features;
    } else if (said != nullptr) {
        create.pNext = &listener;
    }
    if (create.pNext != nullptr) {
        create.enabledExtensionCount = 1;
        create.ppEnabledExtensionNames = &extension;
    }
    keepPassesOfOneLength();
    return vkCreateInstance(&create, nullptr, made);
}

/// The devices of an instance. A driver may find another one between the two calls.
VkResult list(VkInstance instance, std::vector<VkPhysicalDevice>& devices) {
    const auto call =
        reinterpret_cast<PFN_vkEnumeratePhysicalDevices>(vkGetInstanceProcAddr(instance, "vkEnumeratePhysicalDevices"));
    VkResult result = VK_INCOMPLETE;
    for (int tries = 0; result == VK_INCOMPLETE && tries < 8; ++tries) {
        std::uint32_t n = 0;
        result = call(instance, &n, nullptr);
        devices.assign(n, VK_NULL_HANDLE);
        if (result == VK_SUCCESS && n > 0) result = call(instance, &n, devices.data());
        devices.resize(n);
    }
    return result;
}

/// An instance that shows a device. Throws DeviceError.
Instance open(bool validation) {
    VkInstance made = VK_NULL_HANDLE;
    const VkResult result = make(validation, nullptr, &made);
    // The loader says so too of a driver's description that it cannot make sense of.
    if (result == VK_ERROR_OUT_OF_HOST_MEMORY)
        throw DeviceError(
            "vkCreateInstance failed: no memory is left, or a driver's description cannot be read (VkResult -1)");
    check(result, "vkCreateInstance");
    volkLoadInstance(made);
    Instance instance(made);
    (void)devicesOf(made);
    return instance;
}

/// Takes an instance over, which has the extension for that, and listens to its loader.
class Listening {
  public:
    Listening(VkInstance instance, std::vector<std::string>& said) : instance_(instance) {
        const VkDebugUtilsMessengerCreateInfoEXT listener = listenerFor(&said);
        const auto call = functionOf<PFN_vkCreateDebugUtilsMessengerEXT>(instance, "vkCreateDebugUtilsMessengerEXT");
        if (call != nullptr && call(instance, &listener, nullptr, &messenger_) != VK_SUCCESS)
            messenger_ = VK_NULL_HANDLE;
    }
    ~Listening() {
        if (messenger_ != VK_NULL_HANDLE)
            functionOf<PFN_vkDestroyDebugUtilsMessengerEXT>(instance_, "vkDestroyDebugUtilsMessengerEXT")(
                instance_, messenger_, nullptr);
        functionOf<PFN_vkDestroyInstance>(instance_, "vkDestroyInstance")(instance_, nullptr);
    }
    Listening(const Listening&) = delete;
    Listening& operator=(const Listening&) = delete;

  private:
    VkInstance instance_;
    VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
};

}  // namespace

void check(VkResult result, const char* call) {
    if (result != VK_SUCCESS)
        throw DeviceError(fmt::format("{} failed: {} (VkResult {})", call, resultName(result), int(result)));
}

bool validationInstalled() {
    requireLoader();
    std::uint32_t n = 0;
    vkEnumerateInstanceLayerProperties(&n, nullptr);
    std::vector<VkLayerProperties> layers(n);
    vkEnumerateInstanceLayerProperties(&n, layers.data());
    return std::any_of(layers.begin(), layers.end(),
                       [](const VkLayerProperties& l) { return std::strcmp(l.layerName, kValidationLayer) == 0; });
}

std::vector<VkPhysicalDevice> devicesOf(VkInstance instance) {
    std::vector<VkPhysicalDevice> devices;
    check(list(instance, devices), "vkEnumeratePhysicalDevices");
    if (devices.empty()) throw DeviceError(kNoDevice);
    return devices;
}

Instance openInstance(bool validation) {
    requireLoader();
    try {
        return open(validation);
    } catch (const DeviceError& all) {
        const TriedDrivers tried = tryDrivers();
        // The loader may call it a failed initialisation if no driver finds hardware.
        if (tried.good.empty() && tried.broken.empty()) throw DeviceError(kNoDevice);
        if (tried.good.empty()) throw DeviceError(all.what() + textOf(tried.broken));
        const OnlyDrivers only(tried.good);
        try {
            return open(validation);
        } catch (const DeviceError& good) {
            throw DeviceError(good.what() + textOf(tried.broken));
        }
    }
}

Start startDrivers() {
    requireLoader();
    std::vector<std::string> said;
    VkInstance instance = VK_NULL_HANDLE;
    VkResult result = make(false, &said, &instance);
    const char* call = "vkCreateInstance";
    Start start;
    if (result == VK_SUCCESS) {
        call = "vkEnumeratePhysicalDevices";
        const Listening listening(instance, said);
        std::vector<VkPhysicalDevice> devices;
        result = list(instance, devices);
        start.showsDevices = result == VK_SUCCESS && !devices.empty();
    }
    if (result == VK_SUCCESS) return start;
    // The loader calls it an error too if no driver finds hardware of its kind. A driver of Vulkan 1.0 is none.
    std::erase_if(said, [](const std::string& message) {
        return message.ends_with("Found no drivers!") || message.find("any valid GPUs") != std::string::npos ||
               message.ends_with("treating as a 1.0 ICD");
    });
    const bool noHardware = result == VK_ERROR_INCOMPATIBLE_DRIVER || result == VK_ERROR_INITIALIZATION_FAILED;
    if (said.empty() && noHardware) return start;
    start.problem = fmt::format("{} failed (VkResult {})", call, int(result));
    for (const std::string& message : said) start.problem += ": " + message;
    return start;
}

}  // namespace vkdose::vk
