#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <optional>

#include "geometry/convex_area.h"

namespace gpu_shading {

// The outline of a part of a sheet, convex and with four corners, as rays of one direction pass it.
// Positions are in the sheet's plane, m.
class SheetOutline {
 public:
  static constexpr std::size_t corners = 4;
  using Places = std::array<glm::dvec2, corners>;

  // `ray_offset`: the displacement of the rays from the inside face to the outside face.
  SheetOutline(Places const& places, glm::dvec2 const& ray_offset) : places_(places) {
    double const hand = cross(places[2] - places[0], places[3] - places[1]) < 0.0 ? -1.0 : 1.0;
    for (std::size_t i = 0; i < corners; ++i) {
      edges_[i] = hand * (places[(i + 1) % corners] - places[i]);
      steps_[i] = cross(edges_[i], ray_offset);
    }
  }

  // A position's distance from an edge, times the edge's length; positive inside.
  double within(std::size_t edge, glm::dvec2 const& place) const {
    return cross(edges_[edge], place - places_[edge]);
  }
  // How much `within` changes over a distance, and from face to face.
  double change(std::size_t edge, glm::dvec2 const& by) const { return cross(edges_[edge], by); }
  double step(std::size_t edge) const { return steps_[edge]; }

  // From 0 at the inside face to 1 at the outside face.
  struct PathPart {
    double begin = 0.0;
    double end = 1.0;
  };
  // The part inside the outline of the path of a ray that passes the inside face at a position.
  // Outlines with a common edge overlap, so that nothing passes between them.
  std::optional<PathPart> part_within(glm::dvec2 const& place) const {
    PathPart part;
    for (std::size_t i = 0; i < corners; ++i) {
      constexpr double overlap = 1e-9;
      double const here = within(i, place) + overlap * glm::length(edges_[i]);
      double const last = here + steps_[i];
      if (here < 0.0 && last < 0.0) return std::nullopt;
      double const crossing = here / (here - last);
      if (here < 0.0) part.begin = std::max(part.begin, crossing);
      if (last < 0.0) part.end = std::min(part.end, crossing);
    }
    if (part.begin > part.end) return std::nullopt;
    return part;
  }

 private:
  Places const& places_;
  std::array<glm::dvec2, corners> edges_;  // counter-clockwise
  std::array<double, corners> steps_;
};

}  // namespace gpu_shading
