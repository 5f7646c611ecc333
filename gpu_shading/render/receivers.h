#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <tuple>
#include <unordered_map>
#include <vector>

#include "filters/transmission.h"
#include "gpu_shading/scene.h"
#include "scene/casters.h"
#include "view/tile.h"
#include "view/tile_size.h"

namespace gpu_shading {

// Properties of a receiver that do not depend on the sun direction.
struct Receiver {
  std::optional<PlaneFrame> frame;  // empty if it has no area
  double area = 0.0;                // exact, m2
  // How often it was asked about, and the casters by sector once that has been often.
  std::size_t times = 0;
  std::unordered_map<int, std::optional<std::vector<std::uint32_t>>> in_sectors;
  // Tiles created so far, by requested resolution, turn and stretch.
  std::map<std::tuple<int, std::size_t, double>, Tile> tiles;
};

// The surfaces of a scene as receivers; scene and casters must outlive it. Their tiles are created
// when first needed.
class Receivers {
 public:
  // `most`: maximum number of pixels per side of a tile.
  Receivers(Scene const& scene, Casters const& casters, TileSize const& size, int most)
      : scene_(scene), casters_(casters), size_(size), most_(most) {}

  // Throws Error if there is no such surface.
  Receiver const& operator[](SurfaceId id) { return find(id); }
  Surface const& surface(SurfaceId id) const;

  // Casters among which are all that are in view of a receiver in front of whose plane the sun is;
  // null if they are to be searched for.
  std::vector<std::uint32_t> const* in_sector(SurfaceId id, glm::dvec3 const& towards_sun);

  TileSize const& size() const { return size_; }
  // Pixels per side for the detail in view. The receiver must have an area.
  int side_for(Receiver const& receiver, Detail const& detail, bool screened) const;
  // The address is valid for the lifetime of this object.
  Tile& tile(SurfaceId id, int side, TileLay const& lay);
  // The tile of the bounding rectangle, for a receiver that turned out to have no pixels.
  void bound(SurfaceId id, Tile& tile);

 private:
  Receiver& find(SurfaceId id);

  Scene const& scene_;
  Casters const& casters_;
  TileSize size_;
  int most_;
  std::unordered_map<SurfaceId, Receiver> receivers_;
};

}  // namespace gpu_shading
