# What a wheel reads and writes images with, in place of Debian's libraries, which bring 350 MB: OpenImageIO of PyPI,
# whose library has its formats within, libtiff without JBIG, whose library is under the GPL, and libgeotiff without
# PROJ, of which nothing is called. scripts/dev/build_wheel fetches OpenImageIO.
set(GPU_SHADING_OPENIMAGEIO "" CACHE PATH
    "Folder with PyPI's OpenImageIO: `package`, as pip installs it, and `src` of its sources")

function(configure_openimageio_headers version folder)
  string(REPLACE "." ";" numbers ${version})
  list(GET numbers 0 PROJECT_VERSION_MAJOR)
  list(GET numbers 1 PROJECT_VERSION_MINOR)
  list(GET numbers 2 PROJECT_VERSION_PATCH)
  set(PROJECT_VERSION_TWEAK 0)
  set(OIIO_USE_COMPILED_FMT_VALUE 0)
  set(PROJ_NAMESPACE OpenImageIO)
  set(PROJ_VERSION_NAMESPACE v${PROJECT_VERSION_MAJOR}_${PROJECT_VERSION_MINOR})
  set(Imath_VERSION_MAJOR 3)
  set(Imath_VERSION_MINOR 1)
  file(COPY ${GPU_SHADING_OPENIMAGEIO}/src/include/OpenImageIO DESTINATION ${folder})
  configure_file(${folder}/OpenImageIO/oiioversion.h.in ${folder}/OpenImageIO/oiioversion.h @ONLY)
  get_target_property(fmt fmt::fmt INTERFACE_INCLUDE_DIRECTORIES)
  file(COPY ${fmt}/fmt DESTINATION ${folder}/OpenImageIO/detail)
endfunction()

file(GLOB openimageio ${GPU_SHADING_OPENIMAGEIO}/package/OpenImageIO/lib/libOpenImageIO.so.*)
file(GLOB openimageio_util ${GPU_SHADING_OPENIMAGEIO}/package/OpenImageIO/lib/libOpenImageIO_Util.so.*)
if(NOT openimageio OR NOT openimageio_util)
  message(FATAL_ERROR "GPU_SHADING_OPENIMAGEIO has no OpenImageIO: run scripts/dev/build_wheel")
endif()
string(REGEX MATCH "[0-9]+[.][0-9.]+$" version ${openimageio})
configure_openimageio_headers(${version} ${PROJECT_BINARY_DIR}/openimageio)
find_package(Imath REQUIRED GLOBAL)
target_include_directories(openimageio SYSTEM INTERFACE ${PROJECT_BINARY_DIR}/openimageio)
target_link_libraries(openimageio INTERFACE Imath::Imath ${openimageio} ${openimageio_util})

find_library(GEOTIFF_ARCHIVE libgeotiff.a REQUIRED)
find_library(TIFF_ARCHIVE libtiff.a REQUIRED)
add_library(unused_libraries STATIC ${CMAKE_CURRENT_LIST_DIR}/unused_libraries.cpp)
target_link_libraries(unused_libraries PRIVATE project_options)
target_link_libraries(geotiff INTERFACE ${GEOTIFF_ARCHIVE} ${TIFF_ARCHIVE} unused_libraries
                                        webp zstd lzma Lerc jpeg deflate z)
