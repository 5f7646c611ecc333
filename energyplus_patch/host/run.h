#pragma once

#include <filesystem>
#include <iosfwd>
#include <memory>
#include <optional>
#include <string>

#include "binary/stored_result.h"
#include "host/energyplus.h"
#include "host/schedules.h"
#include "session/session.h"

namespace gpu_shading::energyplus {

// What the process keeps: set by the installation, before any run.
struct Installation {
  std::filesystem::path library;
  std::string version;  // of EnergyPlus, e.g. "25.2.0"
  EnergyPlusFunctions functions;
  ScheduleFunctions schedules;
  std::optional<StoredResult> surface_ids;  // where EnergyPlus keeps what add_surface returned
  Choices choices;                          // command line over environment
};
Installation& installation();

// One EnergyPlus run. EnergyPlus runs a state on one thread from its input to its end, and none of
// its shading functions is handed the state; so this is the thread's.
struct Run {
  State* state = nullptr;
  std::optional<Model> model;   // once the input is read
  std::ostream* eio = nullptr;  // once EnergyPlus has written its own line on shading
  Session* session = nullptr;   // while EnergyPlus has one
};
Run& this_run();

// One line on standard error.
void print_line(std::string const& line);

// Where a session's messages go: this run's .err and .eio.
Session::Messages messages_of(Run const& run);

// Calls `action`; an exception of ours ends EnergyPlus's run with a fatal message. EnergyPlus's own
// pass.
template <typename Action>
auto guarded(Action const& action) {
  std::string message;
  try {
    return action();
  } catch (std::exception const& error) {
    message = error.what();
  }
  print_line("error: " + message);
  installation().functions.fatal(*this_run().state, "gpu_shading: " + message);
}

}  // namespace gpu_shading::energyplus
