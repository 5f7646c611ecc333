#include "backends/cpu/coverage.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "geometry/triangulation.h"
#include "support/random_scene.h"
#include "support/shapes.h"

namespace gpu_shading {
namespace {

using Corners = std::vector<glm::dvec2>;

class Random {
 public:
  explicit Random(std::uint32_t seed) : generator_(seed) {}
  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(generator_()) / std::mt19937::max();
  }
  glm::dvec2 place(double low, double high) { return {between(low, high), between(low, high)}; }

 private:
  std::mt19937 generator_;
};

double side_of(glm::dvec2 const& a, glm::dvec2 const& b, glm::dvec2 const& p) {
  return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

// Whether a point is in a convex ring, either way round; empty if too near an edge to tell.
std::optional<bool> holds(Corners const& ring, glm::dvec2 const& p) {
  bool left = true;
  bool right = true;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    glm::dvec2 const& a = ring[i];
    glm::dvec2 const& b = ring[(i + 1) % ring.size()];
    double const distance = side_of(a, b, p) / glm::length(b - a);
    if (std::abs(distance) < 1e-3) return std::nullopt;
    (distance > 0.0 ? right : left) = false;
  }
  return left || right;
}

bool is_lit(PixelMask const& mask, int side, int column, int row) {
  auto const stride = static_cast<std::size_t>((side + 63) / 64);
  std::size_t const word =
      static_cast<std::size_t>(row) * stride + static_cast<std::size_t>(column / 64);
  return (mask.words()[word] >> static_cast<unsigned>(column % 64) & 1U) != 0;
}

Corners random_ring(Random& random, int side) {
  // Corners of an ellipse, some of them far outside the tile.
  glm::dvec2 const middle = random.place(-0.3 * side, 1.3 * side);
  double const wide = std::pow(10.0, random.between(-1.5, 1.0)) * side;
  double const tall = std::pow(10.0, random.between(-3.0, 0.0)) * side;
  double const turn = random.between(0.0, 3.2);
  int const count = random.between(0.0, 1.0) < 0.5 ? 3 : 4;
  Corners ring;
  for (int i = 0; i < count; ++i) {
    double const angle = 6.283 * (i + random.between(0.0, 0.8)) / count;
    glm::dvec2 const p(wide * std::cos(angle), tall * std::sin(angle));
    ring.push_back(middle + glm::dvec2(p.x * std::cos(turn) - p.y * std::sin(turn),
                                       p.x * std::sin(turn) + p.y * std::cos(turn)));
  }
  if (random.between(0.0, 1.0) < 0.5) std::reverse(ring.begin(), ring.end());
  return ring;
}

TEST(PixelMask, HoldsThePixelsWhoseMiddlesAreInAnArea) {
  Random random(1);
  std::size_t inside = 0;
  std::size_t asked = 0;
  for (int const side : {64, 96, 100, 257}) {
    for (int i = 0; i < 150; ++i) {
      Corners const ring = random_ring(random, side);
      PixelMask mask;
      mask.start(side, 0, side);
      mask.light(area_within(ring, side));
      std::uint64_t lit = 0;
      for (int row = 0; row < side; ++row) {
        for (int column = 0; column < side; ++column) {
          bool const got = is_lit(mask, side, column, row);
          lit += got ? 1 : 0;
          auto const expected = holds(ring, {column + 0.5, row + 0.5});
          if (!expected) continue;
          ++asked;
          inside += *expected ? 1 : 0;
          ASSERT_EQ(got, *expected) << side << ' ' << i << ' ' << column << ' ' << row;
        }
      }
      EXPECT_EQ(mask.lit(), lit);
      mask.darken(area_within(ring, side));
      EXPECT_EQ(mask.lit(), 0U);
    }
  }
  EXPECT_GT(inside, asked / 20);
  EXPECT_LT(inside, asked / 2);
}

TEST(PixelMask, CutsWhatIsBehindAPlane) {
  Random random(2);
  constexpr int side = 128;
  std::size_t cut = 0;
  for (int i = 0; i < 300; ++i) {
    Corners const ring = random_ring(random, side);
    // In front is the left of a line.
    glm::dvec2 const a = random.place(0, side);
    glm::dvec2 const b = random.place(0, side);
    std::vector<double> distances;
    for (glm::dvec2 const& corner : ring) distances.push_back(side_of(a, b, corner));
    PixelMask mask;
    mask.start(side, 0, side);
    mask.light(area_in_front(ring, distances, side));
    for (int row = 0; row < side; ++row) {
      for (int column = 0; column < side; ++column) {
        glm::dvec2 const middle(column + 0.5, row + 0.5);
        auto const within = holds(ring, middle);
        double const distance = side_of(a, b, middle) / glm::length(b - a);
        if (!within || std::abs(distance) < 1e-3) continue;
        cut += *within && distance < 0.0 ? 1 : 0;
        ASSERT_EQ(is_lit(mask, side, column, row), *within && distance > 0.0) << i;
      }
    }
  }
  EXPECT_GT(cut, 10000U);
}

// Points of a lattice that lie on middles of pixels, on their corners and along rows, joined to
// triangles that cover a square: the hardest case for a pixel to be in one of them alone.
TEST(PixelMask, AreasWithEdgesInCommonShareNoPixelAndLoseNone) {
  constexpr int side = 100;
  for (double const step : {0.5, 2.5, 7.0, 12.5, 100.0 / 7}) {
    std::vector<PixelMask> masks;
    auto const add = [&](Corners const& ring) {
      masks.emplace_back().start(side, 0, side);
      masks.back().light(area_within(ring, side));
    };
    auto const count = static_cast<int>(std::ceil(side / step)) + 2;
    auto const place = [&](int i, int k) {
      return glm::dvec2((i - 1) * step + 0.25 * k, (k - 1) * step + 0.125 * i);
    };
    if (count > 60) continue;
    for (int i = -10; i < count + 10; ++i) {
      for (int k = -10; k < count + 10; ++k) {
        Corners const square{place(i, k), place(i + 1, k), place(i + 1, k + 1), place(i, k + 1)};
        if ((i + k) % 3 == 0) {
          add(square);
        } else {
          add({square[0], square[1], square[2]});
          add({square[2], square[3], square[0]});
        }
      }
    }
    for (int row = 0; row < side; ++row) {
      for (int column = 0; column < side; ++column) {
        auto const in = std::count_if(masks.begin(), masks.end(), [&](PixelMask const& mask) {
          return is_lit(mask, side, column, row);
        });
        ASSERT_EQ(in, 1) << step << ' ' << column << ' ' << row;
      }
    }
  }
}

TEST(ConvexPieces, CoverWhatTheTrianglesCover) {
  std::size_t triangles = 0;
  std::size_t pieces = 0;
  for (std::uint32_t seed = 1; seed <= 100; ++seed) {
    RandomScene const random = random_scene(seed);
    for (SurfaceId id = 0; id < random.scene.size(); ++id) {
      Mesh const mesh = triangulate(random.scene[id].polygon);
      double covered = 0.0;
      for (glm::uvec4 const& piece : convex_pieces(mesh)) {
        ++pieces;
        Ring ring;
        for (int i = 0; i < 4; ++i) ring.push_back(mesh.vertices[piece[i]]);
        if (piece[2] == piece[3]) ring.pop_back();
        covered += area({ring, {}});
      }
      triangles += mesh.indices.size() / 3;
      EXPECT_NEAR(covered, area(random.scene[id].polygon), 1e-9);
    }
  }
  EXPECT_LT(pieces, triangles * 3 / 4);
}

// Two triangles that are not in one plane stay two.
TEST(ConvexPieces, AreFlat) {
  Mesh const bent{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0.01}, {0, 1, 0}}, {0, 1, 2, 0, 2, 3}};
  EXPECT_EQ(convex_pieces(bent).size(), 2U);
  Mesh const flat{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {0, 1, 2, 0, 2, 3}};
  EXPECT_EQ(convex_pieces(flat).size(), 1U);
}

