#pragma once

#include <string>
#include <vector>

#include "model/idf/input_object.h"
#include "model/idf/mentions.h"

namespace gpu_shading::energyplus {

// The GPUShading:SurroundingGroup: what exterior surfaces exchange long-wave radiation with.
struct SurroundingGroup {
  std::string name;
  std::string surfaces;  // a name, a pattern, or a kind
  std::string schedule;  // of its temperature; "": outdoor air
  std::string where;     // for messages
};

// Beside the file of --gpu-shading-surrounding-objects: remarks, and warnings.
inline constexpr char const* surroundings_messages = "messages.txt";
// The names of the objects that `gpu_shading export --surroundings` writes begin with this.
inline constexpr std::string_view views_of = "GPU SHADING VIEWS OF ";

// In the model's order. Throws Error, naming object and field.
std::vector<SurroundingGroup> read_surrounding_groups(std::vector<InputObject> const& objects);

// The surfaces with a SurfaceProperty:LocalEnvironment of the model.
Names surfaces_with_environment(std::vector<InputObject> const& objects);
// Whether one of these has our view factors.
bool has_views(std::vector<InputObject> const& objects);

}  // namespace gpu_shading::energyplus
