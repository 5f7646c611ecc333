#include "geometry/odd_even.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace gpu_shading {
namespace {

using GridRing = std::vector<glm::ivec2>;

// Not vertical; from left to right.
struct Edge {
  glm::ivec2 from{0};
  glm::ivec2 to{0};

  double height(double x) const {
    double const share = (x - from.x) / (static_cast<double>(to.x) - from.x);
    return from.y + share * (static_cast<double>(to.y) - from.y);
  }
  // Exact at the ends.
  int rounded_height(int x) const {
    return x == to.x ? to.y : static_cast<int>(std::lround(height(x)));
  }
};

std::vector<Edge> edges_of(std::span<GridRing const> rings) {
  std::vector<Edge> edges;
  for (GridRing const& ring : rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      glm::ivec2 const& a = ring[i];
      glm::ivec2 const& b = ring[(i + 1) % ring.size()];
      if (a.x < b.x) edges.push_back({a, b});
      if (b.x < a.x) edges.push_back({b, a});
    }
  }
  return edges;
}

// 1 where the point is above the edge's line, -1 below, 0 on it. Exact.
int side_of(Edge const& edge, glm::ivec2 const& point) {
  std::int64_t const width = std::int64_t{edge.to.x} - edge.from.x;
  std::int64_t const rise = std::int64_t{edge.to.y} - edge.from.y;
  std::int64_t const area =
      width * (std::int64_t{point.y} - edge.from.y) - rise * (std::int64_t{point.x} - edge.from.x);
  return area > 0 ? 1 : area < 0 ? -1 : 0;
}

bool cross(Edge const& a, Edge const& b) {
  if (std::max(a.from.y, a.to.y) < std::min(b.from.y, b.to.y) ||
      std::max(b.from.y, b.to.y) < std::min(a.from.y, a.to.y)) {
    return false;
  }
  return side_of(a, b.from) * side_of(a, b.to) < 0 && side_of(b, a.from) * side_of(b, a.to) < 0;
}

glm::ivec2 crossing(Edge const& a, Edge const& b) {
  glm::dvec2 const along_a = glm::dvec2(a.to) - glm::dvec2(a.from);
  glm::dvec2 const along_b = glm::dvec2(b.to) - glm::dvec2(b.from);
  glm::dvec2 const between = glm::dvec2(b.from) - glm::dvec2(a.from);
  double const share = (between.x * along_b.y - between.y * along_b.x) /
                       (along_a.x * along_b.y - along_a.y * along_b.x);
  glm::dvec2 const point = glm::dvec2(a.from) + share * along_a;
  return {static_cast<int>(std::lround(point.x)), static_cast<int>(std::lround(point.y))};
}

void add_parts(std::vector<Edge>& parts, Edge const& edge, std::vector<glm::ivec2>& points) {
  std::ranges::sort(points, {}, &glm::ivec2::x);
  glm::ivec2 from = edge.from;
  for (glm::ivec2 const& point : points) {
    if (point.x <= from.x || point.x >= edge.to.x) continue;
    parts.push_back({from, point});
    from = point;
  }
  parts.push_back({from, edge.to});
}

// Edges cut where they cross others, sorted by where they begin.
std::vector<Edge> cut_at_crossings(std::vector<Edge> edges) {
  auto const begin_of = [](Edge const& edge) { return edge.from.x; };
  std::ranges::sort(edges, {}, begin_of);
  std::vector<std::vector<glm::ivec2>> points(edges.size());
  for (std::size_t i = 0; i < edges.size(); ++i) {
    for (std::size_t k = i + 1; k < edges.size() && edges[k].from.x < edges[i].to.x; ++k) {
      if (!cross(edges[i], edges[k])) continue;
      points[i].push_back(crossing(edges[i], edges[k]));
      points[k].push_back(points[i].back());
    }
  }
  std::vector<Edge> parts;
  parts.reserve(edges.size());
  for (std::size_t i = 0; i < edges.size(); ++i) add_parts(parts, edges[i], points[i]);
  std::ranges::sort(parts, {}, begin_of);
  return parts;
}

// Between two edges, with vertical sides.
struct Trapezoid {
  Edge bottom;
  Edge top;
  int left = 0;
  int right = 0;
};

