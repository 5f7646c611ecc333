# What needs OpenGL, EGL and libepoxy. It is loaded where a GPU is asked for or looked for, so that
# all else runs on machines without them.
pkg_check_modules(EPOXY REQUIRED IMPORTED_TARGET epoxy)
include(embed_shaders.cmake)
embed_shaders(SHADER_SOURCES ${CMAKE_CURRENT_SOURCE_DIR}/../shaders)

add_library(gpu_shading_opengl STATIC
  backends/opengl/egl/context.cpp
  backends/opengl/egl/device.cpp
  backends/opengl/egl/display.cpp
  backends/opengl/gl/buffer.cpp
  backends/opengl/gl/check.cpp
  backends/opengl/gl/draw.cpp
  backends/opengl/gl/framebuffer.cpp
  backends/opengl/gl/limits.cpp
  backends/opengl/gl/program.cpp
  backends/opengl/gl/readback.cpp
  backends/opengl/gl/texture.cpp
  backends/opengl/gl/vertex_array.cpp
  backends/opengl/raster/crowd_masks.cpp
  backends/opengl/raster/crown_geometry.cpp
  backends/opengl/raster/draw_list.cpp
  backends/opengl/raster/geometry.cpp
  backends/opengl/raster/gl_backend.cpp
  backends/opengl/raster/gl_picture_raster.cpp
  backends/opengl/raster/reduction.cpp
  backends/opengl/raster/schedule_keys.cpp
  backends/opengl/raster/screen_geometry.cpp
  backends/opengl/raster/submissions.cpp
  backends/opengl/raster/target.cpp
  backends/opengl/raster/target_pool.cpp
  ${SHADER_SOURCES})
target_include_directories(gpu_shading_opengl
  PUBLIC ${CMAKE_CURRENT_SOURCE_DIR}
  PRIVATE ${CMAKE_CURRENT_BINARY_DIR})
target_link_libraries(gpu_shading_opengl
  PUBLIC gpu_shading
  PRIVATE project_options PkgConfig::EPOXY fmt::fmt ${CMAKE_DL_LIBS})
precompile(gpu_shading_opengl)
add_library(gpu_shading_gl MODULE backends/opengl/module/gl_entry.cpp)
target_include_directories(gpu_shading_gl PRIVATE ${CMAKE_CURRENT_BINARY_DIR})
target_link_libraries(gpu_shading_gl PRIVATE project_options gpu_shading_opengl)
set(exports ${CMAKE_CURRENT_SOURCE_DIR}/backends/opengl/module/exports.map)
target_link_options(gpu_shading_gl PRIVATE -Wl,--version-script=${exports} -Wl,--as-needed
                                           -Wl,--gc-sections ${no_undefined})
set_target_properties(gpu_shading_gl PROPERTIES LINK_DEPENDS ${exports})
