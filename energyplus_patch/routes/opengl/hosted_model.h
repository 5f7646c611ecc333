#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "model/options/options.h"
#include "routes/hosted_run.h"
#include "routes/opengl/queries/session_answers.h"
#include "runs/short_runs.h"
#include "tasks/asked_task.h"

namespace gpu_shading::energyplus {

// The user's model: what is known of it, and what EnergyPlus is to read instead, with PixelCounting
// and without extension objects and surfaces that only cast shadows.
struct HostedText {
  Model model;
  std::string text;
  std::shared_ptr<AskedTask> task;  // that EnergyPlus is run for, if it is
};

// The same, as EnergyPlus is to be run with it.
struct HostedModel {
  std::filesystem::path path;   // in a folder for this run
  SessionAnswers::Input input;  // without `named` where nothing is to be rendered
  RunMessages messages;
};

// Throws Error.
HostedText read_hosted(std::filesystem::path const& path, Choices const& choices);

// Writes the model into `folder`, and has EnergyPlus list its surfaces. `call`: with the user's
// model. Throws Error.
HostedModel prepare_hosted(HostedText read, EnergyPlusCall call,
                           std::filesystem::path const& folder);

}  // namespace gpu_shading::energyplus
