# embed_page(<variable> <library>...): the parts of a run's page as strings in the library, so that it
# needs no files at run time; <variable> gets the source file to compile. The libraries are files that
# Debian packages bring; without them pages have no model in 3D.
function(embed_page variable)
  set(folder ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/parts)
  # In the order in which they are run.
  set(scripts content colours geometry patterns shading sky terrain model_view plain_drawing maps carpet modules beam mask saving receivers main)
  list(TRANSFORM scripts PREPEND ${folder}/)
  list(TRANSFORM scripts APPEND .js)
  set(parts ${folder}/page.html ${folder}/page.css ${scripts} ${ARGN})
  set(source ${CMAKE_CURRENT_BINARY_DIR}/page_parts.cpp)
  set(script ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/write_parts.cmake)
  add_custom_command(
    OUTPUT ${source}
    COMMAND ${CMAKE_COMMAND} "-DSOURCE=${source}" "-DHTML=${folder}/page.html" "-DCSS=${folder}/page.css"
            "-DSCRIPTS=${scripts}" "-DLIBRARIES=${ARGN}" -P ${script}
    DEPENDS ${parts} ${script}
    VERBATIM)
  set_source_files_properties(${source} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON
                                                   SKIP_PRECOMPILE_HEADERS ON)
  set(${variable} ${source} PARENT_SCOPE)
endfunction()
