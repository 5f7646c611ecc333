#include "routes/hosted_run.h"

#include <unistd.h>

#include <array>
#include <memory>
#include <utility>

#include "platform/c_interface.h"
#include "platform/console.h"
#include "platform/progress.h"
#include "platform/shared_library.h"

namespace gpu_shading::energyplus {
namespace {

// The C API, as in EnergyPlus/api/state.h, runtime.h and datatransfer.h.
using State = void*;

struct Api {
  explicit Api(std::filesystem::path const& path) {
    SharedLibrary const library(path);
    library.find("stateNew", new_state);
    library.find("stateDelete", delete_state);
    library.find("setEnergyPlusRootDirectory", set_root);
    library.find("energyplus", energyplus);
    library.find("issueWarning", issue_warning);
    library.find("issueText", issue_text);
    library.find("callbackBeginNewEnvironment", on_new_environment);
    library.find("registerProgressCallback", on_progress);
    library.find("month", month);
    library.find("dayOfMonth", day_of_month);
    library.find("dayOfYear", day_of_year);
    library.find("dayOfWeek", day_of_week);
    library.find("holidayIndex", holiday_index);
  }

  State (*new_state)() = nullptr;
  void (*delete_state)(State) = nullptr;
  void (*set_root)(State, char const*) = nullptr;
  int (*energyplus)(State, int, char const**) = nullptr;
  void (*issue_warning)(State, char const*) = nullptr;
  void (*issue_text)(State, char const*) = nullptr;
  void (*on_new_environment)(State, void (*)(State)) = nullptr;
  void (*on_progress)(State, void (*)(int)) = nullptr;
  int (*month)(State) = nullptr;
  int (*day_of_month)(State) = nullptr;
  int (*day_of_year)(State) = nullptr;
  int (*day_of_week)(State) = nullptr;
  int (*holiday_index)(State) = nullptr;
};

// The run of this thread, for callbacks, which receive none of our data.
struct Hosted {
  Api const* api = nullptr;
  State state = nullptr;
  RunMessages messages;  // not written yet
  std::optional<Progress> progress;
};

Hosted& hosted() {
  thread_local Hosted instance;
  return instance;
}

// EnergyPlus calls what follows: none of our exceptions may pass through it.
template <typename Action>
void print_failure(Action const& action) {
  auto const why = failure_of(action);
  if (!why.empty()) print_line("error: " + why);
}

void tell_messages(State /*state*/) {
  print_failure([] {
    auto const messages = std::exchange(hosted().messages, {});
    for (auto const& line : messages.warnings) warn_hosted_run(line);
    for (auto const& line : messages.remarks) tell_hosted_run(line);
  });
}

void show_progress(int percent) {
  print_failure([&] {
    if (hosted().progress) hosted().progress->at(static_cast<std::size_t>(percent));
  });
}

}  // namespace

int run_hosted(std::filesystem::path const& library, std::vector<std::string> const& arguments,
               RunMessages const& messages) {
  Api const api(library);
  auto& run = hosted();
  run.api = &api;
  run.messages = messages;
  // On a terminal, EnergyPlus's own lines show progress, unless they are redirected.
  constexpr std::size_t percent = 100;
  if (isatty(STDERR_FILENO) != 0 && isatty(STDOUT_FILENO) == 0) {
    run.progress.emplace("EnergyPlus", percent);
  }
  std::unique_ptr<void, void (*)(State)> const state(api.new_state(), api.delete_state);
  run.state = state.get();
  api.set_root(state.get(), library.parent_path().string().c_str());
  api.on_new_environment(state.get(), &tell_messages);
  api.on_progress(state.get(), &show_progress);
  std::vector<char const*> words{"energyplus"};
  for (auto const& argument : arguments) words.push_back(argument.c_str());
  int const status = api.energyplus(state.get(), static_cast<int>(words.size()), words.data());
  run.progress.reset();
  run.state = nullptr;
  return status;
}

void warn_hosted_run(std::string const& line) {
  auto const& run = hosted();
  if (run.state != nullptr) run.api->issue_warning(run.state, ("gpu_shading: " + line).c_str());
}

void tell_hosted_run(std::string const& line) {
  auto const& run = hosted();
  if (run.state != nullptr) run.api->issue_text(run.state, ("gpu_shading: " + line).c_str());
}

std::optional<HostedDay> hosted_day() {
  // As EnergyPlus numbers and names them.
  constexpr std::array<char const*, 13> types{
      "",          "Sunday",   "Monday",  "Tuesday",         "Wednesday",       "Thursday",
      "Friday",    "Saturday", "Holiday", "SummerDesignDay", "WinterDesignDay", "CustomDay1",
      "CustomDay2"};
  auto const& run = hosted();
  if (run.state == nullptr) return std::nullopt;
  auto const& api = *run.api;
  int const special = api.holiday_index(run.state);
  auto const type = static_cast<std::size_t>(special > 0 ? special : api.day_of_week(run.state));
  return HostedDay{api.month(run.state), api.day_of_month(run.state), api.day_of_year(run.state),
                   type < types.size() ? types.at(type) : ""};
}

}  // namespace gpu_shading::energyplus
