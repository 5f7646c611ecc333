#pragma once

#include <exception>
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "calculation/session.h"
#include "routes/patched/memory/surface_ids.h"
#include "routes/patched/symbols/energyplus_functions.h"
#include "tasks/task_file.h"

namespace gpu_shading::energyplus {

// What the process keeps: set by the installation, before any run.
struct Installation {
  std::filesystem::path library;
  Release release;  // of EnergyPlus
  EnergyPlusFunctions functions;
  ScheduleFunctions schedules;
  std::set<Need> served;                    // whose symbols this build has, and redirected entries
  std::optional<StoredResult> surface_ids;  // where EnergyPlus keeps what add_surface returned
  Choices choices;                          // command line over environment
  std::optional<AskedTask> task;            // that EnergyPlus is run for

  bool serves(Need need) const { return served.contains(need); }
};
Installation& installation();

// What reflected light is read and set by.
struct Grounds {
  int light = 0;                   // EnergyPlusFunctions::light_of_ground()
  std::vector<double*> schedules;  // current values, of Model::reflected_light's receivers
};

// One EnergyPlus run. EnergyPlus runs a state on one thread from its input to its end, and none of
// its shading functions is handed the state; so this is the thread's.
struct Run {
  State* state = nullptr;
  std::optional<Model> model;  // once the input is read
  // Once EnergyPlus has written its own line on shading; closed when it ends.
  std::ostream* eio = nullptr;
  Session* session = nullptr;      // while EnergyPlus has one
  std::optional<Grounds> grounds;  // once they are known
  // By Session::recorded_receivers(), once they are known.
  std::vector<EnergyPlusFunctions::Irradiances> irradiances;
  std::string unwritten;  // why its output is not complete, "" where it is
};
Run& this_run();

// Where a session's messages go: this run's .err and .eio.
Messages messages_of(Run const& run);

// Ends EnergyPlus's run: with a fatal message, which is EnergyPlus's own way. An exception other
// than TaskDone is an error, printed and replied to a task.
[[noreturn]] void end_run(std::exception_ptr const& thrown);

// Calls `action`; our exceptions end EnergyPlus's run.
template <typename Action>
auto guarded(Action const& action) {
  std::exception_ptr thrown;
  try {
    return action();
  } catch (std::exception const&) {
    thrown = std::current_exception();
  }
  end_run(thrown);
}

// A function as EnergyPlus may call it: guarded.
template <auto function>
struct Guarded;
template <typename Result, typename... Arguments, Result (*function)(Arguments...)>
struct Guarded<function> {
  static Result call(Arguments... arguments) {
    return guarded([&] { return function(arguments...); });
  }
};

// While it lives, this thread's EnergyPlus does not write errors and warnings for which the
// function returns true, nor the lines that continue them. One at a time.
class UnwantedMessages {
 public:
  explicit UnwantedMessages(std::function<bool(std::string_view message)> unwanted);
  ~UnwantedMessages();
  UnwantedMessages(UnwantedMessages const&) = delete;
  UnwantedMessages& operator=(UnwantedMessages const&) = delete;
};

}  // namespace gpu_shading::energyplus
