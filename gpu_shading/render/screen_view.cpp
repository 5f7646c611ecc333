#include "render/screen_view.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace gpu_shading {
namespace {

// As in screen.frag.
enum Shape { shape_texture, shape_round, shape_square, shape_hexagonal };
constexpr int effective_steps = 8;
constexpr int solid = 0;
constexpr int exactly = -1;

// Below this cosine between the beam and the sheet it is seen from the side: solid.
constexpr double from_the_side = 1e-3;

// Pixels of this size, in holes, from which and up to which drawing holes gives way to their
// effect. Error of the projected sunlit fraction by `perforated_case blend`, mean (largest), holes
// of 1 to 100 mm in 1 m2, 64 to 1024 pixels:
//   pixels of      holes             effect
//   below 0.5      1e-4 (5e-3)       1.5e-3 (1.4e-2)
//   0.5 .. 1       1.3e-4 (4.4e-3)   3.6e-4 (4.6e-3)
//   1 .. 2         1.5e-4 (4.1e-3)   2.2e-4 (1.7e-3)
//   2 .. 4         2.3e-4 (3.9e-3)   1.9e-4 (1.4e-3)
//   above 4        2.8e-4 (6.2e-3)   1.3e-4 (0.8e-3)
constexpr double blend_from = 1.0;
constexpr double blend_to = 2.0;

double deployed(Screens::Entry const& entry, std::span<double const> shares) {
  auto const share = static_cast<std::size_t>(std::max(0, entry.deployment));
  return entry.deployment < 0 || share >= shares.size() ? 1.0 : shares[share];
}

Shape shape_of(Hole hole) {
  switch (hole) {
    case Hole::Square:
      return shape_square;
    case Hole::Hexagonal:
      return shape_hexagonal;
    case Hole::Round:
    case Hole::Slotted:
      break;
  }
  return shape_round;
}

int layers_of(PerforatedScreen const& screen, double shift) {
  if (screen.sheet().layers) return *screen.sheet().layers;
  if (screen.pattern()) return exactly;
  constexpr int most = 64;
  // Where so many are not enough and nothing passes but at the sheet's sides.
  if (shift > (most - 1) * screen.web() && shift >= screen.transmittance().longest_chord()) {
    return solid;
  }
  // Past the longest chord layers are for the sides, where the way in the sheet is short.
  return layers_for(shift, screen.web(), std::numeric_limits<double>::infinity(), most);
}

glm::vec2 blend_of(PerforatedScreen const& screen) {
  constexpr float never = 1e30F;
  switch (screen.sheet().detail) {
    case ScreenDetail::holes:
      return {never, 2.0F * never};
    case ScreenDetail::effective:
      return {-2.0F, -1.0F};
    case ScreenDetail::automatic:
      break;
  }
  if (!std::isfinite(screen.hole())) return {never, 2.0F * never};  // there are none, or no sheet
  return {blend_from * screen.hole(), blend_to * screen.hole()};
}

void add_effective(PerforatedScreen const& screen, glm::dvec2 const& shift, ScreenOptics& optics,
                   std::vector<float>& effective) {
  optics.kind_layers_effective.z = static_cast<int>(effective.size());
  optics.kind_layers_effective.w = 1;
  optics.regions_texture.x = 1;
  for (int i = 0; i <= effective_steps; ++i) {
    glm::dvec2 const part = shift * (static_cast<double>(i) / effective_steps);
    if (screen.pattern()) {
      effective.push_back(static_cast<float>(screen.pattern()->transmittance(part.x, part.y)));
    } else {
      double const theta = std::atan2(glm::length(part), screen.sheet().thickness);
      effective.push_back(
          static_cast<float>(screen.transmittance()(theta, std::atan2(part.y, part.x))));
    }
  }
}

void describe(PerforatedScreen const& screen, int most_texels, ScreenOptics& optics) {
  if (screen.pattern()) {
    Perforation const& given = screen.pattern()->perforation();
    optics.kind_layers_effective.x = shape_of(given.hole);
    optics.tile_blend.x = static_cast<float>(screen.pattern()->width());
    optics.tile_blend.y = static_cast<float>(screen.pattern()->height());
    double const straight = given.hole == Hole::Slotted ? given.length - given.size : 0.0;
    bool const staggered = given.arrangement != Arrangement::Straight;
    optics.hole = {given.size / 2.0, straight / 2.0, staggered ? 1.0 : 0.0, 0.0};
    return;
  }
  OpacityTile const& tile = *screen.tile();
  TextureCells const cells = texture_cells(tile, most_texels);
  optics.kind_layers_effective.x = shape_texture;
  optics.tile_blend.x = static_cast<float>(tile.width());
  optics.tile_blend.y = static_cast<float>(tile.height());
  optics.regions_texture.y = cells.columns;
  optics.regions_texture.z = cells.rows;
  optics.regions_texture.w = cells.across;
  optics.texels = {tile.columns(), tile.rows(), 0.0, 0.0};
  optics.shift_deployed_threshold.w = static_cast<float>(tile.threshold().value_or(-1.0));
}

}  // namespace

TextureCells texture_cells(OpacityTile const& tile, int most_texels) {
  int const most = most_texels - 2;
  TextureCells cells;
  cells.columns = std::min(tile.columns(), most);
  cells.rows = std::min(tile.rows(), most);
  cells.across = (tile.columns() + cells.columns - 1) / cells.columns;
  cells.up = (tile.rows() + cells.rows - 1) / cells.rows;
  return cells;
}

ScreenView see_screens(Screens const& screens, std::span<int const> numbers,
                       glm::dvec3 const& towards_sun, std::span<double const> deployments,
                       int most_texels) {
  ScreenView view;
  view.faces.resize(screens.entries().size());
  view.optics.resize(screens.entries().size());
  for (int const number : numbers) {
    Screens::Entry const& entry = screens[number];
    PerforatedScreen const& screen = *entry.screen;
    ScreenFace& face = view.faces[static_cast<std::size_t>(number)];
    ScreenOptics& optics = view.optics[static_cast<std::size_t>(number)];
    double const cosine = glm::dot(entry.normal, towards_sun);
    bool const aside = std::abs(cosine) < from_the_side;
    glm::dvec2 shift(0.0);
    if (!aside) {
      shift = glm::dvec2(glm::dot(entry.u, towards_sun), glm::dot(entry.v, towards_sun)) *
              (screen.sheet().thickness / cosine);
    }
    face.normal_inside = glm::vec4(entry.normal, entry.inside);
    face.shift_outside_unused = glm::vec4(shift, entry.outside, 0.0);
    describe(screen, most_texels, optics);
    optics.shift_deployed_threshold.x = static_cast<float>(shift.x);
    optics.shift_deployed_threshold.y = static_cast<float>(shift.y);
    optics.shift_deployed_threshold.z = static_cast<float>(deployed(entry, deployments));
    optics.kind_layers_effective.y = aside ? solid : layers_of(screen, glm::length(shift));
    glm::vec2 const blend = blend_of(screen);
    optics.tile_blend.z = blend.x;
    optics.tile_blend.w = blend.y;
    add_effective(screen, shift, optics, view.effective);
  }
  return view;
}

}  // namespace gpu_shading
