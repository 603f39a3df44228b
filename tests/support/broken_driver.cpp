// A Vulkan driver that does not work, for tests. VKDOSE_BROKEN_DRIVER says how:
//
//   create      vkCreateInstance fails
//   memory      it fails for want of memory, for which a loader fails as a whole
//   enumerate   vkEnumeratePhysicalDevices fails, for which a loader fails as a whole, as on WSL
//   none        it works, and finds no hardware
#include <vulkan/vk_icd.h>
#include <vulkan/vulkan.h>

#include <cstdint>
#include <cstdlib>
#include <string_view>

namespace {

bool is(std::string_view kind) {
    const char* asked = std::getenv("VKDOSE_BROKEN_DRIVER");
    return asked != nullptr && asked == kind;
}

struct Object {
    VK_LOADER_DATA loader;  // the loader writes its table here
};

VKAPI_ATTR VkResult VKAPI_CALL createInstance(const VkInstanceCreateInfo*, const VkAllocationCallbacks*,
                                              VkInstance* made) {
    if (is("create")) return VK_ERROR_INITIALIZATION_FAILED;
    if (is("memory")) return VK_ERROR_OUT_OF_HOST_MEMORY;
    auto* object = new Object{};
    set_loader_magic_value(object);
    *made = reinterpret_cast<VkInstance>(object);
    return VK_SUCCESS;
}
VKAPI_ATTR void VKAPI_CALL destroyInstance(VkInstance instance, const VkAllocationCallbacks*) {
    delete reinterpret_cast<Object*>(instance);
}
VKAPI_ATTR VkResult VKAPI_CALL enumeratePhysicalDevices(VkInstance, std::uint32_t* count, VkPhysicalDevice*) {
    *count = 0;
    return is("enumerate") ? VK_ERROR_INITIALIZATION_FAILED : VK_SUCCESS;
}
VKAPI_ATTR VkResult VKAPI_CALL extensions(const char*, std::uint32_t* count, VkExtensionProperties*) {
    *count = 0;
    return VK_SUCCESS;
}
/// For functions that a loader asks for and never calls without a device.
VKAPI_ATTR void VKAPI_CALL nothing() {}

template <class Function>
PFN_vkVoidFunction plain(Function function) {
    return reinterpret_cast<PFN_vkVoidFunction>(function);
}

}  // namespace

extern "C" [[gnu::visibility("default")]] PFN_vkVoidFunction vk_icdGetInstanceProcAddr(VkInstance, const char* asked) {
    const std::string_view name = asked;
    if (name == "vkCreateInstance") return plain(createInstance);
    if (name == "vkDestroyInstance") return plain(destroyInstance);
    if (name == "vkEnumeratePhysicalDevices") return plain(enumeratePhysicalDevices);
    if (name == "vkEnumerateInstanceExtensionProperties") return plain(extensions);
    for (const std::string_view maker : {"KHR", "EXT", "LUNARG", "EnumerateInstanceVersion"})
        if (name.find(maker) != std::string_view::npos) return nullptr;
    return plain(nothing);
}

extern "C" [[gnu::visibility("default")]] VkResult vk_icdNegotiateLoaderICDInterfaceVersion(std::uint32_t* version) {
    if (*version > 5) *version = 5;
    return VK_SUCCESS;
}
