# Found by find_package(vkdose), which gives the target vkdose::vkdose.
include(CMakeFindDependencyMacro)
find_dependency(fmt)
find_dependency(glm)
find_dependency(tomlplusplus)
include("${CMAKE_CURRENT_LIST_DIR}/vkdose-targets.cmake")
