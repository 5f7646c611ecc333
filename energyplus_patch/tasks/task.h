#pragma once

#include <filesystem>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "gpu_shading/polygon.h"
#include "gpu_shading/sun_direction.h"
#include "reports/sky_mask.h"
#include "runs/run_times.h"
#include "tasks/samples/take_samples.h"
#include "tasks/view_list.h"

namespace gpu_shading::energyplus {

// What the gpu_shading program wants of a model's surfaces in place of a simulation.

// A table of the surfaces.
struct ListingTask {
  bool vertices = false;  // a table of their vertices instead
  bool json = false;      // as JSON; with vertices, the scene that is rendered

  bool operator==(ListingTask const&) const = default;
};

// Pictures into a folder, each under its view's name.
struct ViewsTask {
  std::vector<SunView> views;
  std::filesystem::path folder;
  int size = 0;        // pixels on a picture's longer side
  bool range = false;  // outlines of moving shades at both ends of their range

  bool operator==(ViewsTask const&) const = default;
};

// Samples, at the density of --gpu-shading-update.
using SamplesTask = SampleRequest;

// Maps of sun hours and beam energy, and the file that they are written to.
struct MapTask {
  std::string receivers;  // a pattern of names; empty: all that EnergyPlus shades
  double spacing = 0.0;   // of the cells, m
  int rays_per_cell = 0;  // at each time
  RunTimes run;           // the times with the sun up, with the beam and the schedules
  std::filesystem::path file;
  int progress = -1;  // the file descriptor for progress; none if negative

  bool operator==(MapTask const&) const = default;
};

// What a cell gets in a period.
struct MapValue {
  double hours = 0.0;   // h, each weighted by what passes the shades
  double energy = 0.0;  // beam solar radiation, kWh/m2
};

// The map of one receiver: MapGrid(polygon, spacing) and the values of its cells.
struct ReceiverMap {
  std::string name;
  Polygon polygon;
  std::vector<MapValue> values;
};

// Sunlit fractions of all receivers, as if the sun stood in each of some directions, with schedules
// at their lowest value and screens fully deployed, and the file that they are written to.
struct DirectionsTask {
  std::vector<SunDirection> directions;
  std::filesystem::path file;

  bool operator==(DirectionsTask const&) const = default;
};

struct ReceiverFractions {
  SampledReceiver receiver;
  std::vector<double> fractions;  // by direction, 0 .. 1; 0 if it is behind the receiver
};

// What receivers see of the sky and of some positions of the sun, with schedules at their lowest
// value and screens fully deployed, and the file that it is written to.
struct MaskTask {
  std::string receivers;  // a pattern of names; empty: all windows, or all receivers without any
  int step = 0;           // of the sky's grid, degrees
  int rays = 0;           // from a receiver in each direction
  double spacing = 0.0;   // of a grid of points, m; 0: the receivers as a whole
  std::vector<SunDirection> suns;
  std::filesystem::path file;
  int progress = -1;  // the file descriptor for progress; none if negative

  bool operator==(MaskTask const&) const = default;
};

struct ReceiverMask {
  SampledReceiver receiver;
  std::optional<glm::dvec3> point;  // m; empty: of the whole receiver
  std::vector<BeamShare> sky;       // by cell of SkyGrid(step)
  // By sun. Sunlit fractions of whole receivers are rendered as EnergyPlus asks for them; what
  // stops the beam is by rays.
  std::vector<BeamShare> suns;
  std::vector<double> horizon = {};  // degrees, by column of SkyGrid(step)
};

// View factors of exterior surfaces to sky, ground and groups of surfaces, with schedules at their
// lowest value and screens fully deployed: EnergyPlus's objects with them, and a table.
struct SurroundingsTask {
  int rays = 0;                 // from a receiver
  std::filesystem::path file;   // .idf or .epJSON
  std::filesystem::path table;  // or empty
  int progress = -1;            // the file descriptor for progress; none if negative

  bool operator==(SurroundingsTask const&) const = default;
};

// Sunlit fractions of the cells of photovoltaic modules.
struct ModulesTask {
  RunTimes run;  // the times with the sun up, with the schedules
  // For an array of each surface, named 0, 1, ...: by time, then by cell, unsigned 16 bits, low
  // byte first; 65535 is sunlit.
  std::filesystem::path folder;
  std::filesystem::path file;
  int progress = -1;  // the file descriptor for progress; none if negative

  bool operator==(ModulesTask const&) const = default;
};

// View factors to a sky of uniform radiance.
struct ModuleSky {
  double view = 0.0;
  double unshaded = 0.0;
};

// The modules on one surface: ModuleLayout of the model's object and this polygon.
struct ModuleField {
  std::string object;  // name of the GPUShading:PVModules
  std::string surface;
  Polygon polygon;
  std::vector<ModuleSky> sky;  // by module
};

using Task = std::variant<ListingTask, ViewsTask, SamplesTask, MapTask, DirectionsTask, MaskTask,
                          ModulesTask, SurroundingsTask>;

// How it went.
struct TaskReply {
  std::string text;  // for the user
  std::vector<std::string> warnings;
  std::string error;  // why it could not be done; empty if it was

  bool operator==(TaskReply const&) const = default;
};

}  // namespace gpu_shading::energyplus
