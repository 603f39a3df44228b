#include "host/vk/buffer.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "host/vk/commands.h"

namespace vkdose::vk {

namespace {
constexpr VkMemoryPropertyFlags kHost = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
constexpr VkMemoryPropertyFlags kLocal = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
}  // namespace

Buffer::Memory Buffer::allocate(VkDeviceSize size, VkBufferUsageFlags usage, VkMemoryPropertyFlags first,
                                VkMemoryPropertyFlags second) const {
    Memory m;
    VkBufferCreateInfo create{};
    create.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
    create.size = size;
    create.usage = usage;
    create.sharingMode = VK_SHARING_MODE_EXCLUSIVE;
    check(vkCreateBuffer(device_.handle(), &create, nullptr, &m.buffer), "vkCreateBuffer");
    VkMemoryRequirements needs{};
    vkGetBufferMemoryRequirements(device_.handle(), m.buffer, &needs);
    VkMemoryPropertyFlags flags = first;
    int type = device_.memoryType(needs.memoryTypeBits, first);
    if (type < 0) {
        flags = second;
        type = device_.memoryType(needs.memoryTypeBits, second);
    }
    VkMemoryAllocateFlagsInfo addressable{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO, nullptr,
                                          VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT, 0};
    const bool addressed = (usage & VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT) != 0;
    VkMemoryAllocateInfo allocation{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, addressed ? &addressable : nullptr,
                                    needs.size, std::uint32_t(type)};
    VkResult result =
        type < 0 ? VK_ERROR_OUT_OF_DEVICE_MEMORY : vkAllocateMemory(device_.handle(), &allocation, nullptr, &m.memory);
    if (result != VK_SUCCESS) {
        vkDestroyBuffer(device_.handle(), m.buffer, nullptr);
        check(result, fmt::format("allocating {} bytes for {}", size, name_).c_str());
    }
    const char* call = "vkBindBufferMemory";
    result = vkBindBufferMemory(device_.handle(), m.buffer, m.memory, 0);
    if (result == VK_SUCCESS && (flags & kHost) == kHost) {
        call = "vkMapMemory";
        result = vkMapMemory(device_.handle(), m.memory, 0, VK_WHOLE_SIZE, 0, &m.mapped);
    }
    if (result != VK_SUCCESS) release(m);
    check(result, call);
    return m;
}

Buffer::Memory Buffer::staging(VkDeviceSize bytes) const {
    Memory stage = allocate(bytes, VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT, kHost, kHost);
    if (stage.mapped == nullptr) throw std::logic_error("staging memory is host-visible");
    return stage;
}

void Buffer::release(Memory& m) const {
    if (m.buffer != VK_NULL_HANDLE) vkDestroyBuffer(device_.handle(), m.buffer, nullptr);
    if (m.memory != VK_NULL_HANDLE) vkFreeMemory(device_.handle(), m.memory, nullptr);
    m = {};
}

Buffer::Buffer(const Device& device, const char* name, VkDeviceSize size, std::nullptr_t)
    : device_(device), name_(name), size_(size) {}

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
    // A CPU device, or one with a large window into its memory, lets the host touch what the kernels use.
    own_ = allocate(size, usage, kLocal | kHost, kLocal);
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
    release(own_);
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
    Memory stage = staging(bytes);
    std::memcpy(stage.mapped, data, bytes);
    Commands commands(device_);
    commands.begin();
    commands.copy(stage.buffer, 0, buffer_, offset, bytes);
    commands.barrier();
    commands.submit();
    release(stage);
}

void Buffer::read(VkDeviceSize offset, void* data, VkDeviceSize bytes) const {
    if (bytes == 0) return;
    if (own_.mapped != nullptr) {
        std::memcpy(data, static_cast<const char*>(own_.mapped) + offset, bytes);
        return;
    }
    Memory stage = staging(bytes);
    Commands commands(device_);
    commands.begin();
    commands.copy(buffer_, offset, stage.buffer, 0, bytes);
    commands.hostBarrier();
    commands.submit();
    std::memcpy(data, stage.mapped, bytes);
    release(stage);
}

}  // namespace vkdose::vk
