#include "routes/patched/entries/run.h"

#include <ostream>

#include "platform/console.h"
#include "platform/error_line.h"
#include "platform/text.h"

namespace gpu_shading::energyplus {

Installation& installation() {
  static Installation instance;
  return instance;
}

Run& this_run() {
  thread_local Run run;
  return run;
}

Messages messages_of(Run const& run) {
  auto& functions = installation().functions;
  State* const state = run.state;
  std::ostream* const eio = run.eio;
  return {
      [&functions, state](std::string const& line) {
        print_line("warning: " + line);
        functions.warning(*state, "gpu_shading: " + one_line(line));
        if (auto& task = installation().task) task->warn(line);
      },
      [&functions, state](std::string const& line) {
        print_line(line);
        functions.text(*state, "gpu_shading: " + one_line(line));
      },
      [eio](std::string const& line) {
        if (eio != nullptr) *eio << line;
      },
  };
}

void end_run(std::exception_ptr const& thrown) {
  auto& installed = installation();
  std::string why;
  try {
    std::rethrow_exception(thrown);
  } catch (TaskDone const&) {
    why = "done; no simulation was asked for";
  } catch (std::exception const& error) {
    why = error_line(error);
    print_line("error: " + why);
    if (installed.task) installed.task->fail(why);
  }
  installed.functions.fatal(*this_run().state, "gpu_shading: " + why);
}

}  // namespace gpu_shading::energyplus
