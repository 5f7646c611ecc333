#include "render/receivers.h"

#include <fmt/format.h>

#include "gpu_shading/error.h"

namespace gpu_shading {

Surface const& Receivers::surface(SurfaceId id) const {
  if (id < scene_.size()) return scene_[id];
  throw Error(fmt::format("there is no surface {}: the scene has {}", id, scene_.size()));
}

Receiver& Receivers::find(SurfaceId id) {
  auto const known = receivers_.find(id);
  if (known != receivers_.end()) return known->second;
  Polygon const& polygon = surface(id).polygon;
  Receiver receiver;
  receiver.area = area(polygon);
  if (receiver.area > 0.0) receiver.frame = plane_frame(polygon);
  return receivers_.emplace(id, std::move(receiver)).first->second;
}

int Receivers::side_for(Receiver const& receiver, InView const& in_view, bool screened) const {
  // The receiver has its share of the rectangle's edges and pixels.
  double const share = receiver.area / (receiver.frame->width * receiver.frame->height);
  Detail const& detail = in_view.detail;
  int const side = size_.side(detail.along / share, detail.across / share);
  return screened ? size_.side_with_screens(side) : side;
}

Tile& Receivers::tile(SurfaceId id, int side, TileLay const& lay) {
  Receiver& receiver = find(id);
  std::pair const kind(side, lay);
  auto const known = receiver.tiles.find(kind);
  if (known != receiver.tiles.end()) return known->second;
  Tile tile = make_tile(surface(id).polygon, *receiver.frame, side, most_, lay);
  return receiver.tiles.emplace(kind, std::move(tile)).first->second;
}

void Receivers::bound(SurfaceId id, Tile& tile) {
  tile = bounding_tile(surface(id).polygon, *find(id).frame, tile.side);
}

}  // namespace gpu_shading
