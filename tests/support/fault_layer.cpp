// A Vulkan layer that makes a good driver a bad one, for tests: production code has no hooks. VKDOSE_FAULT names what
// fails, several faults separated by commas; NAME:N fails from the N-th call on (counted from 0).
//
//   no-device       no physical device is shown
//   no-compute      no queue family computes
//   vulkan-1.0      the devices say Vulkan 1.0
//   few-buffers     4 storage buffers per stage, the fewest that Vulkan allows
//   discrete-gpu    the devices say that they are cards
//   least-limits    the limits of compute are the least that Vulkan 1.1 promises, except storage buffers per stage
//   small-range:N   storage buffers of N bytes, 64 KiB without N
//   no-addresses    shaders cannot reach buffers by address
//   few-groups      dispatches of 2 workgroups
//   split-memory    device memory that the host cannot map, as on a discrete card, beside host memory
//   small-window:N  the same, with a window of N bytes into the device memory
//   little-local:N  device memory of N bytes, which the host can map, beside host memory, as some integrated GPUs have
//   huge-limits     every limit of sizes and counts is the largest number there is
//   no-groups       dispatches of no workgroup at all
//   one-invocation  workgroups of one invocation
//   no-period       the clock's period is no number
//   strange-name    names without an end, which move a terminal's cursor
//   many-types      more types and heaps of memory than there can be, and a type in a heap that is not there
//   endless-list    the list of devices never gets complete
//   no-queue        vkCreateDevice fails
//   no-pipeline     vkCreateComputePipelines fails
//   no-memory:N     vkAllocateMemory fails
//   no-map          vkMapMemory fails
//   lost:N          vkQueueSubmit loses the device
//   lost-waiting:N  vkWaitForFences loses it
#include <vulkan/vk_layer.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <cstring>
#include <iterator>
#include <limits>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace {

/// The number after the colon of a fault that is asked for, 0 without one.
std::optional<int> fault(std::string_view name) {
    const char* all = std::getenv("VKDOSE_FAULT");
    std::string_view rest = all == nullptr ? "" : all;
    while (!rest.empty()) {
        const std::string_view one = rest.substr(0, rest.find(','));
        rest.remove_prefix(std::min(rest.size(), one.size() + 1));
        if (one.substr(0, one.find(':')) != name) continue;
        const std::size_t colon = one.find(':');
        return colon == std::string_view::npos ? 0 : std::atoi(std::string(one.substr(colon + 1)).c_str());
    }
    return std::nullopt;
}

/// Whether a call of its kind, counted by `calls`, fails now.
bool failsNow(std::string_view name, std::atomic<int>& calls) {
    const std::optional<int> from = fault(name);
    return from && calls++ >= *from;
}

/// The functions of the layer below. They are asked for when the object is made, because later the loader answers with
/// those of the top layer.
using Functions = std::map<std::string_view, PFN_vkVoidFunction>;

struct Instance {
    PFN_vkGetInstanceProcAddr next = nullptr;
    VkInstance handle = VK_NULL_HANDLE;
    Functions functions;
};
struct Device {
    PFN_vkGetDeviceProcAddr next = nullptr;
    Functions functions;
    std::atomic<int> allocations{0}, submissions{0}, waits{0};
    std::atomic<VkDeviceSize> narrowBytes{0};  ///< that were ever allocated of the narrow heap
};

std::mutex mutex;
std::map<void*, Instance> instances;  // by dispatch table, which an object shares with its children
std::map<void*, Device> devices;

void* key(const void* handle) {
    return *static_cast<void* const*>(handle);
}
Instance& instanceOf(const void* handle) {
    const std::lock_guard lock(mutex);
    return instances.at(key(handle));
}
Device& deviceOf(const void* handle) {
    const std::lock_guard lock(mutex);
    return devices.at(key(handle));
}
/// The functions that this layer intercepts, by name.
const Functions& intercepted();

template <class Function, class Owner>
Function next(const Owner& owner, std::string_view name) {
    return reinterpret_cast<Function>(owner.functions.at(name));
}
#define NEXT(owner, name) next<PFN_##name>(owner, #name)

