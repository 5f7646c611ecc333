# What is built for Windows, by scripts/dev/build_windows, and its archive.
add_subdirectory(energyplus_patch)
if(GPU_SHADING_TESTS)
  enable_testing()
  add_subdirectory(tests)
endif()

install(TARGETS opengl32 windows_launcher gpu_shading_program RUNTIME DESTINATION . COMPONENT windows)
install(FILES scripts/packaging/windows/patch_energyplus.cmd DESTINATION . COMPONENT windows)
install(FILES energyplus_patch/docs/guides/windows.md DESTINATION . RENAME README.md COMPONENT windows)
# Of the libraries that are compiled in.
install(FILES LICENSE DESTINATION licences RENAME gpu_shading COMPONENT windows)
foreach(package libboost-dev libcli11-dev libeigen3-dev libfmt-dev libgeographiclib-dev libglm-dev libjs-three libtbb-dev
                libxxhash-dev nlohmann-json3-dev
                mingw-w64-x86-64-dev)
  string(REGEX REPLACE "^lib|-x86-64-dev$|-dev$" "" name ${package})
  file(GLOB copyright /usr/share/doc/${package}/copyright)
  if(copyright)
    file(REAL_PATH ${copyright} copyright)
    install(FILES ${copyright} DESTINATION licences RENAME ${name} COMPONENT windows)
  else()
    message(STATUS "windows: the licence of ${package} is not here and not in the archive")
  endif()
endforeach()

set(CPACK_PACKAGE_NAME gpu_shading)
set(CPACK_PACKAGE_FILE_NAME gpu_shading-windows-${PROJECT_VERSION})
set(CPACK_ARCHIVE_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL windows)
set(CPACK_COMPONENTS_GROUPING ALL_COMPONENTS_IN_ONE)
set(CPACK_STRIP_FILES ON)
include(CPack)
