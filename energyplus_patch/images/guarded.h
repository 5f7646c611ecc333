#pragma once

#include <algorithm>
#include <cstddef>
#include <exception>
#include <stdexcept>
#include <string>

// What every function of libgpu_shading_images.so ends with: no exception leaves it.
[[noreturn]] inline void fail(std::string const& why) {
  throw std::runtime_error(why.empty() ? "OpenImageIO gives no reason" : why);
}

// Runs what may throw behind the C interface.
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
  std::replace(why.begin(), why.end(), '\n', ' ');
  if (message_size == 0) return 1;
  message[why.copy(message, message_size - 1)] = '\0';
  return 1;
}
