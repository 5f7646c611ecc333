#include "render/receivers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "gpu_shading/error.h"

namespace gpu_shading {
namespace {

// Sectors along each axis: even parts of t / (1 + |t|), t being a tangent.
constexpr int sectors = 32;

int sector_of(double tangent) {
  double const share = tangent / (1.0 + std::abs(tangent));
  return std::clamp(static_cast<int>(0.5 * (share + 1.0) * sectors), 0, sectors - 1);
}

// The tangent at which a sector begins: that of edge_on for the first, and beyond the last.
double start_of(int sector) {
  double const share = 2.0 * sector / sectors - 1.0;
  return share / std::max(1.0 - std::abs(share), edge_on);
}

}  // namespace

Surface const& Receivers::surface(SurfaceId id) const {
  if (id < scene_.size()) return scene_[id];
  throw Error(fmt::format("there is no surface {}: the scene has {}", id, scene_.size()));
}

Receiver& Receivers::find(SurfaceId id) {
  Polygon const& polygon = surface(id).polygon;
  auto& known = receivers_[id];
  if (known) return *known;
  Receiver receiver;
  receiver.area = area(polygon);
  if (receiver.area > 0.0) receiver.frame = plane_frame(polygon);
  known = std::make_unique<Receiver>(std::move(receiver));
  return *known;
}

Receiver const& Receivers::window(SurfaceId id) {
  Receiver& receiver = find(id);
  receiver.is_window = true;
  return receiver;
}

std::vector<std::uint32_t> const* Receivers::in_sector(SurfaceId id,
                                                       glm::dvec3 const& towards_sun) {
  // A sector is found in the time of a few searches, and is asked about at other days again.
  constexpr std::size_t few = 100;
  Receiver& receiver = find(id);
  if (++receiver.times <= few) return nullptr;
  PlaneFrame const& frame = *receiver.frame;
  double const cosine = glm::dot(frame.normal, towards_sun);
  int const u = sector_of(glm::dot(frame.u, towards_sun) / cosine);
  int const v = sector_of(glm::dot(frame.v, towards_sun) / cosine);
  if (receiver.in_sectors.empty()) receiver.in_sectors.resize(std::size_t{sectors} * sectors);
  auto const row = std::size_t{sectors} * static_cast<std::size_t>(u);
  auto& known = receiver.in_sectors[row + static_cast<std::size_t>(v)];
  if (!known.searched) {
    SunSector const sector{{start_of(u), start_of(v)}, {start_of(u + 1), start_of(v + 1)}};
    known = {true, casters_.in_sector(scene_, id, frame, sector)};
  }
  return known.casters ? &*known.casters : nullptr;
}

int Receivers::side_for(Receiver const& receiver, Detail const& detail, bool screened) const {
  // The receiver has its share of the rectangle's edges and pixels.
  double const share = receiver.area / (receiver.frame->width * receiver.frame->height);
  int const side = size_.side(detail.along / share, detail.across / share);
  return screened ? size_.side_with_screens(side) : side;
}

Tile& Receivers::tile(SurfaceId id, int side, TileLay const& lay) {
  Receiver& receiver = find(id);
  std::tuple const kind(side, lay.slope, lay.stretch);
  auto const known = receiver.tiles.find(kind);
  if (known != receiver.tiles.end()) return known->second;
  Tile tile = make_tile(surface(id).polygon, *receiver.frame, side, max_side_, lay);
  ++tiles_;
  return receiver.tiles.emplace(kind, std::move(tile)).first->second;
}

void Receivers::forget_many_tiles() {
  constexpr std::size_t many = 10000;
  if (tiles_ < many) return;
  for (auto const& receiver : receivers_) {
    if (receiver) receiver->tiles.clear();
  }
  tiles_ = 0;
}

void Receivers::bound(SurfaceId id, Tile& tile) {
  tile = bounding_tile(surface(id).polygon, *find(id).frame, tile.side);
}

}  // namespace gpu_shading
