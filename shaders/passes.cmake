# Compiles every pass to SPIR-V and embeds it as a C++ header. A pass that names TEXEL_READS is built twice: from storage
# buffers, and (suffix _texel) through texel-buffer views, which some devices read several times faster. One that
# says "and ENERGY_BOOK" is built without the energy book, which then costs nothing, and (suffix _energy) with it.
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

file(GLOB passes CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/shaders/pass/*.comp)
foreach(pass ${passes})
  get_filename_component(stem ${pass} NAME_WE)
  file(STRINGS ${pass} texel REGEX "TEXEL_READS")
  file(STRINGS ${pass} energy REGEX "and ENERGY_BOOK")
  vkdose_compile(${pass} ${stem})
  if(texel)
    vkdose_compile(${pass} ${stem}_texel -DTEXEL_READS)
  endif()
  if(energy)
    vkdose_compile(${pass} ${stem}_energy -DENERGY_BOOK)
  endif()
  if(texel AND energy)
    vkdose_compile(${pass} ${stem}_texel_energy -DTEXEL_READS -DENERGY_BOOK)
  endif()
endforeach()

add_custom_target(vkdose_spirv_build DEPENDS ${spirv_outputs})
add_library(vkdose_spirv INTERFACE)
add_dependencies(vkdose_spirv vkdose_spirv_build)
target_include_directories(vkdose_spirv INTERFACE ${spirv_dir})
