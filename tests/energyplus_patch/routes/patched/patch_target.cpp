// Compiled into a library of its own, which entry_patch_test.cpp loads.

#define EXPORTED __attribute__((visibility("default")))

namespace {

int volatile counter = 5;

// Local to the library: found in .symtab alone.
__attribute__((noinline, used)) int twice(int value) {
  int volatile doubled = value * 2;
  return doubled + counter - counter;
}

}  // namespace

// Its first instruction addresses memory relative to the instruction pointer.
extern "C" __attribute__((naked, noinline, used, visibility("hidden"))) int reads_memory_first() {
  asm("movl patch_target_number(%rip), %eax\n\t"
      "addl $0, %eax\n\t"
      "addl $0, %eax\n\t"
      "addl $0, %eax\n\t"
      "ret");
}
extern "C" {
__attribute__((used, visibility("hidden"))) int volatile patch_target_number = 42;
}

// Its first instruction is a relative jump.
extern "C" __attribute__((naked, noinline, used, visibility("hidden"))) int jumps_first() {
  asm("jmp 1f\n\t"
      "1: movl $7, %eax\n\t"
      "movl $7, %eax\n\t"
      "movl $7, %eax\n\t"
      "ret");
}

extern "C" __attribute__((naked, noinline, used, visibility("hidden"))) int too_short() {
  asm("movl $3, %eax\n\t"
      "ret");
}

// Stores the result of its second call, of gives_number, in an array two pointers away.
extern "C" __attribute__((naked, noinline, used, visibility("hidden"))) int gives_number() {
  asm("movl $11, %eax\n\t"
      "ret");
}
extern "C" __attribute__((naked, noinline, used, visibility("hidden"))) int stores_number() {
  asm("call gives_number\n\t"
      "movl %eax, (%rsp)\n\t"
      "call gives_number\n\t"
      "movq 0x148(%rbx), %rdx\n\t"
      "movq 0x30(%rsp), %rcx\n\t"
      "movq 0x28(%rdx), %rdx\n\t"
      "movl %eax, (%rdx,%rcx,1)\n\t"
      "ret");
}

namespace {

// Its last eight arguments are on the stack.
__attribute__((noinline, used)) int digits(int a, int b, int c, int d, int e, int f, int g, int h,
                                           int i, int j, int k, int l, int m, int n) {
  int volatile first = a + b + c + d + e + f;
  return first + g - h + i - j + k - l + m - n + counter - counter;
}

}  // namespace

extern "C" EXPORTED int call_digits() {
  return digits(1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, counter);
}
extern "C" EXPORTED int call_twice(int value) { return twice(value); }
extern "C" EXPORTED int call_reads_memory_first() { return reads_memory_first(); }
extern "C" EXPORTED int call_jumps_first() { return jumps_first(); }
extern "C" EXPORTED int call_too_short() { return too_short(); }

extern "C" __attribute__((naked, noinline, used, visibility("hidden"))) int gives_integer() {
  asm("movl $3, %eax\n\t"
      "addl $0, %eax\n\t"
      "addl $0, %eax\n\t"
      "addl $0, %eax\n\t"
      "ret");
}
extern "C" __attribute__((naked, noinline, used, visibility("hidden"))) double gives_real() {
  asm("pxor %xmm0, %xmm0\n\t"
      "pxor %xmm0, %xmm0\n\t"
      "pxor %xmm0, %xmm0\n\t"
      "pxor %xmm0, %xmm0\n\t"
      "ret");
}
// Calls a function with the 25 registers that it may change as they are given: xmm0 to xmm15, then
// rax, rcx, rdx, rdi, rsi, r8 to r11. Stores them there as they are afterwards.
extern "C" __attribute__((naked, noinline, used, visibility("hidden"))) int call_with_registers(
    void* /*registers*/, void* /*function*/) {
  asm("push %rbx\n\t"
      "push %r12\n\t"
      "mov %rdi, %rbx\n\t"
      "mov %rsi, %r12\n\t"
      "movsd 0(%rbx), %xmm0\n\t"
      "movsd 8(%rbx), %xmm1\n\t"
      "movsd 16(%rbx), %xmm2\n\t"
      "movsd 24(%rbx), %xmm3\n\t"
      "movsd 32(%rbx), %xmm4\n\t"
      "movsd 40(%rbx), %xmm5\n\t"
      "movsd 48(%rbx), %xmm6\n\t"
      "movsd 56(%rbx), %xmm7\n\t"
      "movsd 64(%rbx), %xmm8\n\t"
      "movsd 72(%rbx), %xmm9\n\t"
      "movsd 80(%rbx), %xmm10\n\t"
      "movsd 88(%rbx), %xmm11\n\t"
      "movsd 96(%rbx), %xmm12\n\t"
      "movsd 104(%rbx), %xmm13\n\t"
      "movsd 112(%rbx), %xmm14\n\t"
      "movsd 120(%rbx), %xmm15\n\t"
      "mov 128(%rbx), %rax\n\t"
      "mov 136(%rbx), %rcx\n\t"
      "mov 144(%rbx), %rdx\n\t"
      "mov 152(%rbx), %rdi\n\t"
      "mov 160(%rbx), %rsi\n\t"
      "mov 168(%rbx), %r8\n\t"
      "mov 176(%rbx), %r9\n\t"
      "mov 184(%rbx), %r10\n\t"
      "mov 192(%rbx), %r11\n\t"
      "call *%r12\n\t"
      "movsd %xmm0, 0(%rbx)\n\t"
      "movsd %xmm1, 8(%rbx)\n\t"
      "movsd %xmm2, 16(%rbx)\n\t"
      "movsd %xmm3, 24(%rbx)\n\t"
      "movsd %xmm4, 32(%rbx)\n\t"
      "movsd %xmm5, 40(%rbx)\n\t"
      "movsd %xmm6, 48(%rbx)\n\t"
      "movsd %xmm7, 56(%rbx)\n\t"
      "movsd %xmm8, 64(%rbx)\n\t"
      "movsd %xmm9, 72(%rbx)\n\t"
      "movsd %xmm10, 80(%rbx)\n\t"
      "movsd %xmm11, 88(%rbx)\n\t"
      "movsd %xmm12, 96(%rbx)\n\t"
      "movsd %xmm13, 104(%rbx)\n\t"
      "movsd %xmm14, 112(%rbx)\n\t"
      "movsd %xmm15, 120(%rbx)\n\t"
      "mov %rax, 128(%rbx)\n\t"
      "mov %rcx, 136(%rbx)\n\t"
      "mov %rdx, 144(%rbx)\n\t"
      "mov %rdi, 152(%rbx)\n\t"
      "mov %rsi, 160(%rbx)\n\t"
      "mov %r8, 168(%rbx)\n\t"
      "mov %r9, 176(%rbx)\n\t"
      "mov %r10, 184(%rbx)\n\t"
      "mov %r11, 192(%rbx)\n\t"
      "pop %r12\n\t"
      "pop %rbx\n\t"
      "ret");
}
extern "C" EXPORTED int call_gives_integer(void* registers) {
  return call_with_registers(registers, reinterpret_cast<void*>(&gives_integer));
}
extern "C" EXPORTED int call_gives_real(void* registers) {
  return call_with_registers(registers, reinterpret_cast<void*>(&gives_real));
}