void expect_equal(RowSums const& a, RowSums const& b) {
  EXPECT_EQ(a.own, b.own);
  EXPECT_EQ(a.lit, b.lit);
  ASSERT_EQ(a.scheduled.size(), b.scheduled.size());
  for (std::size_t part = 0; part < a.scheduled.size(); ++part) {
    ASSERT_EQ(a.scheduled[part].size(), b.scheduled[part].size());
    for (std::size_t i = 0; i < a.scheduled[part].size(); ++i) {
      EXPECT_EQ(a.scheduled[part][i].powers, b.scheduled[part][i].powers);
      EXPECT_EQ(a.scheduled[part][i].sum, b.scheduled[part][i].sum);
    }
  }
}

// A window behind louvres, and a floor and a wall behind it.
struct Louvres {
  Louvres() {
    scene.add({"window", south_facing(0, 0, 0, 3, 2)});
    interiors.push_back(scene.add({"floor", level(-1, 0, -0.1, 5, 4)}));
    interiors.push_back(scene.add({"wall", south_facing(-1, 2, -1, 5, 4)}));
    for (int i = 0; i < 300; ++i) {
      casters.push_back(
          scene.add({"louvre", parallelogram({-0.2, -0.1, i / 150.0}, {3.4, 0, 0},
                                             {0, -0.005, i % 10 == 0 ? 0.02 : 0.002})}));
    }
  }

