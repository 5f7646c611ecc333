# embed_shaders(<variable> <folder>): every shader of the folder as a string in the library, so that it
# needs no files at run time. NAME.STAGE becomes gpu_shading::shaders::NAME_STAGE in
# "shaders/sources.h"; <variable> gets the source file to compile.
function(embed_shaders variable folder)
  file(GLOB shaders CONFIGURE_DEPENDS ${folder}/*.vert ${folder}/*.geom ${folder}/*.frag
       ${folder}/*.comp)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${shaders})
  set(declarations "")
  set(definitions "")
  foreach(shader IN LISTS shaders)
    get_filename_component(name ${shader} NAME)
    string(REPLACE "." "_" name ${name})
    file(READ ${shader} text)
    string(APPEND declarations "extern char const* const ${name};\n")
    string(APPEND definitions "char const* const ${name} = R\"glsl(${text})glsl\";\n")
  endforeach()
  set(source ${CMAKE_CURRENT_BINARY_DIR}/shaders/sources.cpp)
  file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/shaders/sources.h @ONLY CONTENT
"#pragma once

namespace gpu_shading::shaders {

@declarations@
}  // namespace gpu_shading::shaders
")
  file(CONFIGURE OUTPUT ${source} @ONLY CONTENT
"#include \"shaders/sources.h\"

namespace gpu_shading::shaders {

@definitions@
}  // namespace gpu_shading::shaders
")
  set(${variable} ${source} PARENT_SCOPE)
endfunction()
