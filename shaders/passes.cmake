# Compiles every pass to SPIR-V and embeds it as C++ headers, which ${spirv_dir}/passes.h includes. What a pass says of how
# it is built makes its variants: "TEXEL_READS" one that reads through texel-buffer views (suffix _texel), which some
# devices do several times faster, and with "PACKED_STORES" one that moreover stores 64 bits at a time (_packed); "and
# ENERGY_BOOK" all of these once more with the energy book (_energy), which costs nothing without.
set(spirv_dir ${CMAKE_BINARY_DIR}/spirv)
file(MAKE_DIRECTORY ${spirv_dir})
file(GLOB shader_headers CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/shaders/shared/*.h ${CMAKE_SOURCE_DIR}/shaders/law/*.glsl
                                           ${CMAKE_SOURCE_DIR}/shaders/shared/*.glsl ${CMAKE_SOURCE_DIR}/shaders/pass/*.glsl)
set(spirv_outputs)

function(vkdose_compile source name)
  add_custom_command(
    OUTPUT ${spirv_dir}/${name}.spv.h ${spirv_dir}/${name}.spv
    COMMAND ${GLSLANG} --quiet -V --target-env vulkan1.1 -I${CMAKE_SOURCE_DIR}/shaders ${ARGN} -o ${spirv_dir}/${name}.spv
            ${source}
    COMMAND ${GLSLANG} --quiet -V --target-env vulkan1.1 -I${CMAKE_SOURCE_DIR}/shaders ${ARGN} --vn ${name}_spv -o
            ${spirv_dir}/${name}.spv.h ${source}
    DEPENDS ${source} ${shader_headers}
    COMMENT "SPIR-V ${name}"
    VERBATIM)
  list(APPEND spirv_outputs ${spirv_dir}/${name}.spv.h)
  set(spirv_outputs ${spirv_outputs} PARENT_SCOPE)
endfunction()

file(GLOB passes CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/shaders/pass/*.comp ${CMAKE_SOURCE_DIR}/shaders/render/*.comp)
foreach(pass ${passes})
  get_filename_component(stem ${pass} NAME_WE)
  file(STRINGS ${pass} texel REGEX "TEXEL_READS")
  file(STRINGS ${pass} packed REGEX "PACKED_STORES")
  file(STRINGS ${pass} energy REGEX "and ENERGY_BOOK")
  vkdose_compile(${pass} ${stem})
  if(texel)
    vkdose_compile(${pass} ${stem}_texel -DTEXEL_READS)
  endif()
  if(packed)
    vkdose_compile(${pass} ${stem}_packed -DTEXEL_READS -DPACKED_STORES)
  endif()
  if(energy)
    vkdose_compile(${pass} ${stem}_energy -DENERGY_BOOK)
    vkdose_compile(${pass} ${stem}_texel_energy -DTEXEL_READS -DENERGY_BOOK)
  endif()
  if(packed AND energy)
    vkdose_compile(${pass} ${stem}_packed_energy -DTEXEL_READS -DPACKED_STORES -DENERGY_BOOK)
  endif()
endforeach()

set(includes "")
foreach(header ${spirv_outputs})
  get_filename_component(name ${header} NAME)
  string(APPEND includes "#include \"spirv/${name}\"\n")
endforeach()
file(CONFIGURE OUTPUT ${spirv_dir}/passes.h CONTENT "#pragma once\n${includes}")

add_custom_target(vkdose_spirv_build DEPENDS ${spirv_outputs})
add_library(vkdose_spirv INTERFACE)
add_dependencies(vkdose_spirv vkdose_spirv_build)
target_include_directories(vkdose_spirv INTERFACE ${CMAKE_BINARY_DIR})
