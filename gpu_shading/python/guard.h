#pragma once

#include <fmt/format.h>

#include <exception>
#include <new>
#include <string>

#include "gpu_shading/error.h"
#include "python/calls.h"

namespace gpu_shading::python {

// What gpu_shading_message() returns on this thread.
std::string& message();

// While one exists, gpu_shading_close() waits.
class Running {
 public:
  Running();
  ~Running();
  Running(Running const&) = delete;
  Running& operator=(Running const&) = delete;
};

bool is_closed();

// Runs an action that may throw; no exception leaves this function.
template <typename Action>
int guarded(Action const& action) noexcept {
  auto const failed = [](Status status, char const* why) {
    try {
      message() = why;
    } catch (std::exception const&) {
      message().clear();
    }
    return status;
  };
  Running const running;
  if (is_closed()) return closed;
  try {
    action();
    // What stopped early has no results.
    return is_closed() ? closed : ok;
  } catch (DeviceError const& error) {
    return failed(device, error.what());
  } catch (Error const& error) {
    return failed(invalid, error.what());
  } catch (std::bad_alloc const&) {
    return failed(memory, "no memory is left");
  } catch (std::exception const& error) {
    return failed(unforeseen, error.what());
  } catch (...) {
    return failed(unforeseen, "unknown error");
  }
}

template <typename Object>
void release(Object* object) noexcept {
  Running const running;
  delete object;
}

// An enumerator from its number, 0 .. `last`.
template <typename Enumeration>
Enumeration enumerator(int number, Enumeration last, char const* what) {
  if (number < 0 || number > static_cast<int>(last)) {
    throw Error(fmt::format("{} is {}, expected 0 to {}", what, number, static_cast<int>(last)));
  }
  return static_cast<Enumeration>(number);
}

}  // namespace gpu_shading::python
