#include "scene/casters.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <utility>

#include "geometry/ring.h"
#include "scene/shadow.h"

namespace gpu_shading {
namespace {

// The largest distance of a vertex from the plane through the first.
double warp(Ring const& ring, glm::dvec3 const& unit_normal) {
  double farthest = 0.0;
  for (glm::dvec3 const& vertex : ring) {
    farthest = std::max(farthest, std::abs(glm::dot(vertex - ring[0], unit_normal)));
  }
  return farthest;
}

// A sheet on the receiver is in front of it by its body, if not by its polygon.
double body_above(BeamFilter::Faces const& faces, glm::dvec3 const& normal,
                  PlaneFrame const& frame) {
  double const middle = 0.5 * (faces.inside + faces.outside);
  return std::max(0.0, glm::dot(frame.normal, normal) * middle);
}

// With both faces of its body; empty where it cannot cast.
Box bounds_of(Surface const& surface) {
  Box box;
  if (surface.casting == Casting::never) return box;
  Ring const ring = without_repeats(surface.polygon.outline);
  glm::dvec3 const vector = newell(ring);
  if (ring.size() < 3 || is_degenerate(ring, vector)) return box;
  glm::dvec3 const normal = glm::normalize(vector);
  BeamFilter::Faces const faces = surface.filter.faces();
  for (glm::dvec3 const& vertex : ring) {
    box.include(vertex + faces.inside * normal);
    box.include(vertex + faces.outside * normal);
  }
  return box;
}

// Sorts distinct ids below `end`. Many of them are marked in a bitmap, which takes a fraction of
// the time of comparing them: with 32,000 casters in view that was an eighth of culling.
void sort_ids(std::vector<SurfaceId>& ids, std::size_t end) {
  constexpr std::size_t word_bits = 64;
  std::size_t const words = end / word_bits + 1;
  if (ids.size() < words) {
    std::ranges::sort(ids);
    return;
  }
  static thread_local std::vector<std::uint64_t> marks;
  marks.assign(words, 0);
  for (SurfaceId const id : ids) marks[id / word_bits] |= std::uint64_t{1} << id % word_bits;
  auto next = ids.begin();
  for (std::size_t word = 0; word < words; ++word) {
    for (std::uint64_t rest = marks[word]; rest != 0; rest &= rest - 1) {
      *next++ =
          static_cast<SurfaceId>(word * word_bits) + static_cast<SurfaceId>(std::countr_zero(rest));
    }
  }
}

}  // namespace

Casters::Casters(Scene const& scene) {
  std::vector<Box> boxes;
  boxes.reserve(scene.size());
  for (SurfaceId id = 0; id < scene.size(); ++id) boxes.push_back(bounds_of(scene[id]));
  tree_ = Bvh(boxes);
  casters_.reserve(tree_.order().size());
  kinds_.reserve(tree_.order().size());
  position_of_.resize(scene.size(), no_position);
  for (SurfaceId const id : tree_.order()) {
    position_of_[id] = static_cast<std::uint32_t>(casters_.size());
    add(id, scene[id]);
    Kind& kind = kinds_.emplace_back();
    if (!scene.rule().empty()) kind.role = scene.rule().roles[id];
    kind.only_turned_away = scene[id].casting == Casting::turned_away;
  }
}

void Casters::add(SurfaceId id, Surface const& surface) {
  Ring const ring = without_repeats(surface.polygon.outline);
  Caster& caster = casters_.emplace_back();
  caster.id = id;
  caster.first = points_.size();
  caster.count = static_cast<std::uint32_t>(ring.size());
  caster.normal = glm::normalize(newell(ring));
  double const off = warp(ring, caster.normal);
  caster.planar = off <= 1e-6;
  caster.warped = off > 1e-3;  // more than models' coordinates are rounded by
  caster.faces = surface.filter.faces();
  points_.insert(points_.end(), ring.begin(), ring.end());
  caster.first_hole = holes_.size();
  caster.holes = surface.polygon.holes.size();
  holes_.insert(holes_.end(), surface.polygon.holes.begin(), surface.polygon.holes.end());
}

InView Casters::in_view(Scene const& scene, SurfaceId receiver, PlaneFrame const& frame,
                        glm::dvec3 const& towards_sun, std::vector<SurfaceId> reused) const {
  reused.clear();
  InView found{std::move(reused)};
  Shadow shadow(frame, towards_sun);
  Counted const counted(*this, scene, receiver, towards_sun);
  tree_.search([&](glm::dvec3 const& centre,
                   glm::dvec3 const& reach) { return shadow.classify(centre, reach); },
               [&](std::uint32_t first, std::uint32_t count, Containment containment) {
                 for (std::uint32_t i = first; i < first + count; ++i) {
                   bool const inside = containment == Containment::inside;
                   if (counted(i)) add_if_in_view(casters_[i], inside, frame, shadow, found);
                 }
               });
  sort_ids(found.casters, scene.size());
  return found;
}

std::optional<Crowd> Casters::crowd_in_view(Scene const& scene, SurfaceId receiver,
                                            PlaneFrame const& frame, glm::dvec3 const& towards_sun,
                                            std::size_t few, std::size_t max_sample) const {
  if (casters_.size() <= few) return std::nullopt;
  Shadow shadow(frame, towards_sun);
  auto const& nodes = tree_.nodes();
  // Nodes of one depth in the tree have equally many casters, give or take one.
  std::vector<std::uint32_t> level{0};
  std::size_t count = casters_.size();
  while (level.size() < max_sample && count > few) {
    std::vector<std::uint32_t> next;
    count = 0;
    for (std::uint32_t const parent : level) {
      for (std::uint32_t node = nodes[parent].children; node < nodes[parent].children + 2; ++node) {
        Bvh::Node const& child = nodes[node];
        if (shadow.classify(child.centre, child.reach) == Containment::outside) continue;
        next.push_back(node);
        count += child.count;
      }
    }
    level = std::move(next);
  }
  if (count <= few) return std::nullopt;
  Counted const counted(*this, scene, receiver, towards_sun);
  InView found;
  for (std::uint32_t const node : level) {
    std::uint32_t const middle = nodes[node].first + nodes[node].count / 2;
    if (counted(middle)) add_if_in_view(casters_[middle], false, frame, shadow, found);
  }
  Crowd crowd{std::move(found.casters),
              static_cast<double>(count) / static_cast<double>(level.size())};
  if (crowd.count() <= static_cast<double>(few)) return std::nullopt;
  std::ranges::sort(crowd.sample);
  return crowd;
}

std::optional<std::vector<std::uint32_t>> Casters::in_sector(Scene const& scene, SurfaceId receiver,
                                                             PlaneFrame const& frame,
                                                             SunSector const& sector) const {
  constexpr std::size_t max_count = 32;
  std::vector<std::uint32_t> positions;
  Counted const counted(*this, scene, receiver, frame.normal);
  SectorShadow const shadow(frame, sector);
  tree_.search(
      [&](glm::dvec3 const& centre, glm::dvec3 const& reach) {
        bool const wanted = positions.size() <= max_count && shadow.may_overlap(centre, reach);
        return wanted ? Containment::intersecting : Containment::outside;
      },
      [&](std::uint32_t position, std::uint32_t, Containment) {
        if (counted.at_some_sun(position)) positions.push_back(position);
      });
  if (positions.size() > max_count) return std::nullopt;
  std::ranges::sort(
      positions, [&](std::uint32_t a, std::uint32_t b) { return casters_[a].id < casters_[b].id; });
  return positions;
}

InView Casters::in_view_of(std::span<std::uint32_t const> positions, PlaneFrame const& frame,
                           glm::dvec3 const& towards_sun, std::vector<SurfaceId> reused) const {
  reused.clear();
  InView found{std::move(reused)};
  Shadow shadow(frame, towards_sun);
  for (std::uint32_t const position : positions) {
    if (!counts_at(position, towards_sun)) continue;
    add_if_in_view(casters_[position], false, frame, shadow, found);
  }
  return found;
}

void Casters::add_if_in_view(Caster const& caster, bool inside, PlaneFrame const& frame,
                             Shadow& shadow, InView& found) const {
  if (!inside && !is_in_view(caster, frame, shadow)) return;
  found.casters.push_back(caster.id);
  found.warped = found.warped || caster.warped;
}

Detail Casters::detail(std::span<SurfaceId const> in_view, PlaneFrame const& frame,
                       glm::dvec3 const& towards_sun, double enough) const {
  Detail detail;
  Shadow const shadow(frame, towards_sun);
  for (SurfaceId const id : in_view) {
    if (detail.total() >= enough) break;
    Caster const& caster = casters_[position_of_[id]];
    shadow.add_edges(points(caster), detail);
    for (Ring const& hole : holes(caster)) shadow.add_edges(hole, detail);
  }
  return detail;
}

CrowdShadow Casters::crowd_shadow(std::span<SurfaceId const> sample, PlaneFrame const& frame,
                                  glm::dvec3 const& towards_sun) const {
  Shadow const shadow(frame, towards_sun);
  double areas = 0.0;
  double squares = 0.0;
  double edges = 0.0;
  for (SurfaceId const id : sample) {
    auto const [area, longest_edge] = shadow.size(points(casters_[position_of_[id]]));
    areas += area;
    squares += area * area;
    edges += area * longest_edge;
  }
  if (areas == 0.0) return {};
  return {squares / areas, squares / edges};
}

bool Casters::is_in_view(Caster const& caster, PlaneFrame const& frame, Shadow& shadow) const {
  auto const ring = points(caster);
  bool const thick = caster.faces.inside != caster.faces.outside;
  double const body = body_above(caster.faces, caster.normal, frame);
  shadow.clear();
  bool clearly_in_front = false;
  bool cut = false;
  if (caster.faces.fills) {
    for (glm::dvec3 const& vertex : ring) {
      for (double const face : {caster.faces.inside, caster.faces.outside}) {
        glm::dvec3 const corner = vertex + face * caster.normal;
        double const height = height_above(frame, corner);
        clearly_in_front = clearly_in_front || height > coplanar;
        cut = cut || height <= 0.0;
        shadow.include(corner);
      }
    }
    return clearly_in_front && (cut || shadow.overlaps());
  }
  for (glm::dvec3 const& vertex : ring) {
    double const height = height_above(frame, vertex) + body;
    clearly_in_front = clearly_in_front || height > coplanar;
    if (height > 0.0) {
      shadow.include(vertex + caster.faces.inside * caster.normal);
      if (thick) shadow.include(vertex + caster.faces.outside * caster.normal);
    } else {
      cut = true;
    }
  }
  if (!clearly_in_front) return false;
  if (cut && thick) return true;
  if (cut && caster.planar) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      shadow.include_crossing(frame, ring[i], ring[(i + 1) % ring.size()]);
    }
  } else if (cut) {
    // Inner edges of triangles reach beyond the outline's own intersections.
    for (std::size_t i = 0; i < ring.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) shadow.include_crossing(frame, ring[i], ring[j]);
    }
  }
  return shadow.overlaps();
}

}  // namespace gpu_shading
