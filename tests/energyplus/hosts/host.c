/* A program of its own that runs EnergyPlus through its C API, shaded by the GPU.
 *
 *   host PREFIX OPTION RUNS [EnergyPlus's arguments ...]
 *
 * PREFIX is a patched EnergyPlus; OPTION is a flag of the launcher, "" for none; RUNS is how many
 * times to run, each with a state of its own. Build it with: cc host.c -ldl
 */
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>

typedef void* State;

static void* load(char const* prefix, char const* name) {
  char path[4096];
  snprintf(path, sizeof path, "%s/%s", prefix, name);
  /* Local: EnergyPlus carries copies of libraries that a program may have from elsewhere. */
  void* const library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
  if (library == NULL) {
    fprintf(stderr, "host: %s\n", dlerror());
    exit(2);
  }
  return library;
}

static void* find(void* library, char const* name) {
  void* const function = dlsym(library, name);
  if (function == NULL) {
    fprintf(stderr, "host: %s\n", dlerror());
    exit(2);
  }
  return function;
}

int main(int argc, char** argv) {
  if (argc < 4) {
    fprintf(stderr, "usage: host PREFIX OPTION RUNS [EnergyPlus's arguments ...]\n");
    return 2;
  }
  char const* const prefix = argv[1];
  void* const energyplus_library = load(prefix, "libenergyplusapi.so");
  void* const gpu_shading = load(prefix, "libgpu_shading_energyplus.so");

  int (*install)(char const*, int, char const* const*) = find(gpu_shading, "gpu_shading_install");
  char const* (*message)(void) = find(gpu_shading, "gpu_shading_message");
  State (*new_state)(void) = find(energyplus_library, "stateNew");
  void (*delete_state)(State) = find(energyplus_library, "stateDelete");
  void (*set_root)(State, char const*) = find(energyplus_library, "setEnergyPlusRootDirectory");
  int (*energyplus)(State, int, char const**) = find(energyplus_library, "energyplus");

  /* Once, before the first run. */
  char library_path[4096];
  snprintf(library_path, sizeof library_path, "%s/libenergyplusapi.so", prefix);
  char const* const options[] = {argv[2]};
  if (install(library_path, argv[2][0] == '\0' ? 0 : 1, options) != 0) {
    fprintf(stderr, "host: %s\n", message());
    return 1;
  }

  int status = 0;
  for (int run = atoi(argv[3]); run > 0 && status == 0; --run) {
    State const state = new_state();
    set_root(state, prefix);
    /* The word before EnergyPlus's arguments stands for the program's name. */
    status = energyplus(state, argc - 3, (char const**)argv + 3);
    delete_state(state);
  }
  return status;
}
