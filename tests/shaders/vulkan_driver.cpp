// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Vulkan, without a display: a compute shader, in GLSL or HLSL, by way of glslangValidator.
#include "shaders/job.h"

#include <fmt/format.h>

#include <fstream>

#include "support/program.h"

#ifdef LTCFIT_HAS_VULKAN
#include <vulkan/vulkan.h>
#endif

namespace ltc::test::shaders {

#ifdef LTCFIT_HAS_VULKAN
namespace {

// Two buffers, the images, and in HLSL a sampler.
std::string glsl_entry(const Job& job) {
  return R"(
layout(local_size_x = 64) in;
layout(set = 0, binding = 0, std430) readonly buffer Asked { vec4 asked[]; };
layout(set = 0, binding = 1, std430) buffer Answers { vec4 answers[]; };
)" + for_textures(job, "layout(set = 0, binding = 2 + {1}) uniform sampler{2}D {0};\n") +
         R"(void main() {
  int item = int(gl_GlobalInvocationID.x);
  if (4 * item >= asked.length()) return;
  LtcCase found = ltc_case()" +
         for_textures(job, "{0}, ") + R"(asked[4 * item], asked[4 * item + 1],
                           asked[4 * item + 2], asked[4 * item + 3]);
  answers[6 * item] = found.r0;
  answers[6 * item + 1] = found.r1;
  answers[6 * item + 2] = found.r2;
  answers[6 * item + 3] = found.r3;
  answers[6 * item + 4] = found.r4;
  answers[6 * item + 5] = found.r5;
}
)";
}

std::string hlsl_entry(const Job& job) {
  return R"(
[[vk::binding(0)]] StructuredBuffer<float4> asked;
[[vk::binding(1)]] RWStructuredBuffer<float4> answers;
)" + for_textures(job, "[[vk::binding(2 + {1})]] Texture{2}D<float4> {0};\n") +
         fmt::format("[[vk::binding({})]] SamplerState linear_clamp;\n", job.textures.size() + 2) +
         R"([numthreads(64, 1, 1)] void main(uint3 id : SV_DispatchThreadID) {
  uint item = id.x, count, stride;
  asked.GetDimensions(count, stride);
  if (4 * item >= count) return;
  LtcCase found = ltc_case()" +
         for_textures(job, "{0}, linear_clamp, ") + R"(asked[4 * item], asked[4 * item + 1],
                           asked[4 * item + 2], asked[4 * item + 3]);
  answers[6 * item] = found.r0;
  answers[6 * item + 1] = found.r1;
  answers[6 * item + 2] = found.r2;
  answers[6 * item + 3] = found.r3;
  answers[6 * item + 4] = found.r4;
  answers[6 * item + 5] = found.r5;
}
)";
}

void check(VkResult result, const char* what) {
  if (result != VK_SUCCESS)
    throw std::runtime_error(std::string(what) + ": Vulkan error " + std::to_string(result));
}

std::vector<std::uint32_t> compiled(const Job& job, VulkanSource source) {
  const TemporaryDirectory folder;
  std::vector<std::string> command = {"glslangValidator", "-V", "-S", "comp", "-o", "a.spv"};
  if (source == VulkanSource::glsl) {
    folder.write("a.comp", "#version 450\n" + job.glsl + glsl_entry(job));
    command.insert(command.end(), {"a.comp"});
  } else {
    folder.write("a.hlsl", job.hlsl + hlsl_entry(job));
    command.insert(command.end(), {"-D", "-e", "main", "a.hlsl"});
  }
  const ProgramResult result = run_program(command, folder.path());
  if (result.exit_code == 127)
    throw Missing("no glslangValidator");
  if (result.exit_code != 0)
    throw std::runtime_error(result.out + result.err);
  std::ifstream file(folder / "a.spv", std::ios::binary | std::ios::ate);
  std::vector<std::uint32_t> words(static_cast<std::size_t>(file.tellg()) / 4);
  file.seekg(0);
  file.read(reinterpret_cast<char*>(words.data()), static_cast<std::streamsize>(4 * words.size()));
  return words;
}

