# What `cmake --install` puts where, and the Debian packages that tools/package makes of it.

include(GNUInstallDirs)

# All libraries are the system's, so the program needs no path to them.
set_target_properties(vkdose PROPERTIES SKIP_BUILD_RPATH ON)
install(TARGETS vkdose COMPONENT vkdose)
install(DIRECTORY cases/ DESTINATION ${CMAKE_INSTALL_DATADIR}/vkdose/cases COMPONENT vkdose
        FILES_MATCHING PATTERN "*.toml" PATTERN "*.csv" PATTERN "*.stl" PATTERN "*.ply" PATTERN "*.py" PATTERN "*.ipynb"
        PATTERN "*.glsl" PATTERN Snakefile PATTERN pictures EXCLUDE PATTERN cpp EXCLUDE PATTERN __pycache__ EXCLUDE)

# The program prints its own man pages and completions. Debian wants packed pages, without the time of packing in them.
install(CODE [[
  set(program "$<TARGET_FILE:vkdose>")
  set(share "$ENV{DESTDIR}${CMAKE_INSTALL_PREFIX}/share")
  set(man "${share}/man/man1")
  file(MAKE_DIRECTORY "${man}" "${share}/bash-completion/completions" "${share}/zsh/vendor-completions"
       "${share}/fish/vendor_completions.d")
  execute_process(COMMAND "${program}" manual man --out "${man}" OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
  file(GLOB pages "${man}/vkdose*.1")
  execute_process(COMMAND gzip -9nf ${pages} COMMAND_ERROR_IS_FATAL ANY)
  foreach(place IN ITEMS bash=bash-completion/completions/vkdose zsh=zsh/vendor-completions/_vkdose
                         fish=fish/vendor_completions.d/vkdose.fish)
    string(REGEX MATCH "^(.*)=(.*)$" place "${place}")
    execute_process(COMMAND "${program}" manual completion ${CMAKE_MATCH_1} OUTPUT_FILE "${share}/${CMAKE_MATCH_2}"
                    COMMAND_ERROR_IS_FATAL ANY)
  endforeach()
]] COMPONENT vkdose)

# The library for programs in C++: an archive of the rooms that host/play takes, with their shaders.
add_library(vkdose_library STATIC)
foreach(room core geometry law glsl model sim analysis output reference vk vulkan play volk)
  target_sources(vkdose_library PRIVATE $<TARGET_OBJECTS:vkdose_${room}>)
endforeach()
target_include_directories(vkdose_library INTERFACE $<INSTALL_INTERFACE:include/vkdose>)
target_compile_features(vkdose_library INTERFACE cxx_std_20)
target_link_libraries(vkdose_library PUBLIC glm::glm fmt::fmt
                                     PRIVATE tomlplusplus::tomlplusplus hdf5::hdf5 ZLIB::ZLIB csv ${CMAKE_DL_LIBS}
                                             glslang::glslang glslang::SPIRV
                                             glslang::glslang-default-resource-limits)
if(VKDOSE_SANITIZE)
  target_link_options(vkdose_library INTERFACE -fsanitize=${VKDOSE_SANITIZE})
endif()
set_target_properties(vkdose_library PROPERTIES OUTPUT_NAME vkdose EXPORT_NAME vkdose LINKER_LANGUAGE CXX)
add_dependencies(vkdose vkdose_library)  # so that whoever has built the program can install all
install(TARGETS vkdose_library EXPORT vkdose ARCHIVE DESTINATION lib COMPONENT libvkdose-dev)
install(EXPORT vkdose NAMESPACE vkdose:: FILE vkdose-targets.cmake DESTINATION lib/cmake/vkdose COMPONENT libvkdose-dev)
include(CMakePackageConfigHelpers)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/vkdose-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES tools/vkdose-config.cmake ${CMAKE_BINARY_DIR}/vkdose-config-version.cmake DESTINATION lib/cmake/vkdose
        COMPONENT libvkdose-dev)
install(SCRIPT tools/install-headers.cmake COMPONENT libvkdose-dev)
install(DIRECTORY cases/cpp/ DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/libvkdose-dev/examples COMPONENT libvkdose-dev)

# What Debian wants of each package: its licence, and its history, packed.
foreach(package vkdose libvkdose-dev python3-vkdose)
  set(changelog ${CMAKE_BINARY_DIR}/${package}.changelog)
  configure_file(tools/debian/changelog.in ${changelog} @ONLY)
  execute_process(COMMAND gzip -9nc ${changelog} OUTPUT_FILE ${changelog}.gz COMMAND_ERROR_IS_FATAL ANY)
  set(folder ${CMAKE_INSTALL_DATADIR}/doc/${package})
  install(FILES ${changelog}.gz DESTINATION ${folder} RENAME changelog.gz COMPONENT ${package})
  install(FILES tools/debian/copyright DESTINATION ${folder} COMPONENT ${package})
