#include "host/run.h"

#include <cstdio>
#include <ostream>

namespace gpu_shading::energyplus {

Installation& installation() {
  static Installation instance;
  return instance;
}

Run& this_run() {
  thread_local Run run;
  return run;
}

void print_line(std::string const& line) {
  std::fprintf(stderr, "gpu_shading: %s\n", line.c_str());
}

Session::Messages messages_of(Run const& run) {
  auto& functions = installation().functions;
  State* const state = run.state;
  std::ostream* const eio = run.eio;
  return {
      [&functions, state](std::string const& line) {
        print_line("warning: " + line);
        functions.warning(*state, "gpu_shading: " + line);
      },
      [&functions, state](std::string const& line) {
        print_line(line);
        functions.text(*state, "gpu_shading: " + line);
      },
      [eio](std::string const& line) {
        if (eio != nullptr) *eio << line;
      },
  };
}

}  // namespace gpu_shading::energyplus
