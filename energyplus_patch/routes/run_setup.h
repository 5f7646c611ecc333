#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "model/model_reader.h"
#include "model/options/command_line.h"
#include "model/options/options.h"
#include "runs/short_runs.h"

namespace gpu_shading::energyplus {

// The start of a run, whatever the route of its sunlit fractions.
struct RunSetup {
  // Takes our flags out of a command line without the program's name, fills choices from the
  // environment and, if rendering is wanted, applies what holds for the process. Throws Error.
  explicit RunSetup(std::vector<std::string>& command);

  // Whether the model can be read before EnergyPlus reads it.
  bool has_model() const;

  // How to run EnergyPlus for the same model.
  EnergyPlusCall call(std::filesystem::path const& program) const;

  // EnergyPlus's own arguments, with this model in place of the user's.
  std::vector<std::string> arguments_for(std::filesystem::path const& model) const;

  Choices choices;                     // command line over environment
  bool wanted = false;                 // one of these asks for gpu_shading
  std::vector<std::string> arguments;  // EnergyPlus's own
  CommandLine line;                    // the same, read
};

// Throws Error for --gpu-shading-surroundings where its objects have not been written.
void refuse_surroundings(Choices const& choices);

// Reads a model's objects, and returns how EnergyPlus's text changes.
using TakeModel = std::function<Rewrite(std::vector<InputObject> objects, MentionFinder const&)>;

// The text that EnergyPlus is to read in place of a model's. Throws Error, naming the file where
// objects cannot be read.
std::string rewrite_idf_model(std::string const& text, std::filesystem::path const& path,
                              TakeModel const& take);
void rewrite_epjson_model(nlohmann::json& json, std::filesystem::path const& path,
                          TakeModel const& take);

// Creates the folders of --gpu-shading-cache and --gpu-shading-report. Throws Error, naming the
// option, if one of them cannot be written.
void prepare_folders(Options const& options, bool report);

}  // namespace gpu_shading::energyplus
