#include "render/receivers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "gpu_shading/error.h"

namespace gpu_shading {
namespace {

// Sectors along each axis: even parts of t / (1 + |t|), t = sine / cosine being a tangent.
constexpr int sectors = 32;

int sector_of(double sine, double cosine) {
  double const share = sine / (cosine + std::abs(sine));
  return std::clamp(static_cast<int>(0.5 * (share + 1.0) * sectors), 0, sectors - 1);
}

// The tangent at which a sector begins: that of edge_on for the first, and beyond the last.
double start_of(int sector) {
  double const share = 2.0 * sector / sectors - 1.0;
  return share / std::max(1.0 - std::abs(share), edge_on);
}

// A receiver has its share of its rectangle's edges and pixels.
double share_of_rectangle(Receiver const& receiver) {
  return receiver.area / (receiver.frame->width * receiver.frame->height);
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
  if (receiver.frame) {
    receiver.outline.set(id, polygon, *receiver.frame, RelativePolygon::Side::within);
  }
  known = std::make_unique<Receiver>(std::move(receiver));
  return *known;
}

Receiver const& Receivers::window(SurfaceId id) {
  Receiver& receiver = find(id);
  receiver.is_window = true;
  return receiver;
}

std::span<RelativePolygon const> Receivers::behind(SurfaceId id,
                                                   std::span<SurfaceId const> interiors) {
  Receiver& receiver = find(id);
  auto& known = receiver.seen_through;
  auto const same = std::ranges::find_if(known, [&](auto const& other) {
    return std::ranges::equal(other, interiors, {}, &RelativePolygon::id);
  });
  if (same != known.end()) return *same;
  ++behind_;
  auto& added = known.emplace_back();
  for (SurfaceId const interior : interiors) {
    added.emplace_back(interior, surface(interior).polygon, *receiver.frame,
                       RelativePolygon::Side::behind);
  }
  return added;
}

Receiver::InSector const* Receivers::in_sector(SurfaceId id, glm::dvec3 const& towards_sun) {
  // A sector is found in the time of a few searches, and is asked about at other days again.
  constexpr std::size_t few = 100;
  Receiver& receiver = find(id);
  if (++receiver.times <= few) return nullptr;
  PlaneFrame const& frame = *receiver.frame;
  double const cosine = glm::dot(frame.normal, towards_sun);
  int const u = sector_of(glm::dot(frame.u, towards_sun), cosine);
  int const v = sector_of(glm::dot(frame.v, towards_sun), cosine);
  if (receiver.sectors.empty()) receiver.sectors.resize(std::size_t{sectors} * sectors);
  auto const row = std::size_t{sectors} * static_cast<std::size_t>(u);
  std::uint16_t& known = receiver.sectors[row + static_cast<std::size_t>(v)];
  if (known == Receiver::unknown) {
    known = search(id, {{start_of(u), start_of(v)}, {start_of(u + 1), start_of(v + 1)}});
  }
  return known == Receiver::many ? nullptr : &receiver.in_sectors[known - Receiver::first];
}

std::uint16_t Receivers::search(SurfaceId id, SunSector const& sector) {
  constexpr std::size_t most = std::size_t{1} << 18U;  // some 60 MB
  Receiver& receiver = find(id);
  auto positions =
      in_front_ > most ? std::nullopt : casters_.in_sector(scene_, id, *receiver.frame, sector);
  if (!positions) return Receiver::many;
  auto const same =
      std::ranges::find(receiver.in_sectors, *positions, &Receiver::InSector::positions);
  auto const number = static_cast<std::size_t>(same - receiver.in_sectors.begin());
  if (same == receiver.in_sectors.end()) {
    Receiver::InSector& added = receiver.in_sectors.emplace_back();
    for (std::uint32_t const position : *positions) {
      SurfaceId const caster = casters_.id(position);
      auto const [place, is_new] = receiver.in_front.try_emplace(caster);
      if (is_new) {
        ++in_front_;
        place->second.set(caster, scene_[caster].polygon, *receiver.frame,
                          RelativePolygon::Side::in_front);
      }
      added.polygons.push_back(&place->second);
      added.all_flat =
          added.all_flat && !casters_.is_warped(position) && !transmission_.any_body({&caster, 1});
      added.any_transmits = added.any_transmits || transmission_.transmits(caster);
    }
    added.positions = std::move(*positions);
  }
  return static_cast<std::uint16_t>(Receiver::first + number);
}

int Receivers::side_for(Receiver const& receiver, Detail const& detail, bool screened) const {
  double const share = share_of_rectangle(receiver);
  int const side = size_.side(detail.along / share, detail.across / share);
  return screened ? size_.side_with_screens(side) : side;
}

int Receivers::side_for(Receiver const& receiver, CrowdShadow const& crowd,
                        double interior_edges) const {
  double const share = share_of_rectangle(receiver);
  return size_.side_behind_crowd(crowd.area / share, crowd.thickness, interior_edges / share);
}

double Receivers::error_on_rectangle(Receiver const& receiver) const {
  return size_.error() * share_of_rectangle(receiver);
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

void Receivers::forget_many() {
  constexpr std::size_t many = 10000;
  if (tiles_ < many && behind_ < many + receivers_.size()) return;
  for (auto const& receiver : receivers_) {
    if (!receiver) continue;
    receiver->tiles.clear();
    receiver->seen_through.clear();
  }
  tiles_ = 0;
  behind_ = 0;
}

void Receivers::bound(SurfaceId id, Tile& tile) {
  tile = bounding_tile(surface(id).polygon, *find(id).frame, tile.side);
}

}  // namespace gpu_shading
