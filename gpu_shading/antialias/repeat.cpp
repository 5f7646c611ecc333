#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "antialias/antialias.h"
#include "geometry/convex_area.h"
#include "geometry/ring.h"

namespace gpu_shading {
namespace {

// A surface with more is no blade.
constexpr std::size_t max_vertices = 8;
// The surfaces of a blade that is a box, and of a second one between it and the next.
constexpr SurfaceId max_between = 12;
// Of the difference of two coordinates in a file, m.
constexpr double rounding = 2e-5;

glm::dvec3 longest_side(Ring const& ring) {
  glm::dvec3 longest(0.0);
  for (std::size_t i = 0; i < ring.size(); ++i) {
    glm::dvec3 const edge = ring[(i + 1) % ring.size()] - ring[i];
    if (glm::dot(edge, edge) > glm::dot(longest, longest)) longest = edge;
  }
  return longest;
}

bool is_moved(Ring const& ring, Ring const& other, glm::dvec3 const& by, double slack) {
  if (other.size() != ring.size()) return false;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    glm::dvec3 const off = ring[i] - other[i] - by;
    if (glm::dot(off, off) > slack * slack) return false;
  }
  return true;
}

// Coordinates of files are rounded, by a share of a small step. The mean of many steps is not: of
// as many as are the same, in powers of two.
glm::dvec3 mean_step(Scene const& scene, SurfaceId id, SurfaceId back, glm::dvec3 step,
                     double slack) {
  constexpr SurfaceId max_steps = 1024;
  Ring const& ring = scene[id].polygon.outline;
  for (SurfaceId steps = 2; steps <= max_steps && steps * back <= id; steps *= 2) {
    Ring const& other = scene[id - steps * back].polygon.outline;
    if (!is_moved(ring, other, double(steps) * step, slack)) break;
    step = (ring[0] - other[0]) / double(steps);
  }
  return step;
}

}  // namespace

std::optional<Repeat> repeat_of(Scene const& scene, SurfaceId id) {
  Ring const& ring = scene[id].polygon.outline;
  if (ring.size() < 3 || ring.size() > max_vertices) return std::nullopt;
  glm::dvec3 const edge = longest_side(ring);
  for (SurfaceId back = 1; back <= std::min(id, max_between); ++back) {
    Ring const& other = scene[id - back].polygon.outline;
    if (other.size() != ring.size()) continue;
    glm::dvec3 const step = ring[0] - other[0];
    if (glm::length(step) <= 1e-6 * glm::length(edge)) continue;
    double const slack =
        std::min(std::max(rounding, 1e-6 * glm::length(edge)), 0.02 * glm::length(step));
    if (is_moved(ring, other, step, slack)) {
      glm::dvec3 const side = 0.5 * glm::cross(newell(ring), edge) / glm::dot(edge, edge);
      return Repeat{mean_step(scene, id, back, step, slack), edge, side};
    }
  }
  return std::nullopt;
}

SampledRepeats repeats_among(Scene const& scene, std::span<SurfaceId const> casters) {
  // A few casters suffice: blades that alias are many.
  constexpr std::size_t max_samples = 32;
  constexpr std::size_t min_casters = 8;
  SampledRepeats repeats;
  if (casters.size() < min_casters) return repeats;
  std::size_t const count = std::min(max_samples, casters.size());
  repeats.share = 1.0 / static_cast<double>(count);
  for (std::size_t i = 0; i < count; ++i) {
    auto const repeat = repeat_of(scene, casters[i * casters.size() / count]);
    if (repeat) repeats.found.push_back(*repeat);
  }
  return repeats;
}

std::optional<ReplicateSlopes> slopes_along(SampledRepeats const& blades, PlaneFrame const& frame,
                                            glm::dvec3 const& towards_sun) {
  constexpr double nearly_all = 0.99;
  if (blades.share * static_cast<double>(blades.found.size()) < nearly_all) return std::nullopt;
  // In the square that is turned.
  auto const slid = [&](glm::dvec3 const& vector) {
    glm::dvec3 const in_plane = vector - towards_sun * (glm::dot(frame.normal, vector) /
                                                        glm::dot(frame.normal, towards_sun));
    return glm::dvec2(glm::dot(frame.u, in_plane) / frame.width,
                      glm::dot(frame.v, in_plane) / frame.height);
  };
  auto const longest = std::ranges::max_element(
      blades.found, {}, [](Repeat const& each) { return glm::dot(each.edge, each.edge); });
  glm::dvec2 const edge = glm::normalize(slid(longest->edge));
  std::vector<double> distances;
  distances.reserve(blades.found.size());
  for (Repeat const& each : blades.found)
    distances.push_back(std::abs(cross(slid(each.step), edge)));
  // Most: gaps between groups of blades are farther.
  auto const most = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() * 3 / 4);
  std::ranges::nth_element(distances, most);
  constexpr double max_tilt = 0.125;
  if (!(*most > 0.0 && *most <= max_tilt)) return std::nullopt;
  double const angle = std::atan(edge.y / edge.x);
  // Of whole numbers of blades, rows have nearly their mean, but all of them the same error.
  auto const slope = [&](double passed) { return -std::tan(angle + passed * *most); };
  return ReplicateSlopes{slope(4.2), slope(-5.1), slope(7.3)};
}

}  // namespace gpu_shading
