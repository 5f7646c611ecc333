#pragma once

#include <filesystem>
#include <optional>

#include "programs/gpu_shading/model_run.h"
#include "tasks/samples/sample_parts.h"

namespace gpu_shading::energyplus {

// What to do with samples.
struct SampleTask {
  std::filesystem::path folder;
  // Render one share of one round; do not write tables.
  std::optional<Shard> shard = std::nullopt;
  // Write tables from the parts of this many shards; do not render.
  std::optional<int> merge = std::nullopt;
};

// Renders the samples of a model that --gpu-shading-update sampled:... uses, without a year's run,
// and writes samples.csv, year.csv and, last, samples.json, each completely or not at all; rendered
// parts are in parts/. choices.update sets the density. Throws Error.
void sample(ModelRun const& run, SampleTask const& task);

}  // namespace gpu_shading::energyplus
