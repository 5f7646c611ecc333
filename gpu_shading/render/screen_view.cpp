#include "render/screen_view.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace gpu_shading {
namespace {

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

SheetShape shape_of(Hole hole) {
  switch (hole) {
    case Hole::Square:
      return square_hole;
    case Hole::Hexagonal:
      return hexagonal_hole;
    case Hole::Round:
    case Hole::Slotted:
      break;
  }
  return round_hole;
}

int layers_of(PerforatedScreen const& screen, double shift) {
  if (screen.sheet().layers) return *screen.sheet().layers;
  if (screen.pattern()) return exact_sheet;
  constexpr int most = 64;
  // Where so many are not enough and nothing passes but at the sheet's sides.
  if (shift > (most - 1) * screen.web() && shift >= screen.transmittance().longest_chord()) {
    return solid_sheet;
  }
  // Past the longest chord layers are for the sides, where the way in the sheet is short.
  return layers_for(shift, screen.web(), std::numeric_limits<double>::infinity(), most);
}

// Larger than any pixel.
constexpr float never = 1e30F;

glm::vec2 blend_of(PerforatedScreen const& screen) {
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

// For no, one, two and three thirds of the way; one value for each region of the screen.
std::vector<glm::vec4> effective(PerforatedScreen const& screen, glm::dvec2 const& shift) {
  if (screen.pattern()) {
    glm::vec4 thirds(0.0F);
    for (int i = 0; i < 4; ++i) {
      glm::dvec2 const part = shift * (i / 3.0);
      thirds[i] = static_cast<float>(screen.pattern()->transmittance(part.x, part.y));
    }
    return {thirds};
  }
  double const phi = std::atan2(shift.y, shift.x);
  std::vector<glm::vec4> regions;
  for (int i = 0; i < 4; ++i) {
    std::vector<float> const values =
        screen.transmittance().at_shift(glm::length(shift) * (i / 3.0), phi);
    regions.resize(values.size(), glm::vec4(0.0F));
    for (std::size_t at = 0; at < values.size(); ++at) regions[at][i] = values[at];
  }
  return regions;
}

void describe_pattern(HolePattern const& pattern, SheetBlock& sheet) {
  Perforation const& given = pattern.perforation();
  double const straight = given.hole == Hole::Slotted ? given.length - given.size : 0.0;
  bool const staggered = given.arrangement != Arrangement::Straight;
  sheet.kind.x = shape_of(given.hole);
  sheet.tile.x = static_cast<float>(pattern.width());
  sheet.tile.y = static_cast<float>(pattern.height());
  sheet.hole = {given.size / 2.0, straight / 2.0, staggered ? 1.0 : 0.0, 0.0};
}

void describe_tile(OpacityTile const& tile, int most_texels, SheetBlock& sheet) {
  TextureCells const cells = texture_cells(tile, most_texels);
  sheet.kind.x = texture_sheet;
  sheet.tile.x = static_cast<float>(tile.width());
  sheet.tile.y = static_cast<float>(tile.height());
  sheet.hole.w = static_cast<float>(tile.threshold().value_or(-1.0));
  sheet.image = {0, cells.columns, cells.rows, cells.across};
  sheet.texels = {tile.columns(), tile.rows(), 0.0, 0.0};
}

// The way of a ray in the sheet's plane from its inside face to its outside.
glm::dvec2 shift_of(Screens::Entry const& entry, glm::dvec3 const& towards_sun, double cosine) {
  return glm::dvec2(glm::dot(entry.u, towards_sun), glm::dot(entry.v, towards_sun)) *
         (entry.screen->sheet().thickness / cosine);
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

bool may_see_effect(PerforatedScreen const& screen, glm::dvec3 const& normal,
                    glm::dvec3 const& towards_sun, double pixel_area) {
  // Fragments find the size of pixels for themselves, in single precision.
  constexpr double margin = 1.1;
  double const pixel = std::sqrt(pixel_area / std::abs(glm::dot(normal, towards_sun)));
  return margin * pixel > static_cast<double>(blend_of(screen).x);
}

bool varies(PerforatedScreen const& screen) {
  if (screen.pattern()) return false;
  return screen.transmittance().regions_across() * screen.transmittance().regions_up() > 1;
}

ScreenView see_screens(Screens const& screens, std::span<int const> numbers,
                       std::vector<bool> const& by_effect, glm::dvec3 const& towards_sun,
                       std::span<double const> deployments, int most_texels) {
  ScreenView view;
  view.sheets.resize(screens.entries().size());
  for (int const number : numbers) {
    Screens::Entry const& entry = screens[number];
    PerforatedScreen const& screen = *entry.screen;
    SheetBlock& sheet = view.sheets[static_cast<std::size_t>(number)];
    double const cosine = glm::dot(entry.normal, towards_sun);
    bool const aside = std::abs(cosine) < from_the_side;
    glm::dvec2 const shift = aside ? glm::dvec2(0.0) : shift_of(entry, towards_sun, cosine);
    if (screen.pattern()) {
      describe_pattern(*screen.pattern(), sheet);
    } else {
      describe_tile(*screen.tile(), most_texels, sheet);
    }
    sheet.normal = glm::vec4(entry.normal, entry.inside);
    sheet.ray = glm::vec4(shift, entry.outside, deployed(entry, deployments));
    bool const has_effect = static_cast<std::size_t>(number) < by_effect.size() &&
                            by_effect[static_cast<std::size_t>(number)];
    glm::vec2 const blend = has_effect ? blend_of(screen) : glm::vec2(never, 2.0F * never);
    sheet.tile.z = blend.x;
    sheet.tile.w = blend.y;
    sheet.kind.y = aside ? solid_sheet : layers_of(screen, glm::length(shift));
    if (!has_effect) continue;
    std::vector<glm::vec4> const thirds = effective(screen, shift);
    sheet.effective = thirds.front();
    if (!varies(screen)) continue;
    sheet.kind.z = static_cast<int>(view.regions.size());
    sheet.kind.w = screen.transmittance().regions_across();
    sheet.image.x = screen.transmittance().regions_up();
    view.regions.insert(view.regions.end(), thirds.begin(), thirds.end());
  }
  return view;
}

}  // namespace gpu_shading
