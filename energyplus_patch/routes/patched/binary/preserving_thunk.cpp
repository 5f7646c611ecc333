#include "routes/patched/binary/preserving_thunk.h"

#include <array>
#include <atomic>
#include <cstddef>

#include "gpu_shading/error.h"

namespace gpu_shading::energyplus {
namespace {

constexpr std::size_t max_thunks = 64;  // of each kind; the assembly below has as many

}  // namespace

extern "C" {
__attribute__((visibility("hidden"))) extern std::byte const gpu_shading_integer_thunks[];
__attribute__((visibility("hidden"))) extern std::byte const gpu_shading_real_thunks[];
__attribute__((visibility("hidden"), used)) std::array<void*, 2 * max_thunks>
    gpu_shading_thunk_targets{};
}

// A thunk pushes its number and jumps to the body of its kind. The body aligns the stack, too: a
// caller leaves that out where the function that it knows does not need it (GCC's
// -fipa-stack-alignment). Eight words of arguments on the stack are passed on, whether there are so
// many or not.
asm(R"(
  .pushsection .text
  .set gpu_shading_thunk, 0

  .macro GPU_SHADING_THUNKS name, body
  .balign 16
  .hidden \name
  .globl \name
\name:
  .rept 64
  .balign 16
  .cfi_startproc
  push $gpu_shading_thunk
  .cfi_adjust_cfa_offset 8
  jmp \body
  .cfi_endproc
  .set gpu_shading_thunk, gpu_shading_thunk + 1
  .endr
  .endm

  .macro GPU_SHADING_THUNK_CALL
  .cfi_startproc
  .cfi_def_cfa_offset 16
  push %rbp
  .cfi_adjust_cfa_offset 8
  .cfi_rel_offset %rbp, 0
  mov %rsp, %rbp
  .cfi_def_cfa_register %rbp
  and $-16, %rsp
  sub $400, %rsp
  .irp n, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15
  movaps %xmm\n, 64+16*\n(%rsp)
  .endr
  .set gpu_shading_place, 320
  .irp register, rax, rcx, rdx, rsi, rdi, r8, r9, r10, r11
  mov %\register, gpu_shading_place(%rsp)
  .set gpu_shading_place, gpu_shading_place + 8
  .endr
  .irp n, 0, 1, 2, 3, 4, 5, 6, 7
  mov 24+8*\n(%rbp), %r10
  mov %r10, 8*\n(%rsp)
  .endr
  mov 8(%rbp), %r11
  lea gpu_shading_thunk_targets(%rip), %r10
  call *(%r10,%r11,8)
  .irp n, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15
  movaps 64+16*\n(%rsp), %xmm\n
  .endr
  .set gpu_shading_place, 328
  .irp register, rcx, rdx, rsi, rdi, r8, r9, r10, r11
  mov gpu_shading_place(%rsp), %\register
  .set gpu_shading_place, gpu_shading_place + 8
  .endr
  .endm

  .macro GPU_SHADING_THUNK_RETURN
  mov %rbp, %rsp
  pop %rbp
  .cfi_def_cfa %rsp, 16
  lea 8(%rsp), %rsp
  .cfi_adjust_cfa_offset -8
  ret
  .cfi_endproc
  .endm

gpu_shading_integer_thunk_body:
  GPU_SHADING_THUNK_CALL
  movaps 64(%rsp), %xmm0
  GPU_SHADING_THUNK_RETURN

gpu_shading_real_thunk_body:
  GPU_SHADING_THUNK_CALL
  mov 320(%rsp), %rax
  GPU_SHADING_THUNK_RETURN

  GPU_SHADING_THUNKS gpu_shading_integer_thunks, gpu_shading_integer_thunk_body
  GPU_SHADING_THUNKS gpu_shading_real_thunks, gpu_shading_real_thunk_body
  .popsection
)");

void* preserve_registers(void* function, Result result) {
  constexpr std::size_t thunk_size = 16;
  static std::array<std::atomic<std::size_t>, 2> used{};
  auto const kind = static_cast<std::size_t>(result == Result::real);
  auto const number = used[kind]++;
  if (number >= max_thunks) throw Error("too many redirected functions");
  gpu_shading_thunk_targets[kind * max_thunks + number] = function;
  auto const* const start = kind == 0 ? gpu_shading_integer_thunks : gpu_shading_real_thunks;
  return const_cast<std::byte*>(start + number * thunk_size);
}

}  // namespace gpu_shading::energyplus
