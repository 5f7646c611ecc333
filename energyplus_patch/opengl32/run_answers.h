#pragma once

#include <exception>
#include <functional>
#include <memory>

#include "gl_boundary/boundary_answers.h"

namespace gpu_shading::energyplus {

// What answers a new context of this process.
std::unique_ptr<BoundaryAnswers> answers_of_run();

// Ends the process with a line that says why. EnergyPlus would go on with wrong answers.
[[noreturn]] void end_run(std::exception const& error);

template <typename Action>
void or_end_run(Action const& action) {
  try {
    action();
  } catch (std::exception const& error) {
    end_run(error);
  }
}

}  // namespace gpu_shading::energyplus
