# Found by find_package(vkdose), which gives the target vkdose::vkdose.
include(CMakeFindDependencyMacro)
find_dependency(fmt)
find_dependency(glm)
find_dependency(Threads)  # which glslang needs
find_dependency(glslang)
enable_language(C)  # CMake looks for HDF5 with its compiler
find_dependency(HDF5 COMPONENTS C)
find_dependency(tomlplusplus)
find_dependency(ZLIB)
include("${CMAKE_CURRENT_LIST_DIR}/vkdose-targets.cmake")