// One device with one queue. What it makes it keeps until the process ends: a test's.
class Device {
 public:
  Device() {
    const VkApplicationInfo application = {.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO,
                                           .apiVersion = VK_API_VERSION_1_1};
    const VkInstanceCreateInfo of_instance = {.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
                                              .pApplicationInfo = &application};
    if (vkCreateInstance(&of_instance, nullptr, &instance_) != VK_SUCCESS)
      throw Missing("no Vulkan driver (mesa-vulkan-drivers)");
    std::uint32_t count = 1;
    vkEnumeratePhysicalDevices(instance_, &count, &physical_);
    if (count == 0)
      throw Missing("no Vulkan device (mesa-vulkan-drivers)");
    const float priority = 1;
    const VkDeviceQueueCreateInfo of_queue = {.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
                                              .queueCount = 1,
                                              .pQueuePriorities = &priority};
    const VkDeviceCreateInfo of_device = {.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
                                          .queueCreateInfoCount = 1,
                                          .pQueueCreateInfos = &of_queue};
    check(vkCreateDevice(physical_, &of_device, nullptr, &device_), "device");
    vkGetDeviceQueue(device_, 0, 0, &queue_);
    const VkCommandPoolCreateInfo of_pool = {.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
    check(vkCreateCommandPool(device_, &of_pool, nullptr, &pool_), "command pool");
  }
  ~Device() {
    vkDeviceWaitIdle(device_);
    vkDestroyDevice(device_, nullptr);
    vkDestroyInstance(instance_, nullptr);
  }
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  operator VkDevice() const { return device_; }

  VkDeviceMemory memory(const VkMemoryRequirements& needs, VkMemoryPropertyFlags kind) const {
    VkPhysicalDeviceMemoryProperties all;
    vkGetPhysicalDeviceMemoryProperties(physical_, &all);
    for (std::uint32_t i = 0; i < all.memoryTypeCount; ++i)
      if (needs.memoryTypeBits >> i & 1 && (all.memoryTypes[i].propertyFlags & kind) == kind) {
        const VkMemoryAllocateInfo of_memory = {.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
                                                .allocationSize = needs.size,
                                                .memoryTypeIndex = i};
        VkDeviceMemory memory = VK_NULL_HANDLE;
        check(vkAllocateMemory(device_, &of_memory, nullptr, &memory), "memory");
        return memory;
      }
    throw std::runtime_error("no memory of the kind");
  }

  // Records, submits and waits.
  template <typename Record>
  void run(Record record) const {
    const VkCommandBufferAllocateInfo of_commands = {
        .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
        .commandPool = pool_,
        .commandBufferCount = 1};
    VkCommandBuffer commands = VK_NULL_HANDLE;
    check(vkAllocateCommandBuffers(device_, &of_commands, &commands), "command buffer");
    const VkCommandBufferBeginInfo begin = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    vkBeginCommandBuffer(commands, &begin);
    record(commands);
    vkEndCommandBuffer(commands);
    const VkSubmitInfo submit = {.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO,
                                 .commandBufferCount = 1,
                                 .pCommandBuffers = &commands};
    check(vkQueueSubmit(queue_, 1, &submit, VK_NULL_HANDLE), "submit");
    check(vkQueueWaitIdle(queue_), "wait");
  }

 private:
  VkInstance instance_ = VK_NULL_HANDLE;
  VkPhysicalDevice physical_ = VK_NULL_HANDLE;
  VkDevice device_ = VK_NULL_HANDLE;
  VkQueue queue_ = VK_NULL_HANDLE;
  VkCommandPool pool_ = VK_NULL_HANDLE;
};

// Memory that both sides see.
struct Buffer {
  VkBuffer handle = VK_NULL_HANDLE;
  float* values = nullptr;
};

Buffer make_buffer(const Device& device, std::size_t count, VkBufferUsageFlags use) {
  const VkBufferCreateInfo of_buffer = {
      .sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO, .size = 4 * count, .usage = use};
  Buffer buffer;
  check(vkCreateBuffer(device, &of_buffer, nullptr, &buffer.handle), "buffer");
  VkMemoryRequirements needs;
  vkGetBufferMemoryRequirements(device, buffer.handle, &needs);
  const VkDeviceMemory memory = device.memory(
      needs, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
  vkBindBufferMemory(device, buffer.handle, memory, 0);
  void* place = nullptr;
  check(vkMapMemory(device, memory, 0, VK_WHOLE_SIZE, 0, &place), "map");
  buffer.values = static_cast<float*>(place);
  return buffer;
}

void transition(VkCommandBuffer commands, VkImage image, std::uint32_t levels, VkImageLayout from,
                VkImageLayout to) {
  const VkImageMemoryBarrier barrier = {
      .sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER,
      .srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT,
      .dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT,
      .oldLayout = from,
      .newLayout = to,
      .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
      .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
      .image = image,
      .subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, levels, 0, 1}};
  vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT,
                       VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, 0, 0, nullptr, 0, nullptr, 1, &barrier);
}

