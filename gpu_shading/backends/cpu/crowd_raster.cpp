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
using OfCorners = std::array<Lanes<double>, corners>;

struct Window {
  double columns = 0.0;
  double first_row = 0.0;
  double end_row = 0.0;
};

// Some casters, projected. Computed as area_in_front() does, to the bit.
struct Projected {
  alignas(64) OfCorners x;
  alignas(64) OfCorners y;
  alignas(64) OfCorners height;  // above the receiver's plane
  alignas(64) Lanes<double> least_height;
  alignas(64) Lanes<double> most_height;
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

[[gnu::always_inline]] inline double least_of(OfCorners const& values, std::size_t i) {
  return least(least(values[0][i], values[1][i]), least(values[2][i], values[3][i]));
}

[[gnu::always_inline]] inline double most_of(OfCorners const& values, std::size_t i) {
  return most(most(values[0][i], values[1][i]), most(values[2][i], values[3][i]));
}

// The index of the first pixel whose centre is beyond a position.
[[gnu::always_inline]] inline std::int32_t first_beyond(double position, double low, double high) {
  double const after_centre = least(most(position, low), high) + 0.5;
  return static_cast<std::int32_t>(after_centre);
}

[[gnu::always_inline]] inline void project(CrowdCorners const& from, View const& view,
                                           Window const& window, Projected& to) {
  // By value, for the compiler to take several lanes at a time.
  glm::dvec3 const origin = view.origin;
  glm::dvec4 const across = view.x;
  glm::dvec4 const up = view.y;
  glm::dvec4 const cut = view.cut;
  for (std::size_t corner = 0; corner < corners; ++corner) {
    auto const& at = from[corner];
    for (std::size_t i = 0; i < lanes; ++i) {
      double const x = at[0][i] - origin.x;
      double const y = at[1][i] - origin.y;
      double const z = at[2][i] - origin.z;
      to.x[corner][i] = x * across.x + y * across.y + z * across.z + across.w;
      to.y[corner][i] = x * up.x + y * up.y + z * up.z + up.w;
      to.height[corner][i] = x * cut.x + y * cut.y + z * cut.z;
    }
  }
  for (std::size_t i = 0; i < lanes; ++i) {
    double const left = least_of(to.x, i);
    double const right = most_of(to.x, i);
    double const low = least_of(to.y, i);
    double const high = most_of(to.y, i);
    to.least_height[i] = least_of(to.height, i);
    to.most_height[i] = most_of(to.height, i);
    to.first_row[i] = first_beyond(low, window.first_row, window.end_row);
    to.end_row[i] = first_beyond(high, window.first_row, window.end_row);
    to.first_column[i] = first_beyond(left - spare, 0.0, window.columns);
    to.end_column[i] = first_beyond(right + spare, 0.0, window.columns);
  }
}

// Of constant numbers, or the compiler takes one lane after another.
[[gnu::always_inline]] inline void find_edge(Projected& of, std::size_t edge, std::size_t next) {
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
  find_edge(of, 0, 1);
  find_edge(of, 1, 2);
  find_edge(of, 2, 3);
  find_edge(of, 3, 0);
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

// The pixels that boxes may meet, and how far they reach above the receiver's plane.
struct Met {
  alignas(64) Lanes<double> height;
  alignas(64) Lanes<std::int32_t> first_row;
  alignas(64) Lanes<std::int32_t> end_row;
  alignas(64) Lanes<std::int32_t> first_column;
  alignas(64) Lanes<std::int32_t> end_column;
};

// Boxes along a direction.
struct Extents {
  alignas(64) Lanes<double> middle;
  alignas(64) Lanes<double> reach;  // with what rounding may take
};

[[gnu::always_inline]] inline void extend(CrowdBoxes const& boxes, glm::dvec3 const& origin,
                                          glm::dvec4 const& along, Extents& to) {
  constexpr double rounding = 1e-12;
  double const abs_x = std::abs(along.x);
  double const abs_y = std::abs(along.y);
  double const abs_z = std::abs(along.z);
  for (std::size_t i = 0; i < lanes; ++i) {
    double const x = boxes.centre[0][i] - origin.x;
    double const y = boxes.centre[1][i] - origin.y;
    double const z = boxes.centre[2][i] - origin.z;
    double const reach =
        abs_x * boxes.reach[0][i] + abs_y * boxes.reach[1][i] + abs_z * boxes.reach[2][i];
    double const size = abs_x * std::abs(x) + abs_y * std::abs(y) + abs_z * std::abs(z) + reach;
    to.middle[i] = along.x * x + along.y * y + along.z * z + along.w;
    to.reach[i] = reach + rounding * size;
  }
}

[[gnu::always_inline]] inline void meet(CrowdBoxes const& boxes, View const& view,
                                        Window const& window, Met& met) {
  Extents row;
  Extents column;
  Extents height;
  extend(boxes, view.origin, view.y, row);
  extend(boxes, view.origin, view.x, column);
  extend(boxes, view.origin, {view.cut.x, view.cut.y, view.cut.z, 0.0}, height);
  for (std::size_t i = 0; i < lanes; ++i) {
    double const rows = row.reach[i] + 1e-6;
    double const columns = column.reach[i] + spare;
    met.height[i] = height.middle[i] + height.reach[i];
    met.first_row[i] = first_beyond(row.middle[i] - rows, window.first_row, window.end_row);
    met.end_row[i] = first_beyond(row.middle[i] + rows, window.first_row, window.end_row);
    met.first_column[i] = first_beyond(column.middle[i] - columns, 0.0, window.columns);
    met.end_column[i] = first_beyond(column.middle[i] + columns, 0.0, window.columns);
  }
}

template <typename T>
void prefetch(T const& object) {
  constexpr std::size_t line = 64;
  for (std::size_t at = 0; at < sizeof(T); at += line) {
    __builtin_prefetch(reinterpret_cast<char const*>(&object) + at);
  }
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
    : scene_(scene), casters_(casters), pieces_(pieces) {
  if (!casters.tree().nodes().empty()) root_ = add(0);
}

CrowdRaster::Node CrowdRaster::add(std::uint32_t of_tree) {
  auto const& tree = casters_.tree().nodes();
  if (tree[of_tree].count <= lanes) return add_leaf(tree[of_tree]);
  // Three levels of the binary tree, or fewer so that the branches below are full.
  std::uint32_t most = lanes;
  while (tree[of_tree].count > most * lanes) most *= lanes;
  std::vector<std::uint32_t> nodes{of_tree};
  for (std::size_t i = 0; i < nodes.size();) {
    if (tree[nodes[i]].count <= most) {
      ++i;
    } else {
      nodes[i] = tree[nodes[i]].children;
      nodes.insert(nodes.begin() + static_cast<std::ptrdiff_t>(i) + 1, nodes[i] + 1);
    }
  }
  auto const place = static_cast<Node>(branches_.size());
  branches_.emplace_back().count = static_cast<std::uint32_t>(nodes.size());
  for (std::size_t lane = 0; lane < nodes.size(); ++lane) {
    Node const child = add(nodes[lane]);
    Branch& branch = branches_[place];
    branch.children[lane] = child;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      branch.boxes.centre[axis][lane] = tree[nodes[lane]].centre[static_cast<int>(axis)];
      branch.boxes.reach[axis][lane] = tree[nodes[lane]].reach[static_cast<int>(axis)];
    }
  }
  return place;
}

CrowdRaster::Node CrowdRaster::add_leaf(Bvh::Node const& of_tree) {
  auto const place = static_cast<Node>(leaves_.size());
  Leaf& added = leaves_.emplace_back();
  added.first = of_tree.first;
  added.count = of_tree.count;
  for (std::uint32_t lane = 0; lane < added.count; ++lane) {
    std::uint32_t const position = added.first + lane;
    auto const found = pieces_.corners_of_only_piece(casters_.id(position));
    added.several[lane] = found.empty();
    added.only_turned_away[lane] = casters_.only_turned_away(position);
    for (std::size_t corner = 0; corner < found.size(); ++corner) {
      for (int axis = 0; axis < 3; ++axis) {
        added.corners[corner][static_cast<std::size_t>(axis)][lane] = found[corner][axis];
      }
    }
  }
  return leaf | place;
}

std::vector<CrowdRaster::Node> CrowdRaster::nodes(std::size_t count) const {
  std::vector<Node> found{root_};
  for (std::size_t before = 0; found.size() < count && found.size() > before;) {
    before = found.size();
    std::vector<Node> next;
    for (Node const node : found) {
      if ((node & leaf) != 0) {
        next.push_back(node);
      } else {
        auto const& children = branches_[node].children;
        next.insert(next.end(), children.begin(), children.begin() + branches_[node].count);
      }
    }
    found = std::move(next);
  }
  return found;
}

void CrowdRaster::darken(PixelMask& mask, int side, View const& pixels,
                         CrowdQuestion const& question, int threads) const {
  if (leaves_.empty()) return;
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
    return darken_below(search, root_);
  }
  // Several branches for each thread, far apart, so that all have about as much to do. Parts of the
  // rows instead would each meet the casters at their ends.
  auto const parts = static_cast<std::size_t>(threads);
  std::vector<Node> const roots = nodes(16 * parts);
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

void CrowdRaster::darken_below(Search& search, Node root) const {
  PixelMask const& mask = search.mask;
  // Casters are fetched from memory while those before them are rasterised.
  std::array<Leaf const*, 8> pending{};
  std::size_t fetched = 0;
  // Of at most 11 levels, all but one node of each.
  Node waiting[128];
  int count = 0;
  waiting[count++] = root;
  while (count > 0) {
    Node const next = waiting[--count];
    if ((next & leaf) != 0) {
      Leaf const& some = leaves_[next ^ leaf];
      prefetch(some);
      Leaf const* const before = std::exchange(pending[fetched++ % pending.size()], &some);
      if (before != nullptr) darken(search, *before);
      continue;
    }
    Branch const& branch = branches_[next];
    Met met;
    run<meet>(branch.boxes, search.pixels, search.window, met);
    for (std::uint32_t i = 0; i < branch.count; ++i) {
      int const rows = met.end_row[i] - met.first_row[i];
      int const columns = met.end_column[i] - met.first_column[i];
      if (met.height[i] <= coplanar || rows <= 0 || columns <= 0) continue;
      constexpr int few_words = 256;  // to look through
      if (rows * (columns / PixelMask::word_bits + 1) <= few_words &&
          !mask.any_lit(met.first_row[i], met.end_row[i], met.first_column[i], met.end_column[i])) {
        continue;
      }
      waiting[count++] = branch.children[i];
    }
  }
  for (Leaf const* const some : pending) {
    if (some != nullptr) darken(search, *some);
  }
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

void CrowdRaster::darken(Search& search, Leaf const& some) const {
  Projected projected;
  run<project>(some.corners, search.pixels, search.window, projected);
  bool found_edges = false;
  auto const one_by_one = [&](std::uint32_t position) {
    each_area(search, position, [&](ConvexArea const& area) { search.mask.darken(area); });
  };
  for (std::uint32_t i = 0; i < some.count; ++i) {
    std::uint32_t const position = some.first + i;
    if (some.several[i]) {
      one_by_one(position);
      continue;
    }
    if (projected.first_row[i] >= projected.end_row[i] ||
        projected.first_column[i] >= projected.end_column[i] ||
        projected.most_height[i] <= coplanar) {
      continue;
    }
    if (projected.least_height[i] <= 0.0) {
      one_by_one(position);
      continue;
    }
    if (!found_edges) run<find_edges>(projected);
    found_edges = true;
    if (projected.twice_area[i] == 0.0) continue;
    bool const asks = some.only_turned_away[i] || search.counted.by_rule();
    if (asks && !search.counted(position)) continue;
    search.mask.darken(area_of(projected, i, search.side));
  }
}

}  // namespace gpu_shading
