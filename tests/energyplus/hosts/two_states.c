/* Two EnergyPlus states at the same time in one process, each on a thread of its own.
 *
 *   two_states PREFIX OPTION WEATHER MODEL FOLDER MODEL FOLDER
 *
 * Runs each MODEL's design days into its FOLDER. Build it with: cc two_states.c -ldl -lpthread
 */
#include <dlfcn.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>

typedef void* State;

static State (*new_state)(void);
static void (*set_root)(State, char const*);
static int (*energyplus)(State, int, char const**);

struct Job {
  char const* prefix;
  char const* weather;
  char const* model;
  char const* folder;
  int status;
};

static void* find(void* library, char const* name) {
  void* const function = library == NULL ? NULL : dlsym(library, name);
  if (function == NULL) {
    fprintf(stderr, "two_states: %s\n", dlerror());
    exit(2);
  }
  return function;
}

static void* run(void* argument) {
  struct Job* const job = argument;
  char const* arguments[] = {"host", "-D", "-w", job->weather, "-d", job->folder, job->model};
  State const state = new_state();
  set_root(state, job->prefix);
  job->status = energyplus(state, (int)(sizeof arguments / sizeof *arguments), arguments);
  return NULL;
}

int main(int argc, char** argv) {
  if (argc != 8) {
    fprintf(stderr, "usage: two_states PREFIX OPTION WEATHER MODEL FOLDER MODEL FOLDER\n");
    return 2;
  }
  char path[4096];
  snprintf(path, sizeof path, "%s/libenergyplusapi.so", argv[1]);
  void* const library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
  new_state = find(library, "stateNew");
  set_root = find(library, "setEnergyPlusRootDirectory");
  energyplus = find(library, "energyplus");

  char patch[4096];
  snprintf(patch, sizeof patch, "%s/libgpu_shading_energyplus.so", argv[1]);
  void* const shading = dlopen(patch, RTLD_NOW | RTLD_LOCAL);
  int (*install)(char const*, int, char const* const*) = find(shading, "gpu_shading_install");
  char const* (*message)(void) = find(shading, "gpu_shading_message");
  char const* const options[] = {argv[2]};
  if (install(path, 1, options) != 0) {
    fprintf(stderr, "two_states: %s\n", message());
    return 1;
  }

  struct Job jobs[2] = {{argv[1], argv[3], argv[4], argv[5], -1},
                        {argv[1], argv[3], argv[6], argv[7], -1}};
  pthread_t threads[2];
  for (int i = 0; i < 2; ++i) pthread_create(&threads[i], NULL, run, &jobs[i]);
  for (int i = 0; i < 2; ++i) pthread_join(threads[i], NULL);
  return jobs[0].status != 0 ? jobs[0].status : jobs[1].status;
}
