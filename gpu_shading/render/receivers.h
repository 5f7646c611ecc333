#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <glm/vec3.hpp>
#include <list>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <tuple>
#include <unordered_map>
#include <vector>

#include "filters/transmission.h"
#include "gpu_shading/scene.h"
#include "scene/casters.h"
#include "scene/relative_polygon.h"
#include "view/tile.h"
#include "view/tile_size.h"

namespace gpu_shading {

// Properties of a receiver that do not depend on the sun direction.
struct Receiver {
  std::optional<PlaneFrame> frame;  // empty if it has no area
  RelativePolygon outline;
  double area = 0.0;       // exact, m2
  bool is_window = false;  // a question was about surfaces behind it
  // The casters that may shade it from sectors of the sky.
  struct InSector {
    std::vector<std::uint32_t> positions;  // as Casters has them
    std::vector<RelativePolygon const*> polygons;
    bool all_flat = true;  // neither warped nor with a body
    bool any_transmits = false;
  };
  // The number of questions about it, and once they are many, the casters by sector: neighbours
  // have the same ones.
  std::size_t times = 0;
  static constexpr std::uint16_t unknown = 0;  // of `sectors`
  static constexpr std::uint16_t many = 1;
  static constexpr std::uint16_t first = 2;  // of `in_sectors`
  std::vector<std::uint16_t> sectors;
  std::deque<InSector> in_sectors;
  std::unordered_map<SurfaceId, RelativePolygon> in_front;  // that were in a sector
  // Of a window: the interior surfaces of each question about other ones.
  std::list<std::vector<RelativePolygon>> seen_through;
  // Tiles created so far, by requested resolution, slope and stretch.
  std::map<std::tuple<int, double, double>, Tile> tiles;
};

// The surfaces of a scene as receivers; scene and casters must outlive it. Their tiles are created
// when first needed.
class Receivers {
 public:
  // `max_side`: pixels of the largest tile.
  Receivers(Scene const& scene, Casters const& casters, Transmission const& transmission,
            TileSize const& size, int max_side)
      : scene_(scene),
        casters_(casters),
        transmission_(transmission),
        size_(size),
        max_side_(max_side),
        receivers_(scene.size()) {}

  // Throws Error if there is no such surface.
  Receiver const& operator[](SurfaceId id) { return find(id); }
  Receiver const& window(SurfaceId id);
  // What is behind the plane of a receiver that has one. Valid until forget_many().
  std::span<RelativePolygon const> behind(SurfaceId id, std::span<SurfaceId const> interiors);
  Surface const& surface(SurfaceId id) const;

  // Casters that include all in view of a receiver from this direction, which is in front of its
  // plane; null if they must be searched for.
  Receiver::InSector const* in_sector(SurfaceId id, glm::dvec3 const& towards_sun);

  TileSize const& size() const { return size_; }
  // Pixels per side for the detail in view. The receiver must have an area.
  int side_for(Receiver const& receiver, Detail const& detail, bool screened) const;
  // Behind a crowd, as of one that lies at random, with edges of interior surfaces so long, in
  // sides of the receiver's rectangle.
  int side_for(Receiver const& receiver, CrowdShadow const& crowd, double interior_edges) const;
  // The target error of a sunlit fraction, as one of the receiver's rectangle; 0 if the size of
  // tiles is fixed.
  double error_on_rectangle(Receiver const& receiver) const;
  // The address is valid until forget_many().
  Tile& tile(SurfaceId id, int side, TileLay const& lay);
  // Stretched tiles may be as many as directions, and lists of interior surfaces as many as
  // questions.
  void forget_many();
  // The tile of the bounding rectangle, for a receiver that turned out to have no pixels.
  void bound(SurfaceId id, Tile& tile);

 private:
  Receiver& find(SurfaceId id);
  // The number of a sector's casters, as Receiver::sectors has it.
  std::uint16_t search(SurfaceId id, SunSector const& sector);

  Scene const& scene_;
  Casters const& casters_;
  Transmission const& transmission_;
  TileSize size_;
  int max_side_;
  std::size_t tiles_ = 0;
  std::size_t in_front_ = 0;                          // polygons in front of all receivers
  std::size_t behind_ = 0;                            // lists of interior surfaces of all receivers
  std::vector<std::unique_ptr<Receiver>> receivers_;  // by id, once they are asked about
};

}  // namespace gpu_shading
