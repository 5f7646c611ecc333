#include "backends/cpu/crowd_raster.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <span>
#include <tuple>
#include <utility>

#include "platform/instructions.h"
#include "platform/parallel.h"

namespace gpu_shading {
namespace {

constexpr std::size_t lanes = crowd_lanes;
constexpr std::size_t corners = std::tuple_size_v<CrowdCorners>;
// Columns by which an area may be wider than its corners, because spans are in single precision.
constexpr double spare = 1e-2;

template <typename T>
using Lanes = std::array<T, lanes>;

struct Window {
  double columns = 0.0;
  double first_row = 0.0;
  double end_row = 0.0;
};

// Some casters, projected. Computed as area_in_front() does, to the bit.
struct Projected {
  alignas(64) std::array<Lanes<double>, corners> x;
  alignas(64) std::array<Lanes<double>, corners> y;
  alignas(64) Lanes<double> least_height;  // above the receiver's plane
  alignas(64) Lanes<double> height;
  alignas(64) Lanes<std::int32_t> first_row;
  alignas(64) Lanes<std::int32_t> end_row;
  alignas(64) Lanes<std::int32_t> first_column;
  alignas(64) Lanes<std::int32_t> end_column;
  alignas(64) Lanes<double> twice_area;
  alignas(64) std::array<Lanes<float>, corners> start;  // by edge
  alignas(64) std::array<Lanes<float>, corners> slope;
  alignas(64) std::array<Lanes<std::int32_t>, corners> direction;  // upwards 1, downwards -1
};

[[gnu::always_inline]] inline double least(double a, double b) { return b < a ? b : a; }
[[gnu::always_inline]] inline double most(double a, double b) { return a < b ? b : a; }

// The index of the first pixel whose centre is beyond a position.
[[gnu::always_inline]] inline std::int32_t first_beyond(double position, double low, double high) {
  double const after_centre = least(most(position, low), high) + 0.5;
  return static_cast<std::int32_t>(after_centre);
}

[[gnu::always_inline]] inline void project(CrowdCorners const& from, View const& view,
                                           Window const& window, Projected& to) {
  for (std::size_t corner = 0; corner < corners; ++corner) {
    auto const& at = from[corner];
    for (std::size_t i = 0; i < lanes; ++i) {
      double const x = at[0][i] - view.origin.x;
      double const y = at[1][i] - view.origin.y;
      double const z = at[2][i] - view.origin.z;
      to.x[corner][i] = x * view.x.x + y * view.x.y + z * view.x.z + view.x.w;
      to.y[corner][i] = x * view.y.x + y * view.y.y + z * view.y.z + view.y.w;
      double const height = x * view.cut.x + y * view.cut.y + z * view.cut.z;
      to.least_height[i] = corner == 0 ? height : least(to.least_height[i], height);
      to.height[i] = corner == 0 ? height : most(to.height[i], height);
    }
  }
  for (std::size_t i = 0; i < lanes; ++i) {
    double const left = least(least(to.x[0][i], to.x[1][i]), least(to.x[2][i], to.x[3][i]));
    double const right = most(most(to.x[0][i], to.x[1][i]), most(to.x[2][i], to.x[3][i]));
    double const low = least(least(to.y[0][i], to.y[1][i]), least(to.y[2][i], to.y[3][i]));
    double const high = most(most(to.y[0][i], to.y[1][i]), most(to.y[2][i], to.y[3][i]));
    to.first_row[i] = first_beyond(low, window.first_row, window.end_row);
    to.end_row[i] = first_beyond(high, window.first_row, window.end_row);
    to.first_column[i] = first_beyond(left - spare, 0.0, window.columns);
    to.end_column[i] = first_beyond(right + spare, 0.0, window.columns);
  }
}

[[gnu::always_inline]] inline void find_edges(Projected& of) {
  for (std::size_t i = 0; i < lanes; ++i) {
    double const ax = of.x[1][i] - of.x[0][i];
    double const ay = of.y[1][i] - of.y[0][i];
    double const bx = of.x[2][i] - of.x[0][i];
    double const by = of.y[2][i] - of.y[0][i];
    double const cx = of.x[3][i] - of.x[0][i];
    double const cy = of.y[3][i] - of.y[0][i];
    of.twice_area[i] = (ax * by - ay * bx) + (bx * cy - by * cx);
  }
  for (std::size_t edge = 0; edge < corners; ++edge) {
    std::size_t const next = (edge + 1) % corners;
    for (std::size_t i = 0; i < lanes; ++i) {
      double const from_x = of.x[edge][i];
      double const from_y = of.y[edge][i];
      double const to_x = of.x[next][i];
      double const to_y = of.y[next][i];
      bool const upwards = (from_y < to_y) | ((from_y == to_y) & (from_x < to_x));
      double const low_x = upwards ? from_x : to_x;
      double const low_y = upwards ? from_y : to_y;
      double const high_x = upwards ? to_x : from_x;
      double const high_y = upwards ? to_y : from_y;
      constexpr double level = 1e-12;
      double const slope = (high_x - low_x) / most(high_y - low_y, level);
      of.start[edge][i] = static_cast<float>(low_x + (0.5 - low_y) * slope);
      of.slope[edge][i] = static_cast<float>(slope);
      bool const none = (from_x == to_x) & (from_y == to_y);
      of.direction[edge][i] = none ? 0 : upwards ? 1 : -1;
    }
  }
}

ConvexArea area_of(Projected const& projected, std::size_t lane, int side) {
  ConvexArea area;
  area.first_row = projected.first_row[lane];
  area.end_row = projected.end_row[lane];
  int const rightwards = projected.twice_area[lane] > 0.0 ? 1 : -1;
  std::size_t lefts = 0;
  std::size_t rights = 0;
  area.right.fill({static_cast<float>(side), 0.0F});
  for (std::size_t edge = 0; edge < corners; ++edge) {
    int const direction = projected.direction[edge][lane];
    RowLimit const limit{projected.start[edge][lane], projected.slope[edge][lane]};
    if (direction == rightwards) {
      area.right[rights++] = limit;
    } else if (direction != 0) {
      area.left[lefts++] = limit;
    }
  }
  area.limits = std::max(lefts, rights);
  return area;
}

constexpr std::uint32_t none = ~std::uint32_t{0};

// The upper nodes of a tree, down to those of few casters, in the order in which a search looks at
// them: the rest would lie between them.
std::vector<Bvh::Node> upper(std::vector<Bvh::Node> const& nodes) {
  std::vector<Bvh::Node> found;
  if (nodes.empty()) return found;
  found.push_back(nodes.front());
  std::vector<std::uint32_t> waiting{0};
  while (!waiting.empty()) {
    Bvh::Node& node = found[waiting.back()];
    waiting.pop_back();
    if (node.count <= lanes) continue;
    auto const place = static_cast<std::uint32_t>(found.size());
    auto const children = std::exchange(node.children, place);
    found.insert(found.end(), {nodes[children], nodes[children + 1]});
    waiting.insert(waiting.end(), {place, place + 1});
  }
  return found;
}

// Nodes of a tree that together have all of its casters, so many or more if the tree has them.
std::vector<std::uint32_t> branches(std::vector<Bvh::Node> const& nodes, std::size_t count) {
  std::vector<std::uint32_t> found{0};
  for (std::size_t before = 0; found.size() < count && found.size() > before;) {
    before = found.size();
    std::vector<std::uint32_t> next;
    for (std::uint32_t const node : found) {
      if (nodes[node].count <= lanes) {
        next.push_back(node);
      } else {
        next.insert(next.end(), {nodes[node].children, nodes[node].children + 1});
      }
    }
    found = std::move(next);
  }
  return found;
}

}  // namespace

struct CrowdRaster::Search {
  PixelMask& mask;
  int side;
  View const& pixels;
  Window window;
  Casters::Counted counted;
};

CrowdRaster::CrowdRaster(Scene const& scene, Casters const& casters, SurfacePieces const& pieces)
    : scene_(scene), casters_(casters), pieces_(pieces), nodes_(upper(casters.tree().nodes())) {
  blocks_.reserve(nodes_.size() / 2 + 1);
  for (Bvh::Node& node : nodes_) {
    if (node.count > lanes) continue;
    node.children = static_cast<std::uint32_t>(blocks_.size());
    Block& block = blocks_.emplace_back();
    for (std::uint32_t lane = 0; lane < node.count; ++lane) {
      std::uint32_t const position = node.first + lane;
      auto const found = pieces.corners_of_only_piece(casters.id(position));
      block.several[lane] = found.empty();
      block.only_turned_away[lane] = casters.only_turned_away(position);
      for (std::size_t corner = 0; corner < found.size(); ++corner) {
        for (int axis = 0; axis < 3; ++axis) {
          block.corners[corner][static_cast<std::size_t>(axis)][lane] = found[corner][axis];
        }
      }
    }
  }
}

void CrowdRaster::darken(PixelMask& mask, int side, View const& pixels,
                         CrowdQuestion const& question, int threads) const {
  if (nodes_.empty()) return;
  auto const search_in = [&](PixelMask& of) {
    return Search{of,
                  side,
                  pixels,
                  {static_cast<double>(mask.columns()), static_cast<double>(mask.first_row()),
                   static_cast<double>(mask.end_row())},
                  {casters_, scene_, question.receiver, question.towards_sun}};
  };
  if (threads <= 1) {
    Search search = search_in(mask);
    return darken_below(search, 0);
  }
  // Several branches for each thread, far apart, so that all have about as much to do. Parts of the
  // rows instead would each meet the casters at their ends.
  auto const parts = static_cast<std::size_t>(threads);
  std::vector<std::uint32_t> const roots = branches(nodes_, 16 * parts);
  std::vector<PixelMask> masks(parts, mask);
  // A thread that waits must not begin with another view, which would take the memory of this.
  tbb::this_task_arena::isolate([&] {
    for_each_index(parts, [&](std::size_t part) {
      Search search = search_in(masks[part]);
      for (std::size_t i = part; i < roots.size(); i += parts) darken_below(search, roots[i]);
    });
  });
  std::span<std::uint64_t> const lit = mask.words();
  for (PixelMask const& part : masks) {
    std::transform(lit.begin(), lit.end(), part.words().begin(), lit.begin(), std::bit_and());
  }
}

void CrowdRaster::darken_below(Search& search, std::uint32_t root) const {
  PixelMask const& mask = search.mask;
  View const& pixels = search.pixels;
  glm::dvec3 const x(pixels.x);
  glm::dvec3 const y(pixels.y);
  glm::dvec3 const normal(pixels.cut);
  glm::dvec3 const abs_x = glm::abs(x);
  glm::dvec3 const abs_y = glm::abs(y);
  glm::dvec3 const abs_normal = glm::abs(normal);
  // Casters are fetched from memory while those before them are rasterised.
  std::array<std::uint32_t, 8> pending;
  pending.fill(none);
  std::size_t fetched = 0;
  std::uint32_t waiting[64];
  int count = 0;
  waiting[count++] = root;
  while (count > 0) {
    std::uint32_t const next = waiting[--count];
    Bvh::Node const& node = nodes_[next];
    glm::dvec3 const centre = node.centre - pixels.origin;
    glm::dvec3 const size = glm::abs(centre) + node.reach;
    constexpr double rounding = 1e-12;
    double const height = glm::dot(normal, centre) + glm::dot(abs_normal, node.reach);
    if (height <= coplanar - rounding * glm::dot(abs_normal, size)) continue;
    double const row = glm::dot(y, centre) + pixels.y.w;
    double const rows = glm::dot(abs_y, node.reach) + rounding * glm::dot(abs_y, size) + 1e-6;
    int const first_row = first_beyond(row - rows, search.window.first_row, search.window.end_row);
    int const end_row = first_beyond(row + rows, search.window.first_row, search.window.end_row);
    if (first_row >= end_row) continue;
    double const column = glm::dot(x, centre) + pixels.x.w;
    double const columns = glm::dot(abs_x, node.reach) + rounding * glm::dot(abs_x, size) + spare;
    int const first_column = first_beyond(column - columns, 0.0, search.window.columns);
    int const end_column = first_beyond(column + columns, 0.0, search.window.columns);
    if (first_column >= end_column) continue;
    constexpr int few_words = 256;  // to look through
    int const words = (end_column - first_column) / PixelMask::word_bits + 1;
    if ((end_row - first_row) * words <= few_words &&
        !mask.any_lit(first_row, end_row, first_column, end_column)) {
      continue;
    }
    if (node.count <= lanes) {
      prefetch(blocks_[node.children]);
      darken_some(search, std::exchange(pending[fetched++ % pending.size()], next));
    } else {
      waiting[count++] = node.children;
      waiting[count++] = node.children + 1;
    }
  }
  for (std::uint32_t const leaf : pending) darken_some(search, leaf);
}

template <typename Use>
void CrowdRaster::each_area(Search const& search, std::uint32_t position, Use use) const {
  View const& pixels = search.pixels;
  if (!search.counted(position) ||
      !search.counted.is_in_front(position, pixels.origin, glm::dvec3(pixels.cut))) {
    return;
  }
  pieces_.each(casters_.id(position), pixels,
               [&](ProjectedPiece const& piece) { use(piece.area(search.side)); });
}

void CrowdRaster::prefetch(Block const& block) {
  constexpr std::size_t line = 64;
  for (std::size_t at = 0; at < sizeof(Block); at += line) {
    __builtin_prefetch(reinterpret_cast<char const*>(&block) + at);
  }
}

void CrowdRaster::darken_some(Search& search, std::uint32_t leaf) const {
  if (leaf == none) return;
  std::uint32_t const first = nodes_[leaf].first;
  std::uint32_t const count = nodes_[leaf].count;
  Block const& block = blocks_[nodes_[leaf].children];
  Projected projected;
  run<project>(block.corners, search.pixels, search.window, projected);
  bool found_edges = false;
  auto const one_by_one = [&](std::uint32_t position) {
    each_area(search, position, [&](ConvexArea const& area) { search.mask.darken(area); });
  };
  for (std::uint32_t i = 0; i < count; ++i) {
    std::uint32_t const position = first + i;
    if (block.several[i]) {
      one_by_one(position);
      continue;
    }
    if (projected.first_row[i] >= projected.end_row[i] ||
        projected.first_column[i] >= projected.end_column[i] || projected.height[i] <= coplanar) {
      continue;
    }
    if (projected.least_height[i] - clearance <= 0.0) {
      one_by_one(position);
      continue;
    }
    if (!found_edges) run<find_edges>(projected);
    found_edges = true;
    if (projected.twice_area[i] == 0.0) continue;
    bool const asks = block.only_turned_away[i] || search.counted.by_rule();
    if (asks && !search.counted(position)) continue;
    search.mask.darken(area_of(projected, i, search.side));
  }
}

}  // namespace gpu_shading