  // By samples of so many columns and rows.
  SampledView view(int side) const {
    PlaneFrame const frame = *plane_frame(scene[0].polygon);
    Tile const tile = make_tile(scene[0].polygon, frame, side, 4096);
    glm::dvec3 const towards_sun = to_vector(sun_at(170, 30));
    SampledView view;
    view.grid = {4 * side, side, 0.3, {0.2, 0.6}};
    view.outline = outline_on(tile, view.grid);
    view.in_front = in_pixels(view_in_front(frame, tile.map, towards_sun), view.grid);
    view.interiors = interiors;
    view.behind = in_pixels(view_behind(frame, tile.map, towards_sun, 1.0), view.grid);
    return view;
  }

  Scene scene;
  std::vector<SurfaceId> casters;
  std::vector<SurfaceId> interiors;
};

// Of so many transmittances, with schedules or without.
std::vector<Shade> shades_of(std::size_t louvres, int transmittances, bool scheduled) {
  std::vector<Shade> shades;
  shades.reserve(louvres);
  for (int i = 0; i < static_cast<int>(louvres); ++i) {
    shades.push_back({0.1F + 0.003F * static_cast<float>(i % transmittances),
                      scheduled ? i % 5 - 1 : Shade::unscheduled});
  }
  return shades;
}

TEST(Coverage, IsTheSameOnAnyNumberOfThreads) {
  Louvres const louvres;
  Coverage const coverage(triangulate_all(louvres.scene));
  for (int const transmittances : {0, 2, 7}) {
    for (bool const scheduled : {false, true}) {
      std::vector<Shade> shades;
      if (transmittances > 0) shades = shades_of(louvres.casters.size(), transmittances, scheduled);
      CastersInView const in_view{louvres.casters, shades, {}};
      bool const counted = can_be_counted(in_view);
      EXPECT_EQ(counted, transmittances < 7);
      for (int const side : {96, 512}) {
        SampledView view = louvres.view(side);
        for (bool const through : {false, true}) {
          view.through = through;
          RowSums const alone = coverage.rows(view, in_view, counted, 1);
          EXPECT_EQ(alone.parts(), through ? 2U : 1U);
          EXPECT_LT(total(alone.lit.front()), total(alone.own));
          for (int const threads : {2, 3, 7, 64}) {
            expect_equal(coverage.rows(view, in_view, counted, threads), alone);
          }
        }
      }
    }
  }
}

// What the interior surfaces of a closed room receive is what the window does, and luminance by
// counters is that of pixels.
TEST(Coverage, AddsUp) {
  Louvres const louvres;
  Coverage const coverage(triangulate_all(louvres.scene));
  for (bool const scheduled : {false, true}) {
    std::vector<Shade> const shades = shades_of(louvres.casters.size(), 2, scheduled);
    CastersInView const in_view{louvres.casters, shades, {}};
    SampledView view = louvres.view(128);
    RowSums const counted = coverage.rows(view, in_view, true, 1);
    RowSums const by_pixel = coverage.rows(view, in_view, false, 1);
    double const all = total(counted.own);
    ASSERT_EQ(counted.lit.size(), by_pixel.lit.size());
    for (std::size_t i = 0; i < counted.lit.size(); ++i) {
      EXPECT_NEAR(total(counted.lit[i]), total(by_pixel.lit[i]), 1e-6 * all);
    }
    view.through = true;
    RowSums const behind = coverage.rows(view, in_view, true, 1);
    for (std::size_t i = 0; i < counted.lit.size(); ++i) {
      EXPECT_NEAR(total(behind.lit[2 * i]) + total(behind.lit[2 * i + 1]), total(counted.lit[i]),
                  1e-9 * all);
    }
    if (!scheduled) continue;
    // The luminance with all schedules at 1 is that at 0 and the sum of all combinations.
    double sum = total(counted.lit.front());
    for (auto const& [powers, luminance] : counted.scheduled.front()) sum += luminance;
    EXPECT_NEAR(sum, total(counted.lit.back()), 1e-9 * all);
  }
}

}  // namespace
}  // namespace gpu_shading
