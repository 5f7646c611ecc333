# The licences of the libraries that our programs are made of or linked with, as Debian's packages
# state them. Elsewhere the libraries' own packages have them.
set(linked libassimp-dev libcli11-dev libeigen3-dev libelf-dev libepoxy-dev libfmt-dev
           libgeographiclib-dev libgeotiff-dev libglm-dev libjs-three libopenimageio-dev libtbb-dev libtiff-dev
           libxxhash-dev libzycore-dev libzydis-dev nlohmann-json3-dev)
# That of libboost-dev is about the package, not about Boost.
file(GLOB boost /usr/share/doc/libboost1.*-dev)
list(TRANSFORM boost REPLACE ".*/" "")
foreach(package IN LISTS linked boost)
  set(file /usr/share/doc/${package}/copyright)
  if(EXISTS ${file})
    file(REAL_PATH ${file} file)
    string(REGEX REPLACE "^lib|[0-9.]*-dev$" "" name ${package})
    install(FILES ${file} DESTINATION ${CMAKE_INSTALL_DATADIR}/gpu_shading/licences RENAME ${name}
            COMPONENT licences)
  else()
    message(STATUS "packaging: ${file} is not there: the licence of ${package} is not installed")
  endif()
endforeach()
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/gpu_shading/licences
        RENAME gpu_shading COMPONENT licences)
