#pragma once
// Compute pipelines over one descriptor set shared by all of them.

#include <volk.h>

#include <cstdint>
#include <span>
#include <vector>

#include "host/vk/buffer.h"
#include "host/vk/device.h"

namespace vkdose::vk {

/// The bindings of the one set: first the storage buffers, numbered in their order, then the texel views of those that
/// have one. The binding of a view is that of its buffer plus the number of buffers.
class BindingSet {
  public:
    BindingSet(const Device& device, const std::vector<const Buffer*>& buffers, std::uint32_t pushBytes);
    ~BindingSet();
    BindingSet(const BindingSet&) = delete;
    BindingSet& operator=(const BindingSet&) = delete;

    VkPipelineLayout layout() const { return layout_; }
    void bind(VkCommandBuffer commands) const;
    void push(VkCommandBuffer commands, const void* data) const;

  private:
    BindingSet(const Device& device, std::uint32_t pushBytes) : device_(device), pushBytes_(pushBytes) {}

    const Device& device_;
    std::uint32_t pushBytes_;
    VkDescriptorSetLayout setLayout_ = VK_NULL_HANDLE;
    VkPipelineLayout layout_ = VK_NULL_HANDLE;
    VkDescriptorPool pool_ = VK_NULL_HANDLE;
    VkDescriptorSet set_ = VK_NULL_HANDLE;
};

class Pipeline {
  public:
    /// `constants` are the specialisation constants 0, 1, ... (32-bit).
    Pipeline(const Device& device, const BindingSet& bindings, std::span<const std::uint32_t> spirv,
             std::span<const std::uint32_t> constants);
    ~Pipeline();
    Pipeline(const Pipeline&) = delete;
    Pipeline& operator=(const Pipeline&) = delete;

    void bind(VkCommandBuffer commands) const;

  private:
    const Device& device_;
    VkPipeline pipeline_ = VK_NULL_HANDLE;
};

}  // namespace vkdose::vk
