# What needs OpenGL, EGL and libepoxy. It is loaded where a GPU is asked for or looked for, so that
# all else runs on machines without them.
pkg_check_modules(EPOXY REQUIRED IMPORTED_TARGET epoxy)
include(embed_shaders.cmake)
embed_shaders(SHADER_SOURCES ${CMAKE_CURRENT_SOURCE_DIR}/../shaders)

add_library(gpu_shading_opengl STATIC
  gl/buffer.cpp
  gl/check.cpp
  gl/draw.cpp
  gl/fence.cpp
  gl/framebuffer.cpp
  gl/limits.cpp
  gl/program.cpp
  gl/readback.cpp
  gl/texture.cpp
  gl/vertex_array.cpp
  egl/context.cpp
  egl/device.cpp
  egl/display.cpp
  egl/error.cpp
  raster_gl/draw_list.cpp
  raster_gl/geometry.cpp
  raster_gl/gl_backend.cpp
  raster_gl/gl_picture_raster.cpp
  raster_gl/reduction.cpp
  raster_gl/schedule_keys.cpp
  raster_gl/screen_geometry.cpp
  raster_gl/sheet_block.cpp
  raster_gl/submissions.cpp
  raster_gl/target.cpp
  raster_gl/target_pool.cpp
  raster_gl/view_records.cpp
  ${SHADER_SOURCES})
target_include_directories(gpu_shading_opengl
  PUBLIC ${CMAKE_CURRENT_SOURCE_DIR}
  PRIVATE ${CMAKE_CURRENT_BINARY_DIR})
target_link_libraries(gpu_shading_opengl
  PUBLIC gpu_shading
  PRIVATE project_options PkgConfig::EPOXY fmt::fmt ${CMAKE_DL_LIBS})
precompile(gpu_shading_opengl)
add_library(gpu_shading_gl MODULE gl_entry/gl_entry.cpp)
target_link_libraries(gpu_shading_gl PRIVATE project_options gpu_shading_opengl)
set(exports ${CMAKE_CURRENT_SOURCE_DIR}/gl_entry/exports.map)
target_link_options(gpu_shading_gl PRIVATE -Wl,--version-script=${exports} -Wl,--as-needed
                                           -Wl,--gc-sections ${no_undefined})
set_target_properties(gpu_shading_gl PROPERTIES LINK_DEPENDS ${exports})
