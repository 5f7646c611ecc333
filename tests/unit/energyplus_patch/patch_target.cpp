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

extern "C" EXPORTED int call_twice(int value) { return twice(value); }
extern "C" EXPORTED int call_reads_memory_first() { return reads_memory_first(); }
extern "C" EXPORTED int call_jumps_first() { return jumps_first(); }
extern "C" EXPORTED int call_too_short() { return too_short(); }
