#include "host/vk/buffer.h"

#include <fmt/format.h>

#include <algorithm>

#include "host/vk/commands.h"

namespace vkdose::vk {

namespace {
constexpr VkMemoryPropertyFlags kHost = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
constexpr VkMemoryPropertyFlags kLocal = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
}  // namespace

Buffer::Memory::~Memory() {
    if (buffer != VK_NULL_HANDLE) vkDestroyBuffer(device, buffer, nullptr);
    if (memory != VK_NULL_HANDLE) vkFreeMemory(device, memory, nullptr);
}

void Buffer::allocate(Memory& m, VkDeviceSize size, VkBufferUsageFlags usage,
                      std::initializer_list<VkMemoryPropertyFlags> wishes) const {
    VkBufferCreateInfo create{};
    create.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
    create.size = size;
    create.usage = usage;
    create.sharingMode = VK_SHARING_MODE_EXCLUSIVE;
    check(vkCreateBuffer(m.device, &create, nullptr, &m.buffer), "vkCreateBuffer");
    VkMemoryRequirements needs{};
    vkGetBufferMemoryRequirements(m.device, m.buffer, &needs);
    VkMemoryAllocateFlagsInfo addressable{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO, nullptr,
                                          VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT, 0};
    const bool addressed = (usage & VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT) != 0;
    VkMemoryAllocateInfo allocation{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, addressed ? &addressable : nullptr,
                                    needs.size, 0};
    VkResult result = VK_ERROR_OUT_OF_DEVICE_MEMORY;
    for (const VkMemoryPropertyFlags wish : wishes)
        for (const std::uint32_t type : device_.memoryTypes(needs.memoryTypeBits, wish, needs.size)) {
            if (result == VK_SUCCESS) break;
            allocation.memoryTypeIndex = type;
            result = vkAllocateMemory(m.device, &allocation, nullptr, &m.memory);
        }
    check(result, fmt::format("allocating {} bytes for {}", size, name_).c_str());
    check(vkBindBufferMemory(m.device, m.buffer, m.memory, 0), "vkBindBufferMemory");
    if ((device_.memoryFlags(allocation.memoryTypeIndex) & kHost) == kHost)
        check(vkMapMemory(m.device, m.memory, 0, VK_WHOLE_SIZE, 0, &m.mapped), "vkMapMemory");
}

void Buffer::allocateStaging(Memory& stage, VkDeviceSize bytes) const {
    allocate(stage, bytes, VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT, {kHost});
}

Buffer::Buffer(const Device& device, const char* name, VkDeviceSize size, std::nullptr_t)
    : device_(device), name_(name), size_(size), own_(device.handle()) {}

Buffer::Buffer(const Device& device, const char* name, VkDeviceSize size, VkFormat texelFormat, Reach reach)
    : Buffer(device, name, size, nullptr) {
    const VkDeviceSize most =
        reach == Reach::Addressed ? device.longestBuffer() : device.limits().maxStorageBufferRange;
    if (size > most)
        throw DeviceError(
            fmt::format("{} needs {} bytes, but {} allows storage buffers of {} bytes: use fewer particles "
                        "or another device",
                        name, size, device.info().name, most));
    VkBufferUsageFlags usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT |
                               VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    if (texelFormat != VK_FORMAT_UNDEFINED) usage |= VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT;
    if (reach == Reach::Addressed) usage |= VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;
    // Best is the device's own memory where the host sees it, as on a CPU device or through the window into a card's
    // memory. A window may be small; what it has no room for goes into the rest. A GPU within a processor may have
    // little memory of its own, and takes the machine's. A card would take that too, and be slow with it without a
    // word.
    if (device.info().type == "discrete GPU")
        allocate(own_, size, usage, {kLocal | kHost, kLocal});
    else
        allocate(own_, size, usage, {kLocal | kHost, kLocal, kHost});
    buffer_ = own_.buffer;
    if (texelFormat != VK_FORMAT_UNDEFINED) {
        VkBufferViewCreateInfo view{
            VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO, nullptr, 0, buffer_, texelFormat, 0, VK_WHOLE_SIZE};
        check(vkCreateBufferView(device_.handle(), &view, nullptr, &view_), "vkCreateBufferView");
    }
    if (reach == Reach::Addressed) address_ = device_.addressOf(buffer_);
    Commands commands(device_);
    commands.begin();
    vkCmdFillBuffer(commands.handle(), buffer_, 0, VK_WHOLE_SIZE, 0);
    commands.hostBarrier();
    commands.submit();
}

Buffer::~Buffer() {
    if (view_ != VK_NULL_HANDLE) vkDestroyBufferView(device_.handle(), view_, nullptr);
}

VkDeviceSize Buffer::bound() const {
    return std::min<VkDeviceSize>(size_, device_.limits().maxStorageBufferRange);
}

void Buffer::write(VkDeviceSize offset, const void* data, VkDeviceSize bytes) {
    if (bytes == 0) return;
    if (own_.mapped != nullptr) {
        std::memcpy(static_cast<char*>(own_.mapped) + offset, data, bytes);
        return;
    }
    Memory stage(device_.handle());
    allocateStaging(stage, bytes);
    std::memcpy(stage.mapped, data, bytes);
    Commands commands(device_);
    commands.begin();
    commands.copy(stage.buffer, 0, buffer_, offset, bytes);
    commands.barrier();
    commands.submit();
}

void Buffer::read(VkDeviceSize offset, void* data, VkDeviceSize bytes) const {
    if (bytes == 0) return;
    if (own_.mapped != nullptr) {
        std::memcpy(data, static_cast<const char*>(own_.mapped) + offset, bytes);
        return;
    }
    Memory stage(device_.handle());
    allocateStaging(stage, bytes);
    Commands commands(device_);
    commands.begin();
    commands.copy(buffer_, offset, stage.buffer, 0, bytes);
    commands.hostBarrier();
    commands.submit();
    std::memcpy(data, stage.mapped, bytes);
}

}  // namespace vkdose::vk
