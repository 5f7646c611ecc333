#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "files/asset_folder.h"
#include "gpu_shading/scene.h"
#include "model/idf/input_object.h"
#include "model/input/screen_maker.h"

namespace gpu_shading::energyplus {

// A caster that EnergyPlus does not know.
struct OutsideCaster {
  Surface surface;
  std::optional<TextureAxes> texture = std::nullopt;  // texture coordinates of a mesh
};

// A neighbouring building, to check whether it is the model's own.
struct ContextBuilding {
  std::string name;
  Polygon roof;
  double base = 0.0;  // z, m
};

// The casters of GPUShading:SiteContext and GPUShading:Geometry around a model, in world axes.
struct Surroundings {
  std::vector<OutsideCaster> casters;
  // The names of the casters, which several may share, and the types of their objects.
  std::map<std::string, std::string> types;
  std::vector<ContextBuilding> buildings;
  std::vector<std::string> remarks;  // a summary of each object, one line each
  std::vector<std::string> warnings;

  // Their surfaces in the scene, once they are added.
  SurfaceId first = 0;

  bool empty() const { return casters.empty(); }
  // The caster of a surface in the scene; empty for other surfaces.
  std::optional<TextureAxes> texture_of(SurfaceId surface) const;
};

// Reads every such object and its files. `folder`: where relative file names start. Names are in
// upper case: "CONTEXT:FEATURE", "CONTEXT:TERRAIN", "GEOMETRY:MATERIAL:MESH". Throws Error, naming
// object, field and value, and for errors in files the feature or the position.
Surroundings read_surroundings(std::vector<InputObject> const& objects, AssetFolder const& folder);

}  // namespace gpu_shading::energyplus
