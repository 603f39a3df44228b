#include "host/glsl/compile.h"

#include <glslang/Include/glslang_c_interface.h>
#include <glslang/Public/resource_limits_c.h>

#include <memory>
#include <mutex>
#include <regex>
#include <sstream>

#include "host/core/number.h"

namespace vkdose {
namespace {

/// "ERROR: 1:5: 'x' : undeclared identifier", for every such line.
std::vector<GlslFault> faultsOf(const std::string& log) {
    static const std::regex kError(R"(ERROR: (\d+):(\d+): (.*))");
    const auto place = [](const std::string& digits) { return int(wholeNumberOf(digits).value_or(0)); };
    std::vector<GlslFault> faults;
    std::istringstream lines(log);
    for (std::string line; std::getline(lines, line);) {
        std::smatch part;
        if (std::regex_match(line, part, kError)) faults.push_back({place(part[1]), place(part[2]), part[3]});
    }
    if (faults.empty()) faults.push_back({0, 0, log});
    return faults;
}

}  // namespace

GlslResult compileGlsl(const std::string& source) {
    static std::once_flag once;
    std::call_once(once, [] { glslang_initialize_process(); });

    glslang_input_t input{};
    input.language = GLSLANG_SOURCE_GLSL;
    input.stage = GLSLANG_STAGE_COMPUTE;
    input.client = GLSLANG_CLIENT_VULKAN;
    input.client_version = GLSLANG_TARGET_VULKAN_1_1;
    input.target_language = GLSLANG_TARGET_SPV;
    input.target_language_version = GLSLANG_TARGET_SPV_1_3;
    input.code = source.c_str();
    input.default_version = 450;
    input.default_profile = GLSLANG_NO_PROFILE;
    const int messages = GLSLANG_MSG_SPV_RULES_BIT | GLSLANG_MSG_VULKAN_RULES_BIT;
    input.messages = static_cast<glslang_messages_t>(messages);
    input.resource = glslang_default_resource();

    const std::unique_ptr<glslang_shader_t, void (*)(glslang_shader_t*)> shader(glslang_shader_create(&input),
                                                                                glslang_shader_delete);
    const bool parsed =
        glslang_shader_preprocess(shader.get(), &input) != 0 && glslang_shader_parse(shader.get(), &input) != 0;
    if (!parsed) return {{}, faultsOf(glslang_shader_get_info_log(shader.get()))};
    const std::unique_ptr<glslang_program_t, void (*)(glslang_program_t*)> program(glslang_program_create(),
                                                                                   glslang_program_delete);
    glslang_program_add_shader(program.get(), shader.get());
    if (glslang_program_link(program.get(), messages) == 0)
        return {{}, faultsOf(glslang_program_get_info_log(program.get()))};
    glslang_program_SPIRV_generate(program.get(), GLSLANG_STAGE_COMPUTE);
    const std::uint32_t* words = glslang_program_SPIRV_get_ptr(program.get());
    return {{words, words + glslang_program_SPIRV_get_size(program.get())}, {}};
}

}  // namespace vkdose
