#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "options/options.h"

namespace gpu_shading::energyplus {

// What is run, and how.
struct ModelRun {
  std::filesystem::path model;                                  // IDF or epJSON
  std::optional<std::filesystem::path> weather = std::nullopt;  // none: one of EnergyPlus's own
  Choices choices;
};

// Reads a model and its extensions, then has EnergyPlus hand over its surfaces; the `environment`
// ("NAME=value") tells our module to write `product` then and to end. EnergyPlus writes into
// `folder`. Returns the run's warnings of ours. Throws Error with every error of the model, or why
// there is no product.
std::vector<std::string> run_to_shading(ModelRun const& run,
                                        std::vector<std::string> const& environment,
                                        std::filesystem::path const& folder,
                                        std::filesystem::path const& product);

}  // namespace gpu_shading::energyplus
