#include "geometry/plane_frame.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>

#include "geometry/ring.h"

namespace gpu_shading {
namespace {

glm::dvec3 longest_edge(Ring const& ring) {
  glm::dvec3 longest(0.0);
  for (std::size_t i = 0; i < ring.size(); ++i) {
    glm::dvec3 const edge = ring[(i + 1) % ring.size()] - ring[i];
    // Among edges of equal length, the first one counts as the longest, whatever the last digit.
    constexpr double clearly = 1.0 + 1e-9;
    if (glm::dot(edge, edge) > clearly * glm::dot(longest, longest)) longest = edge;
  }
  return longest;
}

struct Span {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void include(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  double centre() const { return 0.5 * (low + high); }
  double length() const { return high - low; }
};

}  // namespace

std::optional<PlaneFrame> plane_frame(Polygon const& polygon) {
  glm::dvec3 const vector = newell(polygon.outline);
  if (is_degenerate(polygon.outline, vector)) return std::nullopt;
  Ring const& ring = polygon.outline;

  PlaneFrame frame;
  frame.normal = glm::normalize(vector);
  glm::dvec3 const edge = longest_edge(ring);
  frame.u = glm::normalize(edge - frame.normal * glm::dot(frame.normal, edge));
  frame.v = glm::cross(frame.normal, frame.u);

  Span along_u;
  Span along_v;
  double off_plane = 0.0;
  for (glm::dvec3 const& vertex : ring) {
    glm::dvec3 const p = vertex - ring[0];
    along_u.include(glm::dot(p, frame.u));
    along_v.include(glm::dot(p, frame.v));
    off_plane += glm::dot(p, frame.normal) / static_cast<double>(ring.size());
  }
  frame.origin =
      ring[0] + frame.u * along_u.centre() + frame.v * along_v.centre() + frame.normal * off_plane;
  frame.width = along_u.length();
  frame.height = along_v.length();
  return frame;
}

}  // namespace gpu_shading
