# The licences of the libraries that our programs are made of or linked with, as Debian's packages
# state them. Elsewhere the libraries' own packages have them.
set(linked libassimp-dev libcli11-dev libeigen3-dev libelf-dev libepoxy-dev libfmt-dev
           libgeographiclib-dev libgeotiff-dev libglm-dev libjs-three libmimalloc-dev libopenimageio-dev libseccomp-dev libtbb-dev libtiff-dev
           libxxhash-dev libzycore-dev libzydis-dev nlohmann-json3-dev)
# That of libboost-dev is about the package, not about Boost.
file(GLOB boost /usr/share/doc/libboost1.*-dev)
list(TRANSFORM boost REPLACE ".*/" "")
# With the libraries of images and meshes in a wheel come those that they are linked with.
set(bundled)
if(GPU_SHADING_BUNDLE)
  foreach(name deflate draco jpeg62-turbo lerc lzma minizip sharpyuv webp zstd)
    file(GLOB found /usr/share/doc/lib${name}[0-9] /usr/share/doc/lib${name}[0-9]t64 /usr/share/doc/lib${name})
    list(APPEND bundled ${found})
  endforeach()
  list(TRANSFORM bundled REPLACE ".*/" "")
  file(GLOB texts ${GPU_SHADING_OPENIMAGEIO}/package/openimageio-*.dist-info/licenses/*.md)
  install(FILES ${texts} DESTINATION ${CMAKE_INSTALL_DATADIR}/gpu_shading/licences/openimageio-wheel COMPONENT licences)
endif()
foreach(package IN LISTS linked boost bundled)
  set(file /usr/share/doc/${package}/copyright)
  if(EXISTS ${file})
    file(REAL_PATH ${file} file)
    string(REGEX REPLACE "^lib|[0-9.]*-dev$|[0-9]+(t64)?$" "" name ${package})
    install(FILES ${file} DESTINATION ${CMAKE_INSTALL_DATADIR}/gpu_shading/licences RENAME ${name}
            COMPONENT licences)
  else()
    message(STATUS "packaging: ${file} is not there: the licence of ${package} is not installed")
  endif()
endforeach()
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/gpu_shading/licences
        RENAME gpu_shading COMPONENT licences)
