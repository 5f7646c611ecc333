# Man pages, made of the help of each program.
find_program(HELP2MAN help2man)
if(NOT HELP2MAN)
  message(STATUS "packaging: help2man is not installed: man pages are not made")
  add_custom_target(man_pages)
  return()
endif()
set(pages)

# add_man_page(<name> <command> [HELP <flag>] DEPENDS <file or target>...): name.1 from `command
# --help`, or another flag.
function(add_man_page name command)
  cmake_parse_arguments(PARSE_ARGV 2 ARG "" "HELP" "DEPENDS")
  if(NOT ARG_HELP)
    set(ARG_HELP --help)
  endif()
  set(page ${CMAKE_CURRENT_BINARY_DIR}/man/${name}.1)
  add_custom_command(
    OUTPUT ${page}
    COMMAND ${CMAKE_COMMAND} -E env LC_ALL=C.UTF-8 ${HELP2MAN} --no-info
            --no-discard-stderr --version-string=${PROJECT_VERSION} --output=${page} --help-option=${ARG_HELP}
            --name "GPU shading for EnergyPlus" ${command}
    DEPENDS ${ARG_DEPENDS}
    VERBATIM)
  set(pages ${pages} ${page} PARENT_SCOPE)
endfunction()

file(MAKE_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/man)
set(program $<TARGET_FILE:gpu_shading_program>)
add_man_page(gpu_shading ${program} HELP --help-all DEPENDS gpu_shading_program)
foreach(subcommand devices check view map mask screen sample export city docs example)
  add_man_page(gpu_shading-${subcommand} "${program} ${subcommand}" DEPENDS gpu_shading_program)
endforeach()
# Its help is that of the Python package.
foreach(command study suite)
  set(main ${PROJECT_SOURCE_DIR}/gpu_shading/python/gpu_shading/${command}/__main__.py)
  add_man_page(gpu_shading-${command} "python3 ${main}" DEPENDS ${main})
endforeach()
foreach(command IN LISTS command_files)
  get_filename_component(name ${command} NAME)
  add_man_page(${name} ${command} DEPENDS ${command})
endforeach()
add_custom_target(man_pages ALL DEPENDS ${pages})
install(FILES ${pages} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT documents)
