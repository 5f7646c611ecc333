#pragma once

#include <filesystem>

#include "base/process.h"
#include "gl_boundary/session_answers.h"
#include "options/command_line.h"
#include "options/options.h"
#include "scheduled/hosted_run.h"

namespace gpu_shading::energyplus {

// A model as EnergyPlus is to read it, and what is known of it: PixelCounting, without extension
// objects and without surfaces that only cast shadows.
struct HostedModel {
  std::filesystem::path path;  // in a folder for this run
  SessionAnswers::Input input;
  RunMessages messages;
};

// Whether a model's shades have schedules, whose values at the time of a question are not known.
bool has_schedules(Model const& model);

// Reads the user's model.
Model read_hosted(std::filesystem::path const& path, Choices const& choices);

// Writes the model into `folder`, and has EnergyPlus list its surfaces. `line`: has a model. Throws
// Error.
HostedModel prepare_hosted(CommandLine const& line, Choices const& choices,
                           std::filesystem::path const& folder);

}  // namespace gpu_shading::energyplus
