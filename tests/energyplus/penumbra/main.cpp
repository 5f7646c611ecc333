// Runs Penumbra's tests. On Linux, the first argument is a library that leads Penumbra's calls of
// OpenGL to ours; on Windows, opengl32.dll lies beside the program.

#include <cstdio>

#ifndef _WIN32
#include <dlfcn.h>

extern "C" void glfwTerminate();
#endif

int penumbra_main(int argc, char** argv);

int main(int argc, char** argv) {
#ifndef _WIN32
  if (argc < 2) return 1;
  void* const library = dlopen(argv[1], RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) {
    std::fprintf(stderr, "%s\n", dlerror());
    return 1;
  }
  using Redirect = int(void const* inside);
  auto* const redirect = reinterpret_cast<Redirect*>(dlsym(library, "redirect_opengl_of"));
  if (redirect == nullptr || redirect(reinterpret_cast<void const*>(&glfwTerminate)) != 0) return 1;
#endif
  return penumbra_main(argc, argv);
}
