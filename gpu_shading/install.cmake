# The library as a CMake package: cmake --install BUILD --component library --prefix PREFIX.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(library_folder ${CMAKE_INSTALL_LIBDIR})
set(package_folder ${library_folder}/cmake/gpu_shading)

# A program finds libgpu_shading_gl.so by its RUNPATH, where it lies beside the static library.
target_link_options(gpu_shading INTERFACE
  "$<INSTALL_INTERFACE:LINKER:-rpath,$<INSTALL_PREFIX>/${library_folder}>")

install(TARGETS gpu_shading EXPORT gpu_shading
        ARCHIVE DESTINATION ${library_folder} COMPONENT library
        INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(TARGETS gpu_shading_gl LIBRARY DESTINATION ${library_folder} COMPONENT library)
install(DIRECTORY include/gpu_shading DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT library)
install(EXPORT gpu_shading NAMESPACE gpu_shading:: FILE gpu_shading-targets.cmake
        DESTINATION ${package_folder} COMPONENT library)

configure_package_config_file(gpu_shading-config.cmake.in gpu_shading-config.cmake
                              INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(gpu_shading-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/gpu_shading-config.cmake
              ${CMAKE_CURRENT_BINARY_DIR}/gpu_shading-config-version.cmake
        DESTINATION ${package_folder} COMPONENT library)