/// The loader's link to the layer below, and the step down for it.
template <class Link>
Link* linkOf(const void* chain, VkStructureType type) {
    for (auto* at = static_cast<Link*>(const_cast<void*>(chain)); at != nullptr;
         at = static_cast<Link*>(const_cast<void*>(at->pNext)))
        if (at->sType == type && at->function == VK_LAYER_LINK_INFO) return at;
    return nullptr;
}

VKAPI_ATTR VkResult VKAPI_CALL createInstance(const VkInstanceCreateInfo* create,
                                              const VkAllocationCallbacks* allocator, VkInstance* made) {
    auto* link = linkOf<VkLayerInstanceCreateInfo>(create->pNext, VK_STRUCTURE_TYPE_LOADER_INSTANCE_CREATE_INFO);
    if (link == nullptr) return VK_ERROR_INITIALIZATION_FAILED;
    const PFN_vkGetInstanceProcAddr below = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
    link->u.pLayerInfo = link->u.pLayerInfo->pNext;
    const auto call = reinterpret_cast<PFN_vkCreateInstance>(below(VK_NULL_HANDLE, "vkCreateInstance"));
    const VkResult result = call(create, allocator, made);
    if (result != VK_SUCCESS) return result;
    const std::lock_guard lock(mutex);
    Instance& instance = instances[key(*made)];
    instance = {below, *made, {}};
    for (const auto& [name, ours] : intercepted()) instance.functions[name] = below(*made, name.data());
    return VK_SUCCESS;
}

VKAPI_ATTR void VKAPI_CALL destroyInstance(VkInstance instance, const VkAllocationCallbacks* allocator) {
    if (instance == VK_NULL_HANDLE) return;
    void* const table = key(instance);
    NEXT(instanceOf(instance), vkDestroyInstance)(instance, allocator);
    const std::lock_guard lock(mutex);
    instances.erase(table);
}

VKAPI_ATTR VkResult VKAPI_CALL enumeratePhysicalDevices(VkInstance instance, std::uint32_t* count,
                                                        VkPhysicalDevice* found) {
    const VkResult result = NEXT(instanceOf(instance), vkEnumeratePhysicalDevices)(instance, count, found);
    if (fault("endless-list") && found != nullptr) return VK_INCOMPLETE;
    if (!fault("no-device")) return result;
    *count = 0;
    return VK_SUCCESS;
}

VKAPI_ATTR void VKAPI_CALL queueFamilies(VkPhysicalDevice physical, std::uint32_t* count,
                                         VkQueueFamilyProperties* families) {
    NEXT(instanceOf(physical), vkGetPhysicalDeviceQueueFamilyProperties)(physical, count, families);
    for (std::uint32_t i = 0; fault("no-compute") && families != nullptr && i < *count; ++i)
        families[i].queueFlags &= ~VkQueueFlags(VK_QUEUE_COMPUTE_BIT);
}

/// Lowers limits to the least that the specification's table of required limits allows a Vulkan 1.1 device.
void lower(VkPhysicalDeviceLimits& l) {
    const auto least = [](auto& limit, auto value) {
        limit = std::min<std::remove_reference_t<decltype(limit)>>(limit, value);
    };
    least(l.maxStorageBufferRange, 1u << 27);
    least(l.maxTexelBufferElements, 65536u);
    least(l.maxUniformBufferRange, 16384u);
    least(l.maxPushConstantsSize, 128u);
    least(l.maxMemoryAllocationCount, 4096u);
    least(l.maxBoundDescriptorSets, 4u);
    least(l.maxComputeSharedMemorySize, 16384u);
    least(l.maxComputeWorkGroupInvocations, 128u);
    const std::uint32_t size[] = {128, 128, 64};
    for (int axis = 0; axis < 3; ++axis) {
        least(l.maxComputeWorkGroupCount[axis], 65535u);
        least(l.maxComputeWorkGroupSize[axis], size[axis]);
    }
    l.timestampComputeAndGraphics = VK_FALSE;
}

void enlarge(VkPhysicalDeviceLimits& l) {
    l.maxStorageBufferRange = l.maxTexelBufferElements = l.maxUniformBufferRange = l.maxPushConstantsSize =
        l.maxMemoryAllocationCount = l.maxBoundDescriptorSets = l.maxPerStageDescriptorStorageBuffers = ~0u;
    for (std::uint32_t& count : l.maxComputeWorkGroupCount) count = ~0u;
}

