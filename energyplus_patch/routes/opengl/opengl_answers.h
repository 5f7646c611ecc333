#pragma once

#include <exception>
#include <functional>
#include <memory>

#include "routes/opengl/queries/boundary_answers.h"
#include "routes/opengl/queries/session_answers.h"

namespace gpu_shading::energyplus {

// What answers a new context of this process.
std::unique_ptr<BoundaryAnswers> answers_of_run();

// From now on, contexts are answered by one session, for a model that is known.
void answer_with(SessionAnswers::Input input);
// EnergyPlus has ended: the session says what it rendered. Throws Error.
void finish_answers();

// Replies to the task that EnergyPlus is run for, if there is one, that it cannot be done.
void fail_task(std::string const& why);

// Called while an exception is handled: prints it and ends the run, since EnergyPlus would go on
// with wrong answers. TaskDone ends it without a message. On Windows, that is the end of the
// process; elsewhere, an exception that EnergyPlus catches and reports.
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
