# Writes the source with the parts of a page, run by embed_page.cmake: HTML, CSS, SCRIPTS and LIBRARIES
# become strings. A literal holds at most 60,000 characters, because compilers need not take more.
function(literal variable text)
  string(LENGTH "${text}" length)
  set(pieces "")
  set(at 0)
  while(at LESS length)
    string(SUBSTRING "${text}" ${at} 60000 piece)
    string(APPEND pieces "R\"page_part(${piece})page_part\"\n")
    math(EXPR at "${at} + 60000")
  endwhile()
  set(${variable} "${pieces}\"\"" PARENT_SCOPE)
endfunction()

function(join variable)
  set(all "")
  foreach(file IN LISTS ARGN)
    file(READ ${file} text)
    string(APPEND all "${text}\n")
  endforeach()
  set(${variable} "${all}" PARENT_SCOPE)
endfunction()

join(html ${HTML})
join(css ${CSS})
join(scripts ${SCRIPTS})
join(library ${LIBRARIES})
foreach(part html css scripts library)
  literal(${part} "${${part}}")
endforeach()
file(WRITE ${SOURCE} "#include \"reports/page/page_parts.h\"

namespace gpu_shading::energyplus::page_parts {

char const* const page_html = ${html};
char const* const page_css = ${css};
char const* const scripts = ${scripts};
char const* const three_js = ${library};

}  // namespace gpu_shading::energyplus::page_parts
")