template <std::size_t N>
void spoilName(char (&name)[N]) {
    std::fill(std::begin(name), std::end(name), '\033');
}

void spoil(VkPhysicalDeviceProperties& p) {
    if (fault("discrete-gpu")) p.deviceType = VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU;
    if (fault("vulkan-1.0")) p.apiVersion = VK_API_VERSION_1_0;
    if (fault("least-limits")) lower(p.limits);
    if (fault("few-buffers")) p.limits.maxPerStageDescriptorStorageBuffers = 4;
    if (const auto bytes = fault("small-range")) p.limits.maxStorageBufferRange = *bytes > 0 ? *bytes : 65536;
    if (fault("few-groups")) p.limits.maxComputeWorkGroupCount[0] = 2;
    if (fault("huge-limits")) enlarge(p.limits);
    if (fault("no-groups"))
        for (std::uint32_t& count : p.limits.maxComputeWorkGroupCount) count = 0;
    if (fault("one-invocation")) p.limits.maxComputeWorkGroupInvocations = 1;
    if (fault("no-period")) p.limits.timestampPeriod = std::numeric_limits<float>::quiet_NaN();
    if (fault("strange-name")) spoilName(p.deviceName);
}

VKAPI_ATTR void VKAPI_CALL properties(VkPhysicalDevice physical, VkPhysicalDeviceProperties* p) {
    NEXT(instanceOf(physical), vkGetPhysicalDeviceProperties)(physical, p);
    spoil(*p);
}
VKAPI_ATTR void VKAPI_CALL properties2(VkPhysicalDevice physical, VkPhysicalDeviceProperties2* p) {
    NEXT(instanceOf(physical), vkGetPhysicalDeviceProperties2)(physical, p);
    spoil(p->properties);
    for (auto* at = static_cast<VkBaseOutStructure*>(p->pNext); at != nullptr; at = at->pNext)
        if (fault("strange-name") && at->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES)
            spoilName(reinterpret_cast<VkPhysicalDeviceDriverProperties*>(at)->driverInfo);
}

VKAPI_ATTR void VKAPI_CALL features2(VkPhysicalDevice physical, VkPhysicalDeviceFeatures2* features) {
    NEXT(instanceOf(physical), vkGetPhysicalDeviceFeatures2)(physical, features);
    for (auto* at = static_cast<VkBaseOutStructure*>(features->pNext); at != nullptr; at = at->pNext)
        if (fault("no-addresses") && at->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_BUFFER_DEVICE_ADDRESS_FEATURES)
            reinterpret_cast<VkPhysicalDeviceBufferDeviceAddressFeatures*>(at)->bufferDeviceAddress = VK_FALSE;
}

// The types and heaps of split-memory and its kin. All are made of the driver's first host-visible type. Heap 0 of the
// last two has N bytes.
constexpr VkMemoryPropertyFlags kHost = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
constexpr VkMemoryPropertyFlags kLocal = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;

/// The size of heap 0, if it has room for so much only.
std::optional<VkDeviceSize> narrowHeap() {
    for (const char* name : {"small-window", "little-local"})
        if (const auto bytes = fault(name)) return VkDeviceSize(*bytes);
    return std::nullopt;
}

/// The types that are shown; none if the driver's own are.
std::vector<VkMemoryType> shownTypes() {
    if (fault("split-memory")) return {{kLocal, 0}, {kHost, 0}};
    if (fault("small-window")) return {{kLocal | kHost, 0}, {kLocal, 1}, {kHost, 2}};
    if (fault("little-local")) return {{kLocal | kHost, 0}, {kHost, 1}};
    return {};
}

