#pragma once

#include <algorithm>
#include <cstddef>
#include <exception>
#include <stdexcept>
#include <string>

#include "platform/text.h"

// Helpers for the functions that our libraries export: they return 0, or 1 with the reason in one
// line.

#define EXPORTED __attribute__((visibility("default")))

[[noreturn]] inline void fail(std::string const& why) {
  throw std::runtime_error(why.empty() ? "no reason is given" : why);
}

// Runs an action that may throw; no exception leaves this function. The reason in one line; "" if
// the action succeeds.
template <typename Action>
std::string failure_of(Action const& action) {
  std::string why = "unknown error";
  try {
    action();
    return {};
  } catch (std::exception const& error) {
    why = error.what();
  } catch (...) {  // NOLINT(bugprone-empty-catch): the reason is set
  }
  std::replace_if(why.begin(), why.end(), gpu_shading::energyplus::is_control, ' ');
  return why.empty() ? "no reason is given" : why;
}

// The same for an exported function: leaves the reason, cut to its size, in `message`.
template <typename Action>
int guarded(char* message, std::size_t message_size, Action const& action) {
  auto const why = failure_of(action);
  if (why.empty()) return 0;
  if (message_size > 0) message[why.copy(message, message_size - 1)] = '\0';
  return 1;
}