endforeach()

set(debian_python lib/python3/dist-packages)
install(DIRECTORY host/python/vkdose DESTINATION ${debian_python} COMPONENT python3-vkdose
        FILES_MATCHING PATTERN "*.py" PATTERN "*.pyi" PATTERN "py.typed" PATTERN "__pycache__" EXCLUDE)
if(TARGET vkdose_python)
  set_target_properties(vkdose_python PROPERTIES SKIP_BUILD_RPATH ON)
  # Somebody may have built the program alone.
  install(TARGETS vkdose_python DESTINATION ${debian_python}/vkdose COMPONENT python3-vkdose OPTIONAL)
  install(TARGETS vkdose_python DESTINATION . COMPONENT module EXCLUDE_FROM_ALL OPTIONAL)  # for host/python/setup.py
endif()

set(CPACK_GENERATOR DEB)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL vkdose libvkdose-dev python3-vkdose)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_PACKAGE_CONTACT "the vkdose authors <vkdose@users.invalid>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ
                                                WORLD_EXECUTE)
set(CPACK_DEBIAN_VKDOSE_PACKAGE_NAME vkdose)
set(CPACK_DEBIAN_VKDOSE_PACKAGE_SECTION science)
set(CPACK_DEBIAN_VKDOSE_PACKAGE_SHLIBDEPS ON)
# The loader is opened at run time, so no library's dependency names it.
set(CPACK_DEBIAN_VKDOSE_PACKAGE_DEPENDS "libvulkan1, fonts-dejavu-core")
set(CPACK_DEBIAN_VKDOSE_PACKAGE_RECOMMENDS mesa-vulkan-drivers)
set(CPACK_DEBIAN_VKDOSE_PACKAGE_SUGGESTS "ffmpeg, python3-vkdose")
set(CPACK_DEBIAN_VKDOSE_DESCRIPTION
    "simulates the dosing of cohesive powder by a turning coil
Spheres in contact, computed on any Vulkan device (discrete element method):
a canister, a coil or a body from a mesh, and a schedule of doses. It prints
masses per dose and torques, and writes reports, pictures and fields. Studies
vary a case or calibrate its parameters.")
set(CPACK_DEBIAN_LIBVKDOSE-DEV_PACKAGE_NAME libvkdose-dev)
set(CPACK_DEBIAN_LIBVKDOSE-DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_LIBVKDOSE-DEV_PACKAGE_DEPENDS
    "glslang-dev, libcsv-dev, libfmt-dev, libglm-dev, libhdf5-dev, libtomlplusplus-dev, zlib1g-dev")
set(CPACK_DEBIAN_LIBVKDOSE-DEV_PACKAGE_RECOMMENDS "libvulkan1, vkdose (>= ${PROJECT_VERSION})")
set(CPACK_DEBIAN_LIBVKDOSE-DEV_DESCRIPTION
    "library that runs vkdose inside a program in C++
A static library with its headers and the CMake package vkdose: a case is
loaded, goes on when it is told to, takes orders to its drive, and can be
looked at in between. An example lies beside the licence.")
set(CPACK_DEBIAN_PYTHON3-VKDOSE_PACKAGE_NAME python3-vkdose)
set(CPACK_DEBIAN_PYTHON3-VKDOSE_PACKAGE_SECTION python)
set(python3_vkdose_takes "python3-tomli-w, vkdose (>= ${PROJECT_VERSION})")
if(TARGET vkdose_python)  # a module for one Python
  math(EXPR next_minor "${Python_VERSION_MINOR} + 1")
  set(CPACK_DEBIAN_PYTHON3-VKDOSE_PACKAGE_SHLIBDEPS ON)
  set(CPACK_DEBIAN_PYTHON3-VKDOSE_PACKAGE_DEPENDS
      "python3 (>= 3.${Python_VERSION_MINOR}), python3 (<< 3.${next_minor}), ${python3_vkdose_takes}")
else()
  set(CPACK_DEBIAN_PYTHON3-VKDOSE_PACKAGE_ARCHITECTURE all)
  set(CPACK_DEBIAN_PYTHON3-VKDOSE_PACKAGE_DEPENDS "python3 (>= 3.9), ${python3_vkdose_takes}")
endif()
string(JOIN ", " CPACK_DEBIAN_PYTHON3-VKDOSE_PACKAGE_RECOMMENDS python3-pandas python3-h5py python3-matplotlib
       python3-scipy python3-sklearn python3-xarray python3-ipykernel python3-nbclient)
set(CPACK_DEBIAN_PYTHON3-VKDOSE_PACKAGE_SUGGESTS snakemake)
set(CPACK_DEBIAN_PYTHON3-VKDOSE_DESCRIPTION
    "Python package that drives vkdose
Cases from dicts, doses while a run goes on, runs inside Python that take
orders, errors as exceptions, and the tables and frames of a run as pandas
frames and arrays.")
include(CPack)
