#pragma once

#include <gtest/gtest.h>

#include <string>

#include "gpu_shading/error.h"

namespace gpu_shading {

// The message, always one line, of the Error that `action` throws; "accepted" if it throws none.
template <typename Action>
std::string refusal_of(Action const& action) {
  try {
    action();
  } catch (Error const& error) {
    std::string message = error.what();
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    return message;
  }
  return "accepted";
}

}  // namespace gpu_shading
