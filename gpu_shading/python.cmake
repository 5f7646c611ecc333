# What the Python package calls. It needs nothing of Python: one library serves all versions.
file(GLOB calls CONFIGURE_DEPENDS python/*.cpp)
add_library(gpu_shading_python MODULE ${calls})
target_include_directories(gpu_shading_python PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
target_compile_definitions(gpu_shading_python PRIVATE GPU_SHADING_VERSION="${PROJECT_VERSION}")
target_link_libraries(gpu_shading_python PRIVATE project_options gpu_shading)
precompile(gpu_shading_python)
set(exports ${CMAKE_CURRENT_SOURCE_DIR}/python/exports.map)
target_link_options(gpu_shading_python PRIVATE -Wl,--version-script=${exports} -Wl,--as-needed
                                               -Wl,--gc-sections ${no_undefined})
# Each source's names in anonymous namespaces are its own.
set_target_properties(gpu_shading_python PROPERTIES LINK_DEPENDS ${exports} UNITY_BUILD OFF)
