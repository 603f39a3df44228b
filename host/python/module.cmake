# vkdose._core, the module for runs inside Python. What it takes may be absent (tools/packages-python).

set(Python_EXECUTABLE /usr/bin/python3 CACHE FILEPATH "The Python that vkdose._core is for")
find_package(Python COMPONENTS Interpreter Development.Module QUIET)
find_package(pybind11 CONFIG QUIET)
if(VKDOSE_SANITIZE)
  message(STATUS "vkdose._core: not built, because a Python without sanitizers cannot load it")
  return()
elseif(NOT Python_Development.Module_FOUND OR NOT pybind11_FOUND)
  message(STATUS "vkdose._core: not built, because pybind11-dev or python3-dev is missing (tools/packages-python)")
  return()
endif()
message(STATUS "vkdose._core: built for Python ${Python_VERSION}")

# The module holds the rooms that a run takes, so they must not depend on the place where they are loaded. Names that
# nobody outside sees keep that from costing speed.
foreach(room core geometry law glsl model sim reference vk vulkan analysis output play volk)
  set_target_properties(vkdose_${room} PROPERTIES POSITION_INDEPENDENT_CODE ON C_VISIBILITY_PRESET hidden
                                                  CXX_VISIBILITY_PRESET hidden
                                                  VISIBILITY_INLINES_HIDDEN ON)
endforeach()

pybind11_add_module(vkdose_python MODULE NO_EXTRAS host/python/core.cpp host/python/arrays.cpp)
target_link_libraries(vkdose_python PRIVATE vkdose_play)
set_target_properties(vkdose_python PROPERTIES OUTPUT_NAME _core
                                               LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/python/vkdose)
