#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace gpu_shading {

// Cuts a rectangle of a plane into trapezoids in which it does not matter where a point is, because
// no edge of a set of polygons passes through them. Between neighbouring heights at which an edge
// begins, ends or crosses another, edges are in one order from left to right. Areas of trapezoids
// are exact but for the rounding of double precision.
//
// Based on the plane sweep of Shamos & Hoey (1976), "Geometric intersection problems". Unlike that
// of Bentley & Ottmann (1979), it keeps no order from one strip to the next that a rounding error
// could upset: each strip is sorted by the middles of its edges, and crossings are looked for only
// where that is not the order at its ends.
class EdgeSweep {
 public:
  // A trapezoid between two heights, its sides from `low` to `high`.
  struct Cell {
    glm::dvec2 low_left;
    glm::dvec2 low_right;
    glm::dvec2 high_left;
    glm::dvec2 high_right;

    double area() const {
      return 0.5 * (low_right.x - low_left.x + high_right.x - high_left.x) *
             (high_left.y - low_left.y);
    }
    glm::dvec2 middle() const { return 0.25 * (low_left + low_right + high_left + high_right); }
  };

  // Begins anew. What is outside of the rectangle may be left out.
  void start(glm::dvec2 const& low, glm::dvec2 const& high);

  // A ring of a polygon that is known by a number, by the odd-even rule. Numbers count from 0.
  void add(std::span<glm::dvec2 const> ring, std::uint32_t polygon);

  // Steps that a sweep is expected to take, each of one edge in one strip, if no edges cross and
  // their ends are spread evenly. Only grows with what is added.
  double expected_steps() const { return strips_ * crossed_; }

  // Calls, for each strip from left to right, toggle(polygon, inside) at each edge, and cell(Cell)
  // between edges as long as wanted() says so. Polygons are left again, one after another, at the
  // end of a strip. False as soon as it seems to take more steps; what was called until then is to
  // be forgotten.
  template <typename Visitor>
  bool sweep(double most_steps, Visitor& visitor);

 private:
  struct Edge {
    double low;   // heights
    double high;  // above `low`
    double x;     // at `low`
    double slope;
    std::uint32_t polygon;

    double at(double height) const { return x + (height - low) * slope; }
  };
  // An edge in a strip.
  struct Crosser {
    std::uint32_t edge;
    std::uint32_t polygon;
    double low;  // x at both heights of the strip
    double high;

    double middle() const { return 0.5 * (low + high); }
  };

  // Finds the heights between which there are strips, and sorts edges.
  void prepare();
  // Places edges in a strip in their order from left to right.
  void place(double low, double high);
  bool in_order() const;
  // Appends the heights in a strip at which edges change places.
  void find_crossings(double low, double high);
  template <typename Visitor>
  void visit(double low, double high, Visitor& visitor);

  glm::dvec2 low_{0.0};
  glm::dvec2 high_{0.0};
  std::vector<Edge> edges_;
  std::vector<double> heights_;
  std::vector<Crosser> crossers_;  // of the strip
  std::vector<double> crossings_;  // heights within the strip
  std::vector<char> inside_;       // by polygon
  double strips_ = 1.0;
  double crossed_ = 0.0;  // mean number of edges at a height
};

template <typename Visitor>
void EdgeSweep::visit(double low, double high, Visitor& visitor) {
  std::size_t const count = crossers_.size();
  for (std::size_t i = 0; i < count; ++i) {
    Crosser const& edge = crossers_[i];
    char& inside = inside_[edge.polygon];
    inside = static_cast<char>(inside ^ 1);
    visitor.toggle(edge.polygon, inside != 0);
    if (i + 1 == count || !visitor.wanted()) continue;
    Crosser const& next = crossers_[i + 1];
    if (next.middle() <= edge.middle()) continue;
    visitor.cell(Cell{{edge.low, low}, {next.low, low}, {edge.high, high}, {next.high, high}});
  }
  for (Crosser const& edge : crossers_) {
    char& inside = inside_[edge.polygon];
    if (inside == 0) continue;
    inside = 0;
    visitor.toggle(edge.polygon, false);
  }
}

template <typename Visitor>
bool EdgeSweep::sweep(double most_steps, Visitor& visitor) {
  prepare();
  double steps = 0.0;
  std::size_t next = 0;
  crossers_.clear();
  for (std::size_t strip = 0; strip + 1 < heights_.size(); ++strip) {
    double const low = heights_[strip];
    double const high = heights_[strip + 1];
    std::erase_if(crossers_, [&](Crosser const& edge) { return edges_[edge.edge].high <= low; });
    for (; next < edges_.size() && edges_[next].low <= low; ++next) {
      if (edges_[next].high <= low) continue;
      crossers_.push_back({static_cast<std::uint32_t>(next), edges_[next].polygon, 0.0, 0.0});
    }
    auto const width = static_cast<double>(crossers_.size());
    steps += width;
    place(low, high);
    if (in_order()) {
      visit(low, high, visitor);
    } else {
      // Pairs are compared several at a time.
      constexpr double pairs_a_step = 8.0;
      steps += width * width / pairs_a_step;
      if (steps > most_steps) return false;
      find_crossings(low, high);
      steps += width * static_cast<double>(crossings_.size());
      if (steps > most_steps) return false;
      double from = low;
      for (std::size_t i = 0; i <= crossings_.size(); ++i) {
        double const to = i < crossings_.size() ? crossings_[i] : high;
        if (to <= from) continue;
        place(from, to);
        visit(from, to, visitor);
        from = to;
      }
    }
    // An eighth tells how many there will be.
    double const swept = (high - low_.y) / (high_.y - low_.y);
    if (8.0 * steps > most_steps && steps > most_steps * swept) return false;
  }
  return true;
}

}  // namespace gpu_shading
