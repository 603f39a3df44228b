# Compiles every pass to SPIR-V in the variants that are declared here. ${spirv_dir}/passes.h then holds the code of
# each variant (near_texel_spv), and for each pass the list of its variants (vkdose::spirv::near). The host takes the
# variant that suits the device and the world (host/vk/variant.h).

# The words that variants are named by, and the macros that each defines.
set(macros_texel TEXEL_READS)                 # reads through texel-buffer views
set(macros_packed TEXEL_READS PACKED_STORES)  # and stores 64 bits at a time
set(macros_energy ENERGY_BOOK)                # keeps the energy book
set(macros_bodies WITH_BODIES)                # looks for bodies

# Every pass, and its variants beside the plain one.
set(passes
    "pass/clear"
    "pass/bin texel"
    "pass/neighbours texel"
    "pass/near texel energy texel_energy bodies texel_bodies energy_bodies texel_energy_bodies"
    "pass/parts texel"
    "pass/link texel energy texel_energy"
    "pass/commit_lists"
    "pass/pairs texel packed energy texel_energy packed_energy"
    "pass/surfaces texel packed energy texel_energy packed_energy"
    "pass/bodies texel packed energy texel_energy packed_energy"
    "pass/free_bodies"
    "pass/move texel packed energy texel_energy packed_energy"
    "pass/decide bodies"
    "pass/sense"
    "pass/sense_energy"
    "pass/field_branches energy bodies energy_bodies"
    "pass/field_weights"
    "pass/field_sums"
    "pass/field_kinetic"
    "pass/store_trial packed"
    "render/cast texel")

set(spirv_dir ${CMAKE_BINARY_DIR}/spirv)
file(MAKE_DIRECTORY ${spirv_dir})
set(shader_dir ${CMAKE_SOURCE_DIR}/shaders)
file(GLOB shader_headers CONFIGURE_DEPENDS ${shader_dir}/shared/*.h ${shader_dir}/shared/*.glsl ${shader_dir}/law/*.glsl
                                           ${shader_dir}/pass/*.glsl)

# What glslang leaves to a driver is done here once: functions are written out and variables become values, in the order
# of `spirv-opt -O`. Passes that move or merge arithmetic are left out, because values that live longer cost a software
# device more than they save it (tools/results/README.md).
set(spirv_made_small
    --wrap-opkill --eliminate-dead-branches --merge-return --inline-entry-points-exhaustive --eliminate-dead-functions
    --eliminate-dead-code-aggressive --private-to-local --eliminate-local-single-block --eliminate-local-single-store
    --eliminate-dead-code-aggressive --scalar-replacement=100 --convert-local-access-chains
    --eliminate-local-single-block --eliminate-local-single-store --eliminate-dead-code-aggressive --ssa-rewrite
    --eliminate-dead-code-aggressive --merge-blocks)

function(vkdose_compile source name)
  list(TRANSFORM ARGN PREPEND -D)
  set(spirv ${spirv_dir}/${name}.spv)
  add_custom_command(
    OUTPUT ${spirv}.h ${spirv}
    COMMAND ${GLSLANG} --quiet -V --target-env vulkan1.1 -I${shader_dir} ${ARGN} -o ${spirv}.large ${source}
    COMMAND ${SPIRV_OPT} ${spirv_made_small} ${spirv}.large -o ${spirv}
    COMMAND ${CMAKE_COMMAND} -DSPIRV=${spirv} -DHEADER=${spirv}.h -DNAME=${name}_spv -P ${shader_dir}/words.cmake
    DEPENDS ${source} ${shader_headers} ${shader_dir}/words.cmake
    COMMENT "SPIR-V ${name}"
    VERBATIM)
endfunction()

set(spirv_outputs)
set(spirv_includes "")
set(spirv_lists "")
set(spirv_macros)
file(GLOB undeclared CONFIGURE_DEPENDS ${shader_dir}/pass/*.comp ${shader_dir}/render/*.comp)
foreach(declared ${passes})
  separate_arguments(variants UNIX_COMMAND "${declared}")
  list(POP_FRONT variants file)
  get_filename_component(stem ${file} NAME)
  set(source ${shader_dir}/${file}.comp)
  list(REMOVE_ITEM undeclared ${source})
  string(APPEND spirv_lists "constexpr vk::Variant ${stem}[] = {")
  foreach(variant plain ${variants})
    set(name ${stem})
    set(macros)
    if(NOT variant STREQUAL plain)
      set(name ${stem}_${variant})
      string(REPLACE "_" ";" words ${variant})
      foreach(word ${words})
        if(NOT macros_${word})
          message(FATAL_ERROR "shaders/passes.cmake: ${file} has the variant \"${variant}\"; set macros_${word}")
        endif()
        list(APPEND macros ${macros_${word}})
      endforeach()
    endif()
    vkdose_compile(${source} ${name} ${macros})
    list(APPEND spirv_outputs ${spirv_dir}/${name}.spv.h)
    list(APPEND spirv_macros ${macros})
    list(JOIN macros " | " bits)
    if(NOT macros)
      set(bits 0)
    endif()
    string(APPEND spirv_includes "#include \"spirv/${name}.spv.h\"\n")
    string(APPEND spirv_lists "{${bits}, ${name}_spv}, ")
  endforeach()
  string(APPEND spirv_lists "};\n")
endforeach()
if(undeclared)
  message(FATAL_ERROR "shaders/passes.cmake declares no variants of ${undeclared}")
endif()

list(REMOVE_DUPLICATES spirv_macros)
set(spirv_bits "")
set(spirv_names "")
set(bit 0)
foreach(macro ${spirv_macros})
  string(APPEND spirv_bits "constexpr unsigned ${macro} = 1u << ${bit};\n")
  string(APPEND spirv_names "{${macro}, \"${macro}\"}, ")
  math(EXPR bit "${bit} + 1")
endforeach()
file(CONFIGURE OUTPUT ${spirv_dir}/passes.h CONTENT
"// Made by shaders/passes.cmake.
#pragma once
#include <utility>

#include \"host/vk/variant.h\"
${spirv_includes}
namespace vkdose::spirv {
${spirv_bits}constexpr std::pair<unsigned, const char*> kMacros[] = {${spirv_names}};
${spirv_lists}}
")

# The sources themselves, from which the program compiles the passes of a user's law (shaders/law/user.glsl).
set(spirv_sources "")
file(GLOB shader_sources CONFIGURE_DEPENDS ${shader_dir}/pass/*.comp ${shader_dir}/law/*.comp)
foreach(file ${shader_headers} ${shader_sources})
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
  file(READ ${file} text)
  file(RELATIVE_PATH stem ${shader_dir} ${file})
  string(APPEND spirv_sources "{\"${stem}\", R\"_glsl_(${text})_glsl_\"},\n")
endforeach()
file(CONFIGURE OUTPUT ${spirv_dir}/sources.h CONTENT
"// Made by shaders/passes.cmake.
#pragma once
#include <utility>

namespace vkdose::spirv {
inline constexpr std::pair<const char*, const char*> kSources[] = {
\${spirv_sources}};
}
")

add_custom_target(vkdose_spirv_build DEPENDS ${spirv_outputs})
add_library(vkdose_spirv INTERFACE)
add_dependencies(vkdose_spirv vkdose_spirv_build)
target_include_directories(vkdose_spirv INTERFACE ${CMAKE_BINARY_DIR})
