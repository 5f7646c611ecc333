#include "routes/patched/binary/preserving_thunk.h"

#include <array>
#include <atomic>
#include <cstddef>

#include "gpu_shading/error.h"

namespace gpu_shading::energyplus {
namespace {

constexpr std::size_t most_thunks = 64;  // of each kind; the assembly below has as many

}  // namespace

extern "C" {
__attribute__((visibility("hidden"))) extern std::byte const gpu_shading_integer_thunks[];
__attribute__((visibility("hidden"))) extern std::byte const gpu_shading_real_thunks[];
__attribute__((visibility("hidden"), used)) std::array<void*, 2 * most_thunks>
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
  movaps %xmm0, 64(%rsp)
  movaps %xmm1, 80(%rsp)
  movaps %xmm2, 96(%rsp)
  movaps %xmm3, 112(%rsp)
  movaps %xmm4, 128(%rsp)
  movaps %xmm5, 144(%rsp)
  movaps %xmm6, 160(%rsp)
  movaps %xmm7, 176(%rsp)
  movaps %xmm8, 192(%rsp)
  movaps %xmm9, 208(%rsp)
  movaps %xmm10, 224(%rsp)
  movaps %xmm11, 240(%rsp)
  movaps %xmm12, 256(%rsp)
  movaps %xmm13, 272(%rsp)
  movaps %xmm14, 288(%rsp)
  movaps %xmm15, 304(%rsp)
  mov %rax, 320(%rsp)
  mov %rcx, 328(%rsp)
  mov %rdx, 336(%rsp)
  mov %rsi, 344(%rsp)
  mov %rdi, 352(%rsp)
  mov %r8, 360(%rsp)
  mov %r9, 368(%rsp)
  mov %r10, 376(%rsp)
  mov %r11, 384(%rsp)
  mov 24(%rbp), %r10
  mov %r10, 0(%rsp)
  mov 32(%rbp), %r10
  mov %r10, 8(%rsp)
  mov 40(%rbp), %r10
  mov %r10, 16(%rsp)
  mov 48(%rbp), %r10
  mov %r10, 24(%rsp)
  mov 56(%rbp), %r10
  mov %r10, 32(%rsp)
  mov 64(%rbp), %r10
  mov %r10, 40(%rsp)
  mov 72(%rbp), %r10
  mov %r10, 48(%rsp)
  mov 80(%rbp), %r10
  mov %r10, 56(%rsp)
  mov 8(%rbp), %r11
  lea gpu_shading_thunk_targets(%rip), %r10
  call *(%r10,%r11,8)
  movaps 80(%rsp), %xmm1
  movaps 96(%rsp), %xmm2
  movaps 112(%rsp), %xmm3
  movaps 128(%rsp), %xmm4
  movaps 144(%rsp), %xmm5
  movaps 160(%rsp), %xmm6
  movaps 176(%rsp), %xmm7
  movaps 192(%rsp), %xmm8
  movaps 208(%rsp), %xmm9
  movaps 224(%rsp), %xmm10
  movaps 240(%rsp), %xmm11
  movaps 256(%rsp), %xmm12
  movaps 272(%rsp), %xmm13
  movaps 288(%rsp), %xmm14
  movaps 304(%rsp), %xmm15
  mov 328(%rsp), %rcx
  mov 336(%rsp), %rdx
  mov 344(%rsp), %rsi
  mov 352(%rsp), %rdi
  mov 360(%rsp), %r8
  mov 368(%rsp), %r9
  mov 376(%rsp), %r10
  mov 384(%rsp), %r11
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
  if (number >= most_thunks) throw Error("too many redirected functions");
  gpu_shading_thunk_targets[kind * most_thunks + number] = function;
  auto const* const start = kind == 0 ? gpu_shading_integer_thunks : gpu_shading_real_thunks;
  return const_cast<std::byte*>(start + number * thunk_size);
}

}  // namespace gpu_shading::energyplus