VkImageView upload(const Device& device, const Texture& texture) {
  const VkImageCreateInfo of_image = {
      .sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
      .imageType = texture.depth > 0 ? VK_IMAGE_TYPE_3D : VK_IMAGE_TYPE_2D,
      .format = VK_FORMAT_R32G32B32A32_SFLOAT,
      .extent = {texture.width, texture.height, std::max(texture.depth, 1u)},
      .mipLevels = texture.levels,
      .arrayLayers = 1,
      .samples = VK_SAMPLE_COUNT_1_BIT,
      .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT};
  VkImage image = VK_NULL_HANDLE;
  check(vkCreateImage(device, &of_image, nullptr, &image), "image");
  VkMemoryRequirements needs;
  vkGetImageMemoryRequirements(device, image, &needs);
  vkBindImageMemory(device, image, device.memory(needs, 0), 0);
  const Buffer staging =
      make_buffer(device, texture.values.size(), VK_BUFFER_USAGE_TRANSFER_SRC_BIT);
  std::copy(texture.values.begin(), texture.values.end(), staging.values);
  device.run([&](VkCommandBuffer commands) {
    transition(commands, image, texture.levels, VK_IMAGE_LAYOUT_UNDEFINED,
               VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
    VkDeviceSize offset = 0;
    for (std::uint32_t level = 0; level < texture.levels; ++level) {
      const VkExtent3D extent = {texture.width >> level, texture.height >> level,
                                 std::max(texture.depth, 1u)};
      const VkBufferImageCopy copy = {.bufferOffset = offset,
                                      .imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, level, 0, 1},
                                      .imageExtent = extent};
      vkCmdCopyBufferToImage(commands, staging.handle, image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                             1, &copy);
      offset += VkDeviceSize{16} * extent.width * extent.height * extent.depth;
    }
    transition(commands, image, texture.levels, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
               VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
  });
  const VkImageViewCreateInfo of_view = {
      .sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
      .image = image,
      .viewType = texture.depth > 0 ? VK_IMAGE_VIEW_TYPE_3D : VK_IMAGE_VIEW_TYPE_2D,
      .format = VK_FORMAT_R32G32B32A32_SFLOAT,
      .subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, texture.levels, 0, 1}};
  VkImageView view = VK_NULL_HANDLE;
  check(vkCreateImageView(device, &of_view, nullptr, &view), "image view");
  return view;
}

VkSampler make_sampler(const Device& device) {
  const VkSamplerCreateInfo of_sampler = {.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO,
                                          .magFilter = VK_FILTER_LINEAR,
                                          .minFilter = VK_FILTER_LINEAR,
                                          .mipmapMode = VK_SAMPLER_MIPMAP_MODE_LINEAR,
                                          .addressModeU = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE,
                                          .addressModeV = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE,
                                          .addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE,
                                          .maxLod = VK_LOD_CLAMP_NONE};
  VkSampler sampler = VK_NULL_HANDLE;
  check(vkCreateSampler(device, &of_sampler, nullptr, &sampler), "sampler");
  return sampler;
}

// What each binding is: two buffers, the images (with samplers, in GLSL), a sampler (in HLSL).
std::vector<VkDescriptorType> bindings_of(const Job& job, VulkanSource source) {
  const bool glsl = source == VulkanSource::glsl;
  std::vector<VkDescriptorType> types(2, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER);
  types.resize(2 + job.textures.size(),
               glsl ? VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER : VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE);
  if (!glsl)
    types.push_back(VK_DESCRIPTOR_TYPE_SAMPLER);
  return types;
}

VkDescriptorSetLayout make_layout(const Device& device,
                                  const std::vector<VkDescriptorType>& types) {
  std::vector<VkDescriptorSetLayoutBinding> bindings;
  for (std::size_t i = 0; i < types.size(); ++i)
    bindings.push_back({.binding = static_cast<std::uint32_t>(i),
                        .descriptorType = types[i],
                        .descriptorCount = 1,
                        .stageFlags = VK_SHADER_STAGE_COMPUTE_BIT});
  const VkDescriptorSetLayoutCreateInfo of_layout = {
      .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
      .bindingCount = static_cast<std::uint32_t>(bindings.size()),
      .pBindings = bindings.data()};
  VkDescriptorSetLayout layout = VK_NULL_HANDLE;
  check(vkCreateDescriptorSetLayout(device, &of_layout, nullptr, &layout), "layout");
  return layout;
}

