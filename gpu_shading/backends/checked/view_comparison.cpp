#include "backends/checked/view_comparison.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "view/tile.h"
#include "view/view.h"

namespace gpu_shading {
namespace {

// Length of a polygon's edges as the view has it, in pixels; of each, no more than fits on a tile.
double edges_of(Polygon const& polygon, View const& view, int side) {
  double const longest = std::sqrt(2.0) * side;
  double length = 0.0;
  auto const add = [&](Ring const& ring) {
    auto const place = [&](glm::dvec3 const& vertex) {
      glm::dvec3 const p = vertex - view.origin;
      return to_pixels({at(view.x, p), at(view.y, p)}, side);
    };
    for (std::size_t i = 0; i < ring.size(); ++i) {
      double const edge = glm::distance(place(ring[i]), place(ring[(i + 1) % ring.size()]));
      length += std::min(edge, longest);
    }
  };
  add(polygon.outline);
  for (Ring const& hole : polygon.holes) add(hole);
  return length;
}

double tolerance(double edges, std::uint64_t pixels) {
  auto const all = static_cast<double>(pixels);
  return std::sqrt(std::min(edges, all)) / all;
}

// Sums of the device and of the reference.
using Pair = std::array<double, 2>;

// By combination of schedules.
std::map<std::vector<std::pair<int, int>>, Pair> pairs_of(LuminanceSums const& device,
                                                          LuminanceSums const& reference) {
  std::map<std::vector<std::pair<int, int>>, Pair> pairs;
  pairs[{}] = {device.unscheduled, reference.unscheduled};
  for (auto const& [powers, sum] : device.scheduled) pairs[powers][0] = sum;
  for (auto const& [powers, sum] : reference.scheduled) pairs[powers][1] = sum;
  return pairs;
}

}  // namespace

double ViewDifference::severity() const {
  double const difference = std::abs(device - reference);
  return std::isnan(difference) ? std::numeric_limits<double>::infinity() : difference / tolerance;
}

ViewDifference compare(ReceiverView const& view, ViewSums const& device, ViewSums const& reference,
                       Scene const& scene, Transmission const& transmission) {
  int const side = view.tile->side;
  View const projection = view_in_front(*view.frame, view.tile->map, view.towards_sun);
  double edges = edges_of(scene[view.receiver].polygon, projection, side);
  auto const all = static_cast<double>(reference.receiver_pixels);
  auto const drawn = static_cast<double>(device.receiver_pixels);
  ViewDifference worst{"size", drawn / all, 1.0, tolerance(edges, reference.receiver_pixels)};
  // Without any pixel the view is asked for again, on a larger tile.
  if (worst.severity() > 1.0 || device.receiver_pixels == 0) return worst;
  for (SurfaceId const id : view.casters) edges += edges_of(scene[id].polygon, projection, side);
  for (SurfaceId const id : view.interiors) edges += edges_of(scene[id].polygon, projection, side);
  if (transmission.any_screen(view.casters)) edges = all;
  double const within = tolerance(edges, reference.receiver_pixels);
  worst = {"sunlit fraction", 0.0, 0.0, within};
  for (std::size_t i = 0; i < reference.parts.size(); ++i) {
    for (auto const& [powers, sums] : pairs_of(device.parts.at(i), reference.parts[i])) {
      ViewDifference const here{"sunlit fraction", sums[0] / drawn, sums[1] / all, within};
      if (here.severity() > worst.severity()) worst = here;
    }
  }
  return worst;
}

ViewKind::ViewKind(ReceiverView const& view, Transmission const& transmission)
    : interior_(view.through) {
  if (!view.transmits) return;
  screens_ = transmission.any_screen(view.casters);
  schedules_ = transmission.any_schedule(view.casters);
  shades_ = !screens_ && !schedules_;
}

std::string ViewKind::name() const {
  std::string casters = "opaque casters";
  if (shades_) casters = "transparent shades";
  if (screens_) casters = "perforated screens";
  if (schedules_) casters = (screens_ ? casters + " and " : "") + "transmittance schedules";
  return (interior_ ? "an interior behind " : "a receiver behind ") + casters;
}

}  // namespace gpu_shading
