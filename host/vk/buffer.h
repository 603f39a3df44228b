#pragma once
// A storage buffer with its own memory, optionally seen through a texel view as well.

#include <volk.h>

#include <cstddef>
#include <cstring>
#include <initializer_list>
#include <memory>
#include <span>
#include <vector>

#include "host/vk/device.h"

namespace vkdose::vk {

/// How passes come to a buffer: through its binding, or by its address.
enum class Reach { Bound, Addressed };

class Buffer {
  public:
    /// Zero-filled. `texelFormat` other than undefined adds a uniform texel view over the whole buffer.
    /// Throws DeviceError, naming `name`, if the size exceeds what the device can bind, or allocate where it gives
    /// addresses, or its memory.
    Buffer(const Device& device, const char* name, VkDeviceSize size, VkFormat texelFormat = VK_FORMAT_UNDEFINED,
           Reach reach = Reach::Bound);
    ~Buffer();
    Buffer(const Buffer&) = delete;
    Buffer& operator=(const Buffer&) = delete;

    VkBuffer handle() const { return buffer_; }
    VkDeviceSize size() const { return size_; }
    VkBufferView texelView() const { return view_; }
    VkDeviceAddress address() const { return address_; }  ///< 0 unless it is reached by address
    VkDeviceSize bound() const;                           ///< as much as a binding shows of it [bytes]

    struct Part {
        VkDeviceSize offset, bytes;
    };

    /// Host access, through a staging buffer where the host does not see the memory or would read it slowly. The device
    /// must be idle. Several parts are put into `data` one after another.
    void write(VkDeviceSize offset, const void* data, VkDeviceSize bytes);
    void read(VkDeviceSize offset, void* data, VkDeviceSize bytes) const { read({{offset, bytes}}, data); }
    void read(const std::vector<Part>& parts, void* data) const;
    /// Fills the parts with zeros. Offsets and sizes are multiples of 4.
    void clear(const std::vector<Part>& parts);

    template <class T>
    void writeAll(const std::vector<T>& values, VkDeviceSize offset = 0) {
        write(offset, values.data(), values.size() * sizeof(T));
    }
    template <class T>
    std::vector<T> readAll(std::size_t count, VkDeviceSize offset = 0) const {
        std::vector<T> values(count);
        read(offset, values.data(), count * sizeof(T));
        return values;
    }

  private:
    /// A buffer of Vulkan and its memory, freed with it.
    struct Memory {
        explicit Memory(VkDevice owner) : device(owner) {}
        ~Memory();
        Memory(const Memory&) = delete;
        Memory& operator=(const Memory&) = delete;

        VkDevice device;
        VkBuffer buffer = VK_NULL_HANDLE;
        VkDeviceMemory memory = VK_NULL_HANDLE;
        void* mapped = nullptr;  ///< null where the host does not see it
        bool cached = false;     ///< the host reads it as fast as its own
    };
    Buffer(const Device& device, const char* name, VkDeviceSize size, std::nullptr_t);
    /// In the first of the wished kinds of memory that has room for it.
    void allocate(Memory& m, VkDeviceSize size, VkBufferUsageFlags usage,
                  std::initializer_list<VkMemoryPropertyFlags> wishes) const;
    /// Memory of the host for what goes in and out. It is made once, because that can take milliseconds.
    Memory& stage() const;
    VkDeviceSize stageBytes() const;

    const Device& device_;
    const char* name_;
    VkDeviceSize size_;
    VkBuffer buffer_ = VK_NULL_HANDLE;
    Memory own_;
    mutable std::unique_ptr<Memory> stage_;
    VkBufferView view_ = VK_NULL_HANDLE;
    VkDeviceAddress address_ = 0;
};

}  // namespace vkdose::vk
