#pragma once

#include <filesystem>
#include <optional>

#include "program/model_run.h"
#include "samples/sample_parts.h"

namespace gpu_shading::energyplus {

// What is wanted of samples.
struct SampleTask {
  std::filesystem::path folder;
  // One share of one round is rendered; nothing is put together.
  std::optional<Shard> shard = std::nullopt;
  // What so many shards have rendered is put together; nothing is rendered.
  std::optional<int> merge = std::nullopt;
};

// The samples of a model that --gpu-shading-update sampled:... renders, without a year's run: into
// samples.csv, year.csv and samples.json, each written whole, the last last; what is rendered, into
// parts/ there. How densely, choices.update says. Throws Error.
void sample(ModelRun const& run, SampleTask const& task);

}  // namespace gpu_shading::energyplus
