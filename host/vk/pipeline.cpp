#include "host/vk/pipeline.h"

#include <cassert>

namespace vkdose::vk {

BindingSet::BindingSet(const Device& device, const std::vector<const Buffer*>& buffers, std::uint32_t pushBytes)
    : BindingSet(device, pushBytes) {
    const std::uint32_t count = std::uint32_t(buffers.size());
    assert(count <= kStorageBuffers);
    std::vector<std::uint32_t> viewed;  // those that have a view
    std::vector<VkDescriptorSetLayoutBinding> bindings;
    for (std::uint32_t i = 0; i < count; ++i)
        bindings.push_back({i, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr});
    for (std::uint32_t i = 0; i < count; ++i) {
        if (buffers[i]->texelView() == VK_NULL_HANDLE) continue;
        viewed.push_back(i);
        bindings.push_back(
            {count + i, VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr});
    }
    VkDescriptorSetLayoutCreateInfo setInfo{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO, nullptr, 0,
                                            std::uint32_t(bindings.size()), bindings.data()};
    check(vkCreateDescriptorSetLayout(device.handle(), &setInfo, nullptr, &setLayout_), "vkCreateDescriptorSetLayout");

    VkPushConstantRange range{VK_SHADER_STAGE_COMPUTE_BIT, 0, pushBytes};
    VkPipelineLayoutCreateInfo layoutInfo{
        VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO, nullptr, 0, 1, &setLayout_, 1, &range};
    check(vkCreatePipelineLayout(device.handle(), &layoutInfo, nullptr, &layout_), "vkCreatePipelineLayout");

    std::vector<VkDescriptorPoolSize> sizes{{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, count}};
    const auto views = std::uint32_t(viewed.size());
    if (views > 0) sizes.push_back({VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER, views});
    VkDescriptorPoolCreateInfo poolInfo{
        VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO, nullptr, 0, 1, std::uint32_t(sizes.size()), sizes.data()};
    check(vkCreateDescriptorPool(device.handle(), &poolInfo, nullptr, &pool_), "vkCreateDescriptorPool");
    VkDescriptorSetAllocateInfo allocate{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO, nullptr, pool_, 1,
                                         &setLayout_};
    check(vkAllocateDescriptorSets(device.handle(), &allocate, &set_), "vkAllocateDescriptorSets");

    std::vector<VkDescriptorBufferInfo> whole(count);
    std::vector<VkBufferView> texels(count);
    std::vector<VkWriteDescriptorSet> writes;
    const auto write = [&](std::uint32_t binding, VkDescriptorType type) -> VkWriteDescriptorSet& {
        VkWriteDescriptorSet w{};
        w.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
        w.dstSet = set_;
        w.dstBinding = binding;
        w.descriptorCount = 1;
        w.descriptorType = type;
        return writes.emplace_back(w);
    };
    for (std::uint32_t i = 0; i < count; ++i) {
        whole[i] = {buffers[i]->handle(), 0, buffers[i]->bound()};
        write(i, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER).pBufferInfo = &whole[i];
    }
    for (const std::uint32_t i : viewed) {
        texels[i] = buffers[i]->texelView();
        write(count + i, VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER).pTexelBufferView = &texels[i];
    }
    vkUpdateDescriptorSets(device.handle(), std::uint32_t(writes.size()), writes.data(), 0, nullptr);
}

BindingSet::~BindingSet() {
    vkDestroyDescriptorPool(device_.handle(), pool_, nullptr);
    vkDestroyPipelineLayout(device_.handle(), layout_, nullptr);
    vkDestroyDescriptorSetLayout(device_.handle(), setLayout_, nullptr);
}

void BindingSet::bind(VkCommandBuffer commands) const {
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout_, 0, 1, &set_, 0, nullptr);
}

void BindingSet::push(VkCommandBuffer commands, const void* data) const {
    vkCmdPushConstants(commands, layout_, VK_SHADER_STAGE_COMPUTE_BIT, 0, pushBytes_, data);
}

Pipeline::Pipeline(const Device& device, const BindingSet& bindings, std::span<const std::uint32_t> spirv,
                   std::span<const std::uint32_t> constants)
    : device_(device) {
    VkShaderModuleCreateInfo moduleInfo{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO, nullptr, 0, spirv.size_bytes(),
                                        spirv.data()};
    VkShaderModule module = VK_NULL_HANDLE;
    check(vkCreateShaderModule(device.handle(), &moduleInfo, nullptr, &module), "vkCreateShaderModule");

    std::vector<VkSpecializationMapEntry> entries;
    for (std::uint32_t i = 0; i < constants.size(); ++i) entries.push_back({i, i * 4u, 4u});
    VkSpecializationInfo specialisation{std::uint32_t(entries.size()), entries.data(), constants.size_bytes(),
                                        constants.data()};
    VkComputePipelineCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
    info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
    info.stage.module = module;
    info.stage.pName = "main";
    info.stage.pSpecializationInfo = &specialisation;
    info.layout = bindings.layout();
    VkResult result = vkCreateComputePipelines(device.handle(), VK_NULL_HANDLE, 1, &info, nullptr, &pipeline_);
    vkDestroyShaderModule(device.handle(), module, nullptr);
    check(result, "vkCreateComputePipelines");
}

Pipeline::~Pipeline() {
    vkDestroyPipeline(device_.handle(), pipeline_, nullptr);
}

void Pipeline::bind(VkCommandBuffer commands) const {
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_);
}

}  // namespace vkdose::vk
