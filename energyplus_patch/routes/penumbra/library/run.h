#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/model_reader.h"
#include "model/options/options.h"

namespace gpu_shading::energyplus {

// One run of EnergyPlus, from its command line on. Nothing that EnergyPlus calls is handed a run,
// and EnergyPlus makes one from its beginning to its end on one thread; so this is the thread's.
struct SourceRun {
  bool wanted = false;
  Choices choices;
  std::string wrong;           // why the options cannot be used, "" if they can
  std::optional<Model> model;  // once it is read
};
SourceRun& source_run();

}  // namespace gpu_shading::energyplus
