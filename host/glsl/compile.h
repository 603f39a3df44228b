#pragma once
// GLSL to SPIR-V at run time, by the glslang library. Knows neither laws nor passes.

#include <cstdint>
#include <string>
#include <vector>

namespace vkdose {

struct GlslFault {
    int source = 0;  ///< number that a #line directive gave
    int line = 0;
    std::string text;
};

struct GlslResult {
    std::vector<std::uint32_t> spirv;  ///< empty if there are faults
    std::vector<GlslFault> faults;
};

/// Compiles a compute shader, its #version first, for Vulkan 1.1 as shaders/passes.cmake does. It needs no lock.
GlslResult compileGlsl(const std::string& source);

}  // namespace vkdose
