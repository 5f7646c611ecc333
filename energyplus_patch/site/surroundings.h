#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "gpu_shading/scene.h"
#include "input/input_object.h"
#include "input/screen_maker.h"

namespace gpu_shading::energyplus {

// A caster that EnergyPlus knows nothing of.
struct OutsideCaster {
  Surface surface;
  std::optional<TextureAxes> texture = std::nullopt;  // a mesh's own
};

// A neighbouring building, to see whether it is the model's own.
struct ContextBuilding {
  std::string name;
  Polygon roof;
  double base = 0.0;  // z, m
};

// What GPUShading:SiteContext and GPUShading:Geometry put about a model, in world axes.
struct Surroundings {
  std::vector<OutsideCaster> casters;
  // The casters' names, which several share, and the types of their objects.
  std::map<std::string, std::string> types;
  std::vector<ContextBuilding> buildings;
  std::vector<std::string> remarks;  // what each object put up, a line each
  std::vector<std::string> warnings;

  // In the scene, once they are there.
  SurfaceId first = 0;

  bool empty() const { return casters.empty(); }
  // Of a surface of the scene; nothing for those that are none of these.
  std::optional<TextureAxes> texture_of(SurfaceId surface) const;
};

// Reads every such object and its files. `folder`: where relative file names start. Names are upper
// case: "CONTEXT:FEATURE", "CONTEXT:TERRAIN", "GEOMETRY:MATERIAL:MESH". Throws Error, naming
// object, field and value, of files the feature or the place.
Surroundings read_surroundings(std::vector<InputObject> const& objects,
                               std::filesystem::path const& folder);

}  // namespace gpu_shading::energyplus
