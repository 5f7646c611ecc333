#pragma once

#include <algorithm>
#include <cstddef>
#include <exception>
#include <stdexcept>
#include <string>

// Helpers for the functions that our libraries export: they return 0, or 1 with the reason in one
// line.

#define EXPORTED __attribute__((visibility("default")))

[[noreturn]] inline void fail(std::string const& why) {
  throw std::runtime_error(why.empty() ? "no reason is given" : why);
}

// Runs an action that may throw; no exception leaves this function.
template <typename Action>
int guarded(char* message, std::size_t message_size, Action const& action) {
  std::string why = "unknown error";
  try {
    action();
    return 0;
  } catch (std::exception const& error) {
    why = error.what();
  } catch (...) {  // NOLINT(bugprone-empty-catch): the reason is set
  }
  constexpr unsigned char del = 0x7F;
  std::replace_if(
      why.begin(), why.end(), [](unsigned char c) { return c < ' ' || c == del; }, ' ');
  if (message_size == 0) return 1;
  message[why.copy(message, message_size - 1)] = '\0';
  return 1;
}
