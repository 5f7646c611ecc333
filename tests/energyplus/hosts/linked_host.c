/* A program that is linked with EnergyPlus's library, runs it once by each argument list, and knows
 * nothing of GPU shading.
 *
 *   linked_host FOLDER MODEL WEATHER [VARIABLE=VALUE FOLDER MODEL WEATHER]
 *
 * runs the design days of MODEL into FOLDER; VARIABLE is set (or, if VALUE is empty, unset) before
 * the second run. Build it with: cc linked_host.c -L ENERGYPLUS -lenergyplusapi
 */
#define _POSIX_C_SOURCE 200112L
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

extern void* stateNew(void);
extern void stateDelete(void* state);
extern int energyplus(void* state, int argc, char const** argv);

static int run(char** job) {
  char const* arguments[] = {"host", "-D", "-d", job[0], "-w", job[2], job[1]};
  void* const state = stateNew();
  int const status = energyplus(state, (int)(sizeof arguments / sizeof *arguments), arguments);
  stateDelete(state);
  return status;
}

int main(int argc, char** argv) {
  if (argc != 4 && argc != 8) {
    fprintf(stderr,
            "usage: linked_host FOLDER MODEL WEATHER [VARIABLE=VALUE FOLDER MODEL WEATHER]\n");
    return 2;
  }
  int const status = run(argv + 1);
  if (status != 0 || argc == 4) return status;
  char* const value = strchr(argv[4], '=');
  *value = '\0';
  if (value[1] == '\0') {
    unsetenv(argv[4]);
  } else {
    setenv(argv[4], value + 1, 1);
  }
  return run(argv + 5) == 0 ? 0 : 3;
}