VKAPI_ATTR void VKAPI_CALL memoryProperties(VkPhysicalDevice physical, VkPhysicalDeviceMemoryProperties* p) {
    NEXT(instanceOf(physical), vkGetPhysicalDeviceMemoryProperties)(physical, p);
    if (fault("many-types")) {
        p->memoryTypes[VK_MAX_MEMORY_TYPES - 1] = {kLocal | kHost, VK_MAX_MEMORY_HEAPS + 7};
        p->memoryTypeCount = p->memoryHeapCount = 4096;
    }
    const std::vector<VkMemoryType> shown = shownTypes();
    if (shown.empty()) return;
    p->memoryTypeCount = std::uint32_t(shown.size());
    std::copy(shown.begin(), shown.end(), p->memoryTypes);
    const auto narrow = narrowHeap();
    if (!narrow) return;
    p->memoryHeapCount = shown.back().heapIndex + 1;
    for (std::uint32_t h = 1; h < p->memoryHeapCount; ++h) p->memoryHeaps[h] = {p->memoryHeaps[0].size, 0};
    if (fault("small-window")) p->memoryHeaps[1].flags = VK_MEMORY_HEAP_DEVICE_LOCAL_BIT;
    p->memoryHeaps[0] = {*narrow, VK_MEMORY_HEAP_DEVICE_LOCAL_BIT};
}
VKAPI_ATTR void VKAPI_CALL bufferRequirements(VkDevice device, VkBuffer buffer, VkMemoryRequirements* needs) {
    NEXT(deviceOf(device), vkGetBufferMemoryRequirements)(device, buffer, needs);
    if (const std::size_t shown = shownTypes().size(); shown > 0) needs->memoryTypeBits = (1u << shown) - 1;
}

VKAPI_ATTR VkResult VKAPI_CALL createDevice(VkPhysicalDevice physical, const VkDeviceCreateInfo* create,
                                            const VkAllocationCallbacks* allocator, VkDevice* made) {
    if (fault("no-queue")) return VK_ERROR_INITIALIZATION_FAILED;
    auto* link = linkOf<VkLayerDeviceCreateInfo>(create->pNext, VK_STRUCTURE_TYPE_LOADER_DEVICE_CREATE_INFO);
    if (link == nullptr) return VK_ERROR_INITIALIZATION_FAILED;
    const PFN_vkGetInstanceProcAddr below = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
    const PFN_vkGetDeviceProcAddr belowDevice = link->u.pLayerInfo->pfnNextGetDeviceProcAddr;
    link->u.pLayerInfo = link->u.pLayerInfo->pNext;
    const auto call = reinterpret_cast<PFN_vkCreateDevice>(below(instanceOf(physical).handle, "vkCreateDevice"));
    const VkResult result = call(physical, create, allocator, made);
    if (result != VK_SUCCESS) return result;
    const std::lock_guard lock(mutex);
    Device& device = devices[key(*made)];
    device.next = belowDevice;
    for (const auto& [name, ours] : intercepted()) device.functions[name] = belowDevice(*made, name.data());
    device.allocations = device.submissions = device.waits = 0;
    device.narrowBytes = 0;
    return VK_SUCCESS;
}

VKAPI_ATTR void VKAPI_CALL destroyDevice(VkDevice device, const VkAllocationCallbacks* allocator) {
    if (device == VK_NULL_HANDLE) return;
    void* const table = key(device);
    NEXT(deviceOf(device), vkDestroyDevice)(device, allocator);
    const std::lock_guard lock(mutex);
    devices.erase(table);
}

