#pragma once

#include <glm/vec3.hpp>
#include <unordered_map>

#include "gpu_shading/scene.h"
#include "render/receiver.h"
#include "render/tile_size.h"
#include "render/transmission.h"
#include "scene/casters.h"

namespace gpu_shading {

// The surfaces of a scene, which must outlive it, as receivers, laid out as they are asked for.
class Receivers {
 public:
  // `most`: pixels a side of any tile.
  Receivers(Scene const& scene, TileSize const& size, int most)
      : scene_(scene), size_(size), most_(most) {}

  // Throws Error when there is no such surface.
  Receiver const& operator[](SurfaceId id) { return find(id); }
  Surface const& surface(SurfaceId id) const;

  TileSize const& size() const { return size_; }
  // Pixels a side for what is in view. The receiver has to have an area.
  int side_for(Receiver const& receiver, InView const& in_view, bool screened) const;
  // Its address stays as long as this.
  Tile& tile(SurfaceId id, int side);
  // Of one that has turned out to have no pixels: its bounding rectangle's in place.
  void bound(SurfaceId id, Tile& tile);

 private:
  Receiver& find(SurfaceId id);

  Scene const& scene_;
  TileSize size_;
  int most_;
  std::unordered_map<SurfaceId, Receiver> receivers_;
};

}  // namespace gpu_shading
