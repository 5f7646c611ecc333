# write_entries(<file>): the entries of an opengl32.dll, as a source: their names, which are those of the system's own
# library as MinGW lists them, and code that jumps to where the name's entry in a table leads, arguments untouched.
# The table is filled when an entry is first called.
function(write_entries file)
  execute_process(COMMAND ${CMAKE_CXX_COMPILER} -print-file-name=libopengl32.a
                  OUTPUT_VARIABLE library OUTPUT_STRIP_TRAILING_WHITESPACE)
  execute_process(COMMAND ${CMAKE_NM} ${library} OUTPUT_VARIABLE symbols ERROR_QUIET)
  string(REGEX MATCHALL " T [A-Za-z0-9_]+" names "${symbols}")
  list(TRANSFORM names REPLACE " T " "")
  list(SORT names)
  list(REMOVE_DUPLICATES names)
  list(LENGTH names count)
  if(count LESS 300)
    message(FATAL_ERROR "${library}: names ${count} functions, instead of some 368")
  endif()
  set(strings "")
  set(code "")
  set(index 0)
  foreach(name IN LISTS names)
    string(APPEND strings "    \"${name}\",\n")
    string(APPEND code "    \"${name}: movl $${index}, %r11d; jmp gpu_shading_jump\\n\"\n"
                       "    \".globl ${name}\\n\"\n")
    string(APPEND exports "    \"  .ascii \\\" -export:${name}\\\"\\n\"\n")
    math(EXPR index "${index} + 1")
  endforeach()
  file(CONFIGURE OUTPUT ${file} @ONLY CONTENT [=[
#include "routes/opengl/windows/entries.h"

char const* const gpu_shading_entry_names[] = {
@strings@};
void* gpu_shading_entry_table[@count@];

// Windows's calling convention: four arguments in rcx, rdx, r8 and r9, or xmm0 to xmm3; r10 and r11 are free.
asm(".text\n"
    "gpu_shading_jump:\n"
    "  leaq gpu_shading_entry_table(%rip), %r10\n"
    "  movq (%r10, %r11, 8), %r10\n"
    "  testq %r10, %r10\n"
    "  jz 1f\n"
    "  jmp *%r10\n"
    "1:\n"
    "  pushq %rcx\n"
    "  pushq %rdx\n"
    "  pushq %r8\n"
    "  pushq %r9\n"
    "  subq $0x68, %rsp\n"
    "  movups %xmm0, 0x20(%rsp)\n"
    "  movups %xmm1, 0x30(%rsp)\n"
    "  movups %xmm2, 0x40(%rsp)\n"
    "  movups %xmm3, 0x50(%rsp)\n"
    "  movl %r11d, %ecx\n"
    "  call gpu_shading_find_entry\n"
    "  movups 0x20(%rsp), %xmm0\n"
    "  movups 0x30(%rsp), %xmm1\n"
    "  movups 0x40(%rsp), %xmm2\n"
    "  movups 0x50(%rsp), %xmm3\n"
    "  addq $0x68, %rsp\n"
    "  popq %r9\n"
    "  popq %r8\n"
    "  popq %rdx\n"
    "  popq %rcx\n"
    "  jmp *%rax\n"
@code@    ".section .drectve\n"
@exports@    ".text\n");
]=])
endfunction()
