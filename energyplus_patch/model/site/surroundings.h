#pragma once

#include <filesystem>
#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "files/asset_folder.h"
#include "gpu_shading/map_coordinates.h"
#include "gpu_shading/scene.h"
#include "gpu_shading/terrain.h"
#include "model/extensions/field.h"
#include "model/idf/input_object.h"
#include "model/idf/mentions.h"
#include "model/input/screen_maker.h"
#include "model/input/shading_input.h"
#include "model/site/site_origin.h"

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

// The casters of GPUShading:SiteContext, GPUShading:Geometry and GPUShading:Tree around a model, in
// world axes.
struct Surroundings {
  std::vector<OutsideCaster> casters;
  // The names of the casters, which several may share, and the types of their objects.
  std::map<std::string, std::string> types;
  std::vector<ContextBuilding> buildings;
  // The shares of leaves that crowns have, by Crown::deployment: names of schedules, in upper case.
  std::vector<std::string> leaf_schedules;
  std::vector<std::string> remarks;  // a summary of each object, one line each
  std::vector<std::string> warnings;

  // Their surfaces in the scene, once they are added.
  SurfaceId first = 0;

  bool empty() const { return casters.empty(); }
  // The caster of a surface in the scene; empty for other surfaces.
  std::optional<TextureAxes> texture_of(SurfaceId surface) const;
};

// The extent of casters along the world axes.
class Extent {
 public:
  void include(Ring const& ring);

  // Distance in plan from the origin of the world axes to the bounding box; 0 if there are none.
  double distance() const;

  // "x -12.0 to 30.5, y 0.0 to 8.0, z 0.0 to 12.0 m".
  std::string describe() const;

 private:
  bool empty_ = true;
  glm::dvec3 low_{0.0};
  glm::dvec3 high_{0.0};
};

// Reads every such object and its files. `folder`: where relative file names start. `horizons`:
// whether buildings beyond a Radius are read. Names are in upper case: "CONTEXT:FEATURE",
// "CONTEXT:TERRAIN", "GEOMETRY:MATERIAL:MESH", "TREE:FEATURE". Throws Error, naming object, field
// and value, and for errors in files the feature or the position.
Surroundings read_surroundings(std::vector<InputObject> const& objects, AssetFolder const& folder,
                               bool horizons = true);

// Reads every GPUShading:SiteContext, terrain first, because buildings stand on the terrain of the
// same object. If the origin is to be at the terrain's elevation, that is determined here. Returns
// the terrains. Throws Error.
std::vector<TerrainGrid> read_site_contexts(std::vector<InputObject> const& objects,
                                            std::filesystem::path const& folder, bool horizons,
                                            SiteOrigin& origin, Surroundings& surroundings);

// Empty if the field is blank. Throws Error, naming field and value.
std::optional<MapCoordinates> read_map_coordinates(InputObject const& object,
                                                   Field<std::string> const& coordinates);

// Whether a GPUShading:Tree has a file.
bool needs_origin_for_trees(std::vector<InputObject> const& objects);

// Reads every GPUShading:Tree: a caster for each crown, whose rectangle is its plan, and the sides
// of its trunk. `origin`: for trees of files. Throws Error.
void read_trees(std::vector<InputObject> const& objects, std::filesystem::path const& folder,
                std::optional<SiteOrigin> const& origin, std::vector<TerrainGrid> const& terrains,
                Surroundings& surroundings);

// Whether a GPUShading:Geometry is placed by latitude and longitude.
bool needs_origin(std::vector<InputObject> const& objects);

// Reads every GPUShading:Geometry: a caster for each triangle, facing the side from which its
// texture is not mirrored. `origin`: for those placed by latitude and longitude. Throws Error.
void read_geometries(std::vector<InputObject> const& objects, AssetFolder const& folder,
                     std::optional<SiteOrigin> const& origin, Surroundings& surroundings);

// Map data usually contains the modelled building, which would then shade itself. Returns one line
// for each neighbouring building that contains a wall, roof or floor of the model, but at most
// `max` lines.
std::vector<std::string> warn_of_own_buildings(std::vector<ContextBuilding> const& buildings,
                                               Scene const& scene, ShadingInput const& input,
                                               std::size_t max = 3);

// The same for opaque Shading:Site and Shading:Building surfaces over all of the model: a roof that
// leaves it no sky. `transmitting`: names of surfaces that are not opaque, upper case.
std::vector<std::string> warn_of_covers(Scene const& scene, ShadingInput const& input,
                                        Names const& transmitting, std::size_t max = 3);

}  // namespace gpu_shading::energyplus
