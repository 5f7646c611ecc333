# The target gpu_shading_answers for a build of another project: a library from a build of this
# repository, which is made here unless there is one.
set(GPU_SHADING_BUILD "" CACHE PATH
    "A build folder of gpu_shading, with the target gpu_shading_answers_all built; empty: it is \
built with this project")
get_filename_component(repository ${CMAKE_CURRENT_SOURCE_DIR}/../../../.. ABSOLUTE)
set(build ${GPU_SHADING_BUILD})
if(NOT build)
  set(build ${CMAKE_CURRENT_BINARY_DIR}/gpu_shading)
endif()
set(library ${build}/energyplus_patch/libgpu_shading_answers.so)

add_library(gpu_shading_answers SHARED IMPORTED GLOBAL)
set_target_properties(gpu_shading_answers PROPERTIES
  IMPORTED_LOCATION ${library}
  INTERFACE_INCLUDE_DIRECTORIES ${repository}/energyplus_patch/include)

if(NOT GPU_SHADING_BUILD)
  include(ExternalProject)
  # In a build of its own, because it has other versions of some libraries and another standard.
  ExternalProject_Add(gpu_shading_build
    SOURCE_DIR ${repository}
    BINARY_DIR ${build}
    CMAKE_ARGS -DCMAKE_BUILD_TYPE=Release -DGPU_SHADING_TESTS=OFF
               -DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER}
               -DCMAKE_CXX_COMPILER_LAUNCHER=${CMAKE_CXX_COMPILER_LAUNCHER}
    BUILD_COMMAND ${CMAKE_COMMAND} --build ${build} --target gpu_shading_answers_all
    BUILD_BYPRODUCTS ${library}
    BUILD_ALWAYS TRUE
    INSTALL_COMMAND "")
  add_dependencies(gpu_shading_answers gpu_shading_build)
endif()
