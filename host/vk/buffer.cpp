#include "host/vk/buffer.h"

#include <fmt/format.h>

#include <algorithm>

#include "host/vk/commands.h"

namespace vkdose::vk {

namespace {
constexpr VkMemoryPropertyFlags kHost = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
constexpr VkMemoryPropertyFlags kLocal = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
constexpr VkMemoryPropertyFlags kCached = VK_MEMORY_PROPERTY_HOST_CACHED_BIT;
/// Up to so many bytes the host reads directly from memory that it does not cache; more is copied first. Each load
/// waits for the bus, so that a card's memory gives some tens of megabytes a second. A copy takes about as long as a
/// kilobyte.
constexpr VkDeviceSize kFewBytes = 1024;
constexpr VkDeviceSize kMostStaged = 4 << 20;  ///< at once [bytes]
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
    const VkMemoryPropertyFlags has = device_.memoryFlags(allocation.memoryTypeIndex);
    m.cached = (has & kCached) != 0;
    if ((has & kHost) == kHost) check(vkMapMemory(m.device, m.memory, 0, VK_WHOLE_SIZE, 0, &m.mapped), "vkMapMemory");
}

VkDeviceSize Buffer::stageBytes() const {
    return std::min(size_, kMostStaged);
}

Buffer::Memory& Buffer::stage() const {
    if (!stage_) {
        auto made = std::make_unique<Memory>(device_.handle());
        allocate(*made, stageBytes(), VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                 {kHost | kCached, kHost});
        stage_ = std::move(made);
    }
    return *stage_;
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
    const char* from = static_cast<const char*>(data);
    if (own_.mapped != nullptr) {
        std::memcpy(static_cast<char*>(own_.mapped) + offset, from, bytes);
        return;
    }
    Commands commands(device_);
    for (VkDeviceSize done = 0; done < bytes;) {
        const VkDeviceSize n = std::min(bytes - done, stageBytes());
        std::memcpy(stage().mapped, from + done, n);
        commands.begin();
        commands.copy(stage().buffer, 0, buffer_, offset + done, n);
        commands.barrier();
        commands.submit();
        done += n;
    }
}

void Buffer::read(const std::vector<Part>& parts, void* data) const {
    VkDeviceSize bytes = 0;
    for (const Part& part : parts) bytes += part.bytes;
    if (bytes == 0) return;
    char* to = static_cast<char*>(data);
    if (own_.mapped != nullptr && (own_.cached || bytes <= kFewBytes)) {
        for (const Part& part : parts) {
            std::memcpy(to, static_cast<const char*>(own_.mapped) + part.offset, part.bytes);
            to += part.bytes;
        }
        return;
    }
    Commands commands(device_);
    VkDeviceSize staged = 0;
    const auto take = [&] {
        commands.hostBarrier();
        commands.submit();
        std::memcpy(to, stage().mapped, staged);
        to += staged;
        staged = 0;
    };
    for (const Part& part : parts)
        for (VkDeviceSize done = 0; done < part.bytes;) {
            const VkDeviceSize n = std::min(part.bytes - done, stageBytes() - staged);
            if (staged == 0) commands.begin();
            commands.copy(buffer_, part.offset + done, stage().buffer, staged, n);
            staged += n;
            done += n;
            if (staged == stageBytes()) take();
        }
    if (staged > 0) take();
}

void Buffer::clear(const std::vector<Part>& parts) {
    if (parts.empty()) return;
    if (own_.mapped != nullptr && own_.cached) {
        for (const Part& part : parts) std::memset(static_cast<char*>(own_.mapped) + part.offset, 0, part.bytes);
        return;
    }
    Commands commands(device_);
    commands.begin();
    for (const Part& part : parts) vkCmdFillBuffer(commands.handle(), buffer_, part.offset, part.bytes, 0);
    commands.hostBarrier();
    commands.submit();
}

}  // namespace vkdose::vk