VKAPI_ATTR VkResult VKAPI_CALL allocateMemory(VkDevice device, const VkMemoryAllocateInfo* info,
                                              const VkAllocationCallbacks* allocator, VkDeviceMemory* memory) {
    Device& d = deviceOf(device);
    if (failsNow("no-memory", d.allocations)) return VK_ERROR_OUT_OF_DEVICE_MEMORY;
    VkMemoryAllocateInfo real = *info;
    if (!shownTypes().empty()) real.memoryTypeIndex = 0;
    const auto narrow = narrowHeap();
    if (narrow && info->memoryTypeIndex == 0 && (d.narrowBytes += info->allocationSize) > *narrow) {
        d.narrowBytes -= info->allocationSize;
        return VK_ERROR_OUT_OF_DEVICE_MEMORY;
    }
    return NEXT(d, vkAllocateMemory)(device, &real, allocator, memory);
}
VKAPI_ATTR VkResult VKAPI_CALL mapMemory(VkDevice device, VkDeviceMemory memory, VkDeviceSize offset, VkDeviceSize size,
                                         VkMemoryMapFlags flags, void** data) {
    if (fault("no-map")) return VK_ERROR_MEMORY_MAP_FAILED;
    return NEXT(deviceOf(device), vkMapMemory)(device, memory, offset, size, flags, data);
}
VKAPI_ATTR VkResult VKAPI_CALL createPipelines(VkDevice device, VkPipelineCache cache, std::uint32_t count,
                                               const VkComputePipelineCreateInfo* infos,
                                               const VkAllocationCallbacks* allocator, VkPipeline* made) {
    if (fault("no-pipeline")) return VK_ERROR_OUT_OF_HOST_MEMORY;
    return NEXT(deviceOf(device), vkCreateComputePipelines)(device, cache, count, infos, allocator, made);
}
VKAPI_ATTR VkResult VKAPI_CALL queueSubmit(VkQueue queue, std::uint32_t count, const VkSubmitInfo* infos,
                                           VkFence fence) {
    Device& d = deviceOf(queue);
    if (failsNow("lost", d.submissions)) return VK_ERROR_DEVICE_LOST;
    return NEXT(d, vkQueueSubmit)(queue, count, infos, fence);
}
VKAPI_ATTR VkResult VKAPI_CALL waitForFences(VkDevice device, std::uint32_t count, const VkFence* fences, VkBool32 all,
                                             std::uint64_t timeout) {
    Device& d = deviceOf(device);
    const VkResult result = NEXT(d, vkWaitForFences)(device, count, fences, all, timeout);
    return failsNow("lost-waiting", d.waits) ? VK_ERROR_DEVICE_LOST : result;
}

PFN_vkVoidFunction ours(const char* name) {
    const auto found = intercepted().find(name);
    return found == intercepted().end() ? nullptr : found->second;
}
VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL getDeviceProcAddr(VkDevice device, const char* name) {
    if (const auto function = ours(name)) return function;
    return deviceOf(device).next(device, name);
}
VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL getInstanceProcAddr(VkInstance instance, const char* name) {
    if (const auto function = ours(name)) return function;
    return instance == VK_NULL_HANDLE ? nullptr : instanceOf(instance).next(instance, name);
}

const Functions& intercepted() {
    static const Functions functions = [] {
        Functions all;
        const auto add = [&](std::string_view name, auto function) {
            all[name] = reinterpret_cast<PFN_vkVoidFunction>(function);
        };
        add("vkGetInstanceProcAddr", getInstanceProcAddr);
        add("vkGetDeviceProcAddr", getDeviceProcAddr);
        add("vkCreateInstance", createInstance);
        add("vkDestroyInstance", destroyInstance);
        add("vkEnumeratePhysicalDevices", enumeratePhysicalDevices);
        add("vkGetPhysicalDeviceQueueFamilyProperties", queueFamilies);
        add("vkGetPhysicalDeviceProperties", properties);
        add("vkGetPhysicalDeviceProperties2", properties2);
        add("vkGetPhysicalDeviceFeatures2", features2);
        add("vkGetPhysicalDeviceMemoryProperties", memoryProperties);
        add("vkGetBufferMemoryRequirements", bufferRequirements);
        add("vkCreateDevice", createDevice);
        add("vkDestroyDevice", destroyDevice);
        add("vkAllocateMemory", allocateMemory);
        add("vkMapMemory", mapMemory);
        add("vkCreateComputePipelines", createPipelines);
        add("vkQueueSubmit", queueSubmit);
        add("vkWaitForFences", waitForFences);
        return all;
    }();
    return functions;
}

}  // namespace

extern "C" [[gnu::visibility("default")]] VkResult vkNegotiateLoaderLayerInterfaceVersion(
    VkNegotiateLayerInterface* pVersionStruct) {
    pVersionStruct->loaderLayerInterfaceVersion = 2;
    pVersionStruct->pfnGetInstanceProcAddr = getInstanceProcAddr;
    pVersionStruct->pfnGetDeviceProcAddr = getDeviceProcAddr;
    pVersionStruct->pfnGetPhysicalDeviceProcAddr = nullptr;
    return VK_SUCCESS;
}