// A sweep from left to right over edges that do not cross, sorted by where they begin: between two
// columns that have ends of edges, the inside lies between every other pair. That holds where edges
// coincide as well, and rounding can misplace no more than a sliver.
class Sweep {
 public:
  explicit Sweep(std::vector<Edge> edges) : edges_(std::move(edges)) {
    std::vector<int> columns;
    for (Edge const& edge : edges_) {
      columns.push_back(edge.from.x);
      columns.push_back(edge.to.x);
    }
    std::ranges::sort(columns);
    columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
    for (std::size_t i = 0; i + 1 < columns.size(); ++i) advance(columns[i], columns[i + 1]);
    if (!columns.empty()) close_all(columns.back());
  }

  std::vector<Trapezoid> trapezoids;

 private:
  using Pair = std::pair<std::size_t, std::size_t>;  // bottom and top, of edges_

  void advance(int column, int next) {
    std::erase_if(active_, [&](std::size_t edge) { return edges_[edge].to.x <= column; });
    while (waiting_ < edges_.size() && edges_[waiting_].from.x <= column) {
      active_.push_back(waiting_++);
    }
    double const middle = 0.5 * (static_cast<double>(column) + next);
    // They stay sorted but for those that are new.
    for (std::size_t i = 1; i < active_.size(); ++i) {
      for (std::size_t k = i;
           k > 0 && edges_[active_[k]].height(middle) < edges_[active_[k - 1]].height(middle);
           --k) {
        std::swap(active_[k], active_[k - 1]);
      }
    }
    std::map<Pair, int> open;
    for (std::size_t i = 0; i + 1 < active_.size(); i += 2) {
      Pair const pair(active_[i], active_[i + 1]);
      auto const before = open_.find(pair);
      open.emplace(pair, before == open_.end() ? column : before->second);
      if (before != open_.end()) open_.erase(before);
    }
    close_all(column);
    open_ = std::move(open);
  }

  void close_all(int column) {
    for (auto const& [pair, left] : open_) {
      trapezoids.push_back({edges_[pair.first], edges_[pair.second], left, column});
    }
    open_.clear();
  }

  std::vector<Edge> edges_;
  std::size_t waiting_ = 0;          // the first that is to the right
  std::vector<std::size_t> active_;  // from below
  std::map<Pair, int> open_;         // where each begins
};

// Triangulates trapezoids, whose sides have the corners of their neighbours as well.
class Mesher {
 public:
  explicit Mesher(std::vector<Trapezoid> const& trapezoids) {
    for (Trapezoid const& trapezoid : trapezoids) {
      for (int const x : {trapezoid.left, trapezoid.right}) {
        columns_[x].insert(trapezoid.bottom.rounded_height(x));
        columns_[x].insert(trapezoid.top.rounded_height(x));
      }
    }
    for (Trapezoid const& trapezoid : trapezoids) {
      fill_between(side(trapezoid, trapezoid.left), side(trapezoid, trapezoid.right));
    }
  }

  GridMesh mesh;

 private:
  // From below.
  std::vector<std::uint32_t> side(Trapezoid const& trapezoid, int x) {
    std::set<int> const& column = columns_[x];
    // Edges that meet may swap by rounding.
    auto const [low, high] =
        std::minmax({trapezoid.bottom.rounded_height(x), trapezoid.top.rounded_height(x)});
    std::vector<std::uint32_t> numbers;
    for (auto y = column.lower_bound(low); y != column.upper_bound(high); ++y) {
      numbers.push_back(number({x, *y}));
    }
    return numbers;
  }

  void fill_between(std::vector<std::uint32_t> const& left,
                    std::vector<std::uint32_t> const& right) {
    std::size_t i = 0;
    std::size_t j = 0;
    while (i + 1 < left.size() || j + 1 < right.size()) {
      bool const by_right = i + 1 == left.size() ||
                            (j + 1 < right.size() && height(right[j + 1]) <= height(left[i + 1]));
      mesh.indices.insert(mesh.indices.end(),
                          {left[i], right[j], by_right ? right[j + 1] : left[i + 1]});
      ++(by_right ? j : i);
    }
  }

  int height(std::uint32_t number) const { return mesh.points[number].y; }

  std::uint32_t number(glm::ivec2 const& point) {
    auto const [known, added] = numbers_.try_emplace(
        std::pair(point.x, point.y), static_cast<std::uint32_t>(mesh.points.size()));
    if (added) mesh.points.push_back(point);
    return known->second;
  }

  std::map<int, std::set<int>> columns_;  // corners, y by x
  std::map<std::pair<int, int>, std::uint32_t> numbers_;
};

}  // namespace

GridMesh triangulate_odd_even(std::span<GridRing const> rings) {
  return std::move(Mesher(Sweep(cut_at_crossings(edges_of(rings))).trapezoids).mesh);
}

}  // namespace gpu_shading