VkDescriptorSet make_set(const Device& device, VkDescriptorSetLayout layout,
                         const std::vector<VkDescriptorType>& types) {
  std::vector<VkDescriptorPoolSize> sizes;
  for (const VkDescriptorType type : types)
    sizes.push_back({type, 1});
  const VkDescriptorPoolCreateInfo of_pool = {
      .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
      .maxSets = 1,
      .poolSizeCount = static_cast<std::uint32_t>(sizes.size()),
      .pPoolSizes = sizes.data()};
  VkDescriptorPool pool = VK_NULL_HANDLE;
  check(vkCreateDescriptorPool(device, &of_pool, nullptr, &pool), "descriptor pool");
  const VkDescriptorSetAllocateInfo of_set = {
      .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
      .descriptorPool = pool,
      .descriptorSetCount = 1,
      .pSetLayouts = &layout};
  VkDescriptorSet set = VK_NULL_HANDLE;
  check(vkAllocateDescriptorSets(device, &of_set, &set), "descriptor set");
  return set;
}

void write_set(const Device& device, VkDescriptorSet set,
               const std::vector<VkDescriptorType>& types, const std::vector<Buffer>& buffers,
               const std::vector<VkImageView>& views, VkSampler sampler) {
  for (std::uint32_t i = 0; i < types.size(); ++i) {
    const VkDescriptorBufferInfo of_buffer = {
        .buffer = i < buffers.size() ? buffers[i].handle : VK_NULL_HANDLE, .range = VK_WHOLE_SIZE};
    const std::size_t image = i - buffers.size();
    const VkDescriptorImageInfo of_image = {
        .sampler = sampler,
        .imageView = i >= buffers.size() && image < views.size() ? views[image] : VK_NULL_HANDLE,
        .imageLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
    const VkWriteDescriptorSet write = {.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                                        .dstSet = set,
                                        .dstBinding = i,
                                        .descriptorCount = 1,
                                        .descriptorType = types[i],
                                        .pImageInfo = &of_image,
                                        .pBufferInfo = &of_buffer};
    vkUpdateDescriptorSets(device, 1, &write, 0, nullptr);
  }
}

VkPipelineLayout make_pipeline_layout(const Device& device, VkDescriptorSetLayout layout) {
  const VkPipelineLayoutCreateInfo of_layout = {
      .sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
      .setLayoutCount = 1,
      .pSetLayouts = &layout};
  VkPipelineLayout pipeline = VK_NULL_HANDLE;
  check(vkCreatePipelineLayout(device, &of_layout, nullptr, &pipeline), "pipeline layout");
  return pipeline;
}

VkPipeline make_pipeline(const Device& device, VkPipelineLayout layout,
                         const std::vector<std::uint32_t>& words) {
  const VkShaderModuleCreateInfo of_module = {.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO,
                                              .codeSize = 4 * words.size(),
                                              .pCode = words.data()};
  VkShaderModule module = VK_NULL_HANDLE;
  check(vkCreateShaderModule(device, &of_module, nullptr, &module), "module");
  const VkComputePipelineCreateInfo of_pipeline = {
      .sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO,
      .stage = {.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
                .stage = VK_SHADER_STAGE_COMPUTE_BIT,
                .module = module,
                .pName = "main"},
      .layout = layout};
  VkPipeline pipeline = VK_NULL_HANDLE;
  check(vkCreateComputePipelines(device, VK_NULL_HANDLE, 1, &of_pipeline, nullptr, &pipeline),
        "pipeline");
  return pipeline;
}

}  // namespace

Results run_vulkan(const Job& job, VulkanSource source) {
  const std::vector<std::uint32_t> words = compiled(job, source);
  const Device device;
  const std::size_t answers = job.count() * outputs * 4;
  const std::vector<Buffer> buffers = {
      make_buffer(device, job.input.size(), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT),
      make_buffer(device, answers, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT)};
  std::copy(job.input.begin(), job.input.end(), buffers[0].values);
  std::vector<VkImageView> views;
  for (const Texture& texture : job.textures)
    views.push_back(upload(device, texture));
  const std::vector<VkDescriptorType> types = bindings_of(job, source);
  const VkDescriptorSetLayout layout = make_layout(device, types);
  const VkDescriptorSet set = make_set(device, layout, types);
  write_set(device, set, types, buffers, views, make_sampler(device));
  const VkPipelineLayout pipeline_layout = make_pipeline_layout(device, layout);
  const VkPipeline pipeline = make_pipeline(device, pipeline_layout, words);
  device.run([&](VkCommandBuffer commands) {
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline);
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_layout, 0, 1, &set,
                            0, nullptr);
    vkCmdDispatch(commands, static_cast<std::uint32_t>((job.count() + 63) / 64), 1, 1);
  });
  return {buffers[1].values, buffers[1].values + answers};
}
#else
Results run_vulkan(const Job&, VulkanSource) {
  throw Missing("built without Vulkan: libvulkan-dev");
}
#endif

}  // namespace ltc::test::shaders
