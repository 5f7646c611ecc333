#include "routes/patched/entries/run.h"

#include <ostream>
#include <utility>

#include "platform/console.h"
#include "platform/error_line.h"
#include "platform/text.h"
#include "routes/patched/entries/entries.h"

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
    if (auto* const session = this_run().session; session != nullptr) session->fail();
  }
  installed.functions.fatal(*this_run().state, "gpu_shading: " + why);
}

namespace {

PointerTo<symbol::show_severe> original_show_severe = nullptr;
PointerTo<symbol::show_warning> original_show_warning = nullptr;
PointerTo<symbol::show_continue> original_show_continue = nullptr;

struct Silence {
  std::function<bool(std::string_view)> unwanted;  // empty: all are written
  bool active = false;                             // in a message that is not written
};

Silence& silence() {
  thread_local Silence instance;
  return instance;
}

bool begins_unwanted(std::string const& message) {
  auto& now = silence();
  now.active = now.unwanted && now.unwanted(message);
  return now.active;
}

void show_severe(State& state, std::string const& message, OtherFile first, OtherFile second) {
  if (!begins_unwanted(message)) original_show_severe(state, message, first, second);
}

void show_warning(State& state, std::string const& message, OtherFile first, OtherFile second) {
  if (!begins_unwanted(message)) original_show_warning(state, message, first, second);
}

void show_continue(State& state, std::string const& message, OtherFile first, OtherFile second) {
  if (!silence().active) original_show_continue(state, message, first, second);
}

}  // namespace

UnwantedMessages::UnwantedMessages(std::function<bool(std::string_view message)> unwanted) {
  silence() = {std::move(unwanted), false};
}

UnwantedMessages::~UnwantedMessages() { silence() = {}; }

std::vector<Entry> message_entries() {
  return {
      watch(symbol::show_severe, &show_severe, &original_show_severe),
      watch(symbol::show_warning, &show_warning, &original_show_warning),
      watch(symbol::show_continue, &show_continue, &original_show_continue),
  };
}

}  // namespace gpu_shading::energyplus
