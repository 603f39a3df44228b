# What `cmake --install` puts where, and the Debian packages that tools/package makes of it.

include(GNUInstallDirs)

# All libraries are the system's, so the program needs no path to them.
set_target_properties(vkdose PROPERTIES SKIP_BUILD_RPATH ON)
install(TARGETS vkdose COMPONENT vkdose)
install(DIRECTORY cases/ DESTINATION ${CMAKE_INSTALL_DATADIR}/vkdose/cases COMPONENT vkdose
        FILES_MATCHING PATTERN "*.toml" PATTERN "*.csv" PATTERN "*.stl" PATTERN pictures EXCLUDE)
install(FILES tools/debian/copyright DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/vkdose COMPONENT vkdose)

# The program prints its own man pages and completions. Debian wants packed pages, without the time of packing in them.
install(CODE [[
  set(program "$<TARGET_FILE:vkdose>")
  set(share "$ENV{DESTDIR}${CMAKE_INSTALL_PREFIX}/share")
  set(man "${share}/man/man1")
  file(MAKE_DIRECTORY "${man}" "${share}/bash-completion/completions" "${share}/zsh/vendor-completions"
       "${share}/fish/vendor_completions.d")
  execute_process(COMMAND "${program}" man --out "${man}" OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
  file(GLOB pages "${man}/vkdose*.1")
  execute_process(COMMAND gzip -9nf ${pages} COMMAND_ERROR_IS_FATAL ANY)
  foreach(place IN ITEMS bash=bash-completion/completions/vkdose zsh=zsh/vendor-completions/_vkdose
                         fish=fish/vendor_completions.d/vkdose.fish)
    string(REGEX MATCH "^(.*)=(.*)$" place "${place}")
    execute_process(COMMAND "${program}" completion ${CMAKE_MATCH_1} OUTPUT_FILE "${share}/${CMAKE_MATCH_2}"
                    COMMAND_ERROR_IS_FATAL ANY)
  endforeach()
]] COMPONENT vkdose)

# A package's history, packed; each package has its own.
function(vkdose_changelog package)
  set(packed ${CMAKE_BINARY_DIR}/${package}.changelog.gz)
  configure_file(tools/debian/changelog.in ${CMAKE_BINARY_DIR}/${package}.changelog @ONLY)
  execute_process(COMMAND gzip -9nc ${CMAKE_BINARY_DIR}/${package}.changelog OUTPUT_FILE ${packed}
                  COMMAND_ERROR_IS_FATAL ANY)
  install(FILES ${packed} DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package} RENAME changelog.gz COMPONENT ${package})
endfunction()
vkdose_changelog(vkdose)
vkdose_changelog(python3-vkdose)

set(debian_python lib/python3/dist-packages)
install(DIRECTORY host/python/vkdose DESTINATION ${debian_python} COMPONENT python3-vkdose
        FILES_MATCHING PATTERN "*.py" PATTERN "*.pyi" PATTERN "py.typed" PATTERN "__pycache__" EXCLUDE)
if(TARGET vkdose_python)
  set_target_properties(vkdose_python PROPERTIES SKIP_BUILD_RPATH ON)
  # Somebody may have built the program alone.
  install(TARGETS vkdose_python DESTINATION ${debian_python}/vkdose COMPONENT python3-vkdose OPTIONAL)
endif()
install(FILES tools/debian/copyright DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/python3-vkdose COMPONENT python3-vkdose)

set(CPACK_GENERATOR DEB)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL vkdose python3-vkdose)
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
set(CPACK_DEBIAN_PYTHON3-VKDOSE_PACKAGE_RECOMMENDS "python3-pandas, python3-h5py")
set(CPACK_DEBIAN_PYTHON3-VKDOSE_DESCRIPTION
    "Python package that drives vkdose
Cases from dicts, doses while a run goes on, errors as exceptions, and the
tables and frames of a run as pandas frames and arrays.")
include(CPack)
