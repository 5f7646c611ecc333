#include "routes/patched/entries/unwanted_messages.h"

#include <string>
#include <utility>

#include "routes/patched/entries/entries.h"

namespace gpu_shading::energyplus {
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
