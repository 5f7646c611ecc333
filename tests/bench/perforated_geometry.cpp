#include <algorithm>
#include <array>
#include <cstdio>
#include <glm/geometric.hpp>
#include <memory>
#include <utility>

#include "gpu_shading/perforated_screen.h"
#include "perforated_tables.h"

namespace gpu_shading {
namespace {

constexpr int sides = 24;  // corners of the polygon that represents a hole

using Ring2 = std::vector<glm::dvec2>;

// A sheet from (0, 0) to (1, 1) in the tile's axes: cells with a hole and the solid part around it,
// front and back, and walls.
class SheetModel {
 public:
  explicit SheetModel(PerforatedCase const& given) : given_(given) {
    double const radius = given.hole / 2.0;
    // A polygon of equal area.
    double const corners = radius * std::sqrt(2.0 * std::numbers::pi / sides /
                                              std::sin(2.0 * std::numbers::pi / sides));
    for (int i = 0; i < sides; ++i) {
      double const angle = 2.0 * std::numbers::pi * (i + 0.5) / sides;
      rim_.push_back(corners * glm::dvec2(std::cos(angle), std::sin(angle)));
    }
    half_ = {given.pitch() / 2.0, std::sqrt(0.75) * given.pitch() / 2.0};
    scene_.add({"receiver", given.receiver});
    for (int row = 0; 2.0 * half_.y * row < 1.0 + half_.y; ++row) {
      double const offset = row % 2 == 0 ? 0.0 : half_.x;
      for (int i = -1; 2.0 * half_.x * i + offset < 1.0 + half_.x; ++i) {
        add_cell({2.0 * half_.x * i + offset, 2.0 * half_.y * row});
      }
    }
  }

  Scene take() { return std::move(scene_); }

 private:
  // The tile begins at the second corner of the case's sheet; u runs north.
  glm::dvec3 at(glm::dvec2 const& place, bool top) const {
    glm::dvec3 const& corner = given_.sheet.outline[1];
    return {corner.x - place.y, corner.y + place.x, corner.z + (top ? given_.thickness : 0.0)};
  }

  void add_faces(Ring2 const& outline, Ring2 const& hole) {
    for (bool const top : {false, true}) {
      Polygon face;
      for (glm::dvec2 const& place : outline) face.outline.push_back(at(place, top));
      if (!hole.empty()) face.holes.emplace_back();
      for (glm::dvec2 const& place : hole) face.holes[0].push_back(at(place, top));
      scene_.add({"", std::move(face)});
    }
  }

  void add_wall(glm::dvec2 const& a, glm::dvec2 const& b) {
    scene_.add({"", {{at(a, false), at(b, false), at(b, true), at(a, true)}, {}}});
  }

  void add_cell(glm::dvec2 const& centre) {
    Ring2 hole;
    for (glm::dvec2 const& corner : rim_) hole.push_back(centre + corner);
    glm::dvec2 const low = centre - half_;
    glm::dvec2 const high = centre + half_;
    if (low.x > 0.0 && low.y > 0.0 && high.x < 1.0 && high.y < 1.0) {
      add_faces({low, {high.x, low.y}, high, {low.x, high.y}}, hole);
      for (std::size_t i = 0; i < sides; ++i) add_wall(hole[i], hole[(i + 1) % sides]);
      return;
    }
    for (std::size_t i = 0; i < sides; ++i) {
      add_cut_sector(centre, hole[i], hole[(i + 1) % sides]);
    }
  }

