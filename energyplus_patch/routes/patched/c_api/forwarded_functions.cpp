// The functions of the C API that the official library defines are among this one's symbols too:
// the linker looks for them only in libraries that a program names (-lenergyplusapi), not in those
// that these need. Each jumps to the official one and leaves arguments where they are.
//
// Indirect functions (ifunc) do not serve: the official library's own calls of these names are
// bound to ours before ours can answer.

#include <dlfcn.h>

#include <cstdio>
#include <cstdlib>

namespace {

using Function = void();

[[noreturn]] void refuse() {
  std::fprintf(stderr, "gpu_shading: error: EnergyPlus's library lacks a function of its API\n");
  std::abort();
}

void find(Function*& target, char const* name) {
  void* const function = dlsym(RTLD_NEXT, name);
  if (function != nullptr) target = reinterpret_cast<Function*>(function);
}

}  // namespace

extern "C" {

#define API_FUNCTION(name)                                                           \
  __attribute__((used, visibility("hidden"))) Function* gpu_shading_##name = refuse; \
  __asm__(".pushsection .text\n.globl " #name "\n.type " #name ", @function\n" #name \
          ":\n  jmp *gpu_shading_" #name "(%rip)\n.size " #name ", . - " #name "\n.popsection");
#include "routes/patched/c_api/function_names.inc"
#undef API_FUNCTION
}

namespace {

__attribute__((constructor)) void find_all() {
#define API_FUNCTION(name) find(gpu_shading_##name, #name);
#include "routes/patched/c_api/function_names.inc"
#undef API_FUNCTION
}

}  // namespace
