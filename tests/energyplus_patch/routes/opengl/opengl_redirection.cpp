// A library for tests/energyplus/penumbra: leads the calls of OpenGL of a library with GLFW to
// ours.

#include <dlfcn.h>

#include <cstdio>
#include <exception>

#include "platform/c_interface.h"
#include "routes/patched/binary/entry_patch.h"
#include "routes/patched/entries/entries.h"

// `inside`: an address in that library. Returns 0, or 1 with a message.
extern "C" EXPORTED int redirect_opengl_of(void const* inside) {
  using namespace gpu_shading::energyplus;
  try {
    Dl_info found{};
    if (dladdr(inside, &found) == 0) return 1;
    auto const entries = glfw_entries();
    SymbolTable const symbols(found.dli_fname, static_cast<std::byte*>(found.dli_fbase),
                              names_of(entries), Symbols::exported);
    patch_entries(symbols, entries);
    return 0;
  } catch (std::exception const& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
