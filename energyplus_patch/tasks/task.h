#pragma once

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "reports/map_file.h"
#include "tasks/samples/direction_fractions.h"
#include "tasks/samples/sample_request.h"
#include "tasks/view_list.h"

namespace gpu_shading::energyplus {

// What the gpu_shading program wants of a model's surfaces in place of a simulation.

// A table of the surfaces (listing.h).
struct ListingTask {
  bool vertices = false;  // a table of their vertices instead
  bool json = false;      // as JSON; with vertices, the scene that is rendered (scene_document.h)

  bool operator==(ListingTask const&) const = default;
};

// Pictures into a folder, each under its view's name.
struct ViewsTask {
  std::vector<SunView> views;
  std::filesystem::path folder;
  int size = 0;  // pixels on a picture's longer side

  bool operator==(ViewsTask const&) const = default;
};

// Samples, at the density of --gpu-shading-update.
using SamplesTask = SampleRequest;

// Maps of sun hours and beam energy.
using MapTask = MapRequest;

// Sunlit fractions in some directions.
using DirectionsTask = DirectionsRequest;

using Task = std::variant<ListingTask, ViewsTask, SamplesTask, MapTask, DirectionsTask>;

// How it went.
struct TaskReply {
  std::string text;  // for the user
  std::vector<std::string> warnings;
  std::string error;  // why it could not be done; empty if it was

  bool operator==(TaskReply const&) const = default;
};

}  // namespace gpu_shading::energyplus