  // For a cell across the sheet's edge: from a side of the hole outwards.
  void add_cut_sector(glm::dvec2 const& centre, glm::dvec2 const& a, glm::dvec2 const& b) {
    constexpr double beyond = 10.0;
    Ring2 const side = within_sheet({a, b});
    if (side.size() >= 2) add_wall(side[0], side[1]);
    Ring2 sector{a, centre + beyond * (a - centre), centre + beyond * (b - centre), b};
    for (int axis = 0; axis < 2; ++axis) {
      sector = cut(sector, axis, 1.0, centre[axis] + half_[axis]);
      sector = cut(sector, axis, -1.0, half_[axis] - centre[axis]);
    }
    sector = within_sheet(std::move(sector));
    if (sector.size() < 3) return;
    add_faces(sector, {});
    for (std::size_t i = 0; i < sector.size(); ++i) {
      glm::dvec2 const& from = sector[i];
      glm::dvec2 const& to = sector[(i + 1) % sector.size()];
      for (int axis = 0; axis < 2; ++axis) {
        for (double const edge : {0.0, 1.0}) {
          constexpr double on = 1e-12;
          if (std::abs(from[axis] - edge) < on && std::abs(to[axis] - edge) < on) {
            add_wall(from, to);
          }
        }
      }
    }
  }

  static Ring2 within_sheet(Ring2 ring) {
    for (int axis = 0; axis < 2; ++axis) {
      ring = cut(ring, axis, 1.0, 1.0);
      ring = cut(ring, axis, -1.0, 0.0);
    }
    return ring;
  }

  // The part of a convex ring with sign x coordinate <= limit.
  static Ring2 cut(Ring2 const& ring, int axis, double sign, double limit) {
    Ring2 kept;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      glm::dvec2 const& a = ring[i];
      glm::dvec2 const& b = ring[(i + 1) % ring.size()];
      double const inside_a = limit - sign * a[axis];
      double const inside_b = limit - sign * b[axis];
      if (inside_a >= 0.0) kept.push_back(a);
      if ((inside_a > 0.0 && inside_b < 0.0) || (inside_a < 0.0 && inside_b > 0.0)) {
        kept.push_back(a + (b - a) * (inside_a / (inside_a - inside_b)));
      }
    }
    return kept;
  }

  PerforatedCase given_;
  Ring2 rim_;
  glm::dvec2 half_{0.0};  // of a cell
  Scene scene_;
};

void print_row(char const* name, Errors const& errors) {
  std::printf("%-28s %9zu %+11.2e %9.2e %9.2e\n", name, errors.count(), errors.signed_mean(),
              errors.mean(), errors.largest());
}

}  // namespace

void print_geometry_table(std::span<SunDirection const> suns, int resolution) {
  PerforatedCase const given;
  std::vector<double> const exact = exact_fractions(given, suns);
  Stopwatch const making;
  Scene model = SheetModel(given).take();
  std::size_t const polygons = model.size() - 1;
  Renderer geometry = renderer_of(std::move(model), resolution);
  Renderer screen = renderer_of(given.scene(std::make_shared<PerforatedScreen const>(
      given.pattern(), Sheet{given.thickness, given.plane})));
  std::printf("%s\n%zu polygons, made in %.1f s; %d pixels, the screen at 512\n",
              geometry.device().renderer.c_str(), polygons, making.seconds(), resolution);
  Errors of_geometry;
  Errors of_screen;
  Errors between;
  double geometry_seconds = 0.0;
  double screen_seconds = 0.0;
  for (std::size_t i = 0; i < suns.size(); ++i) {
    Stopwatch const first;
    double const modelled = sunlit(geometry, suns[i], 0).projected_area;
    geometry_seconds += first.seconds();
    Stopwatch const second;
    double const screened = sunlit(screen, suns[i], 0).projected_area;
    screen_seconds += second.seconds();
    of_geometry.add(modelled - exact[i]);
    of_screen.add(screened - exact[i]);
    between.add(screened - modelled);
    if ((i + 1) % 10 == 0) {
      std::fprintf(stderr, "%zu of %zu positions, %.0f s, mean %.2e\n", i + 1, suns.size(),
                   geometry_seconds + screen_seconds, of_geometry.mean());
    }
  }
  std::printf("                             positions signed mean  mean abs   largest\n");
  print_row("polygons against exact", of_geometry);
  print_row("screen against exact", of_screen);
  print_row("screen against polygons", between);
  auto const n = static_cast<double>(suns.size());
  std::printf("seconds a position: polygons %.3f, screen %.4f\n", geometry_seconds / n,
              screen_seconds / n);
}

}  // namespace gpu_shading
