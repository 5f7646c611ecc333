#include "filters/perforation/sheet_in_beam.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

#include "filters/perforation/image_rays.h"
#include "gpu_shading/perforated_screen.h"

namespace gpu_shading {
namespace {

// Pixels of this size, in holes, from which and up to which drawing holes gives way to their
// effect. Of 200 random screens at 1e-3 (tests/bench/aliasing), 0.10 % of the views are beyond it
// on the CPU and 0.03 % on the pixels of OpenGL; with 1.0 and 2.0, it is 0.17 % on the CPU.
constexpr double blend_from = 0.7;
constexpr double blend_to = 1.2;

double deployed(Screens::Entry const& entry, std::span<double const> shares) {
  auto const share = static_cast<std::size_t>(std::max(0, entry.deployment));
  return entry.deployment < 0 || share >= shares.size() ? 1.0 : shares[share];
}

SheetShape shape_of(Hole hole) {
  switch (hole) {
    case Hole::Square:
      return SheetShape::square_holes;
    case Hole::Hexagonal:
      return SheetShape::hexagonal_holes;
    case Hole::Round:
    case Hole::Slotted:
      break;
  }
  return SheetShape::round_holes;
}

bool is_solid(PerforatedScreen const& screen, glm::dvec2 const& shift) {
  std::vector<float> const regions =
      screen.transmittance().at_shift(glm::length(shift), std::atan2(shift.y, shift.x));
  return std::all_of(regions.begin(), regions.end(), [](float passed) { return passed <= 0.0F; });
}

int layers_of(PerforatedScreen const& screen, glm::dvec2 const& shift) {
  if (screen.sheet().layers) return *screen.sheet().layers;
  if (screen.pattern()) return exact_sheet;
  constexpr int most = 64;
  double const length = glm::length(shift);
  // This many are not enough, and nothing passes except at the sheet's sides.
  if (length > (most - 1) * screen.web() && is_solid(screen, shift)) return solid_sheet;
  // Where nothing passes, layers only matter at the sides, where the path in the sheet is short.
  return layers_for(length, screen.web(), std::numeric_limits<double>::infinity(), most);
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
  if (!std::isfinite(screen.hole())) return {never, 2.0F * never};  // no layers, or no sheet
  return {blend_from * screen.hole(), blend_to * screen.hole()};
}

// At zero, one, two and three thirds of the path; one value for each region of the screen.
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

std::vector<float> repeated_once(SheetInBeam const& sheet) {
  std::vector<float> values;
  for (int row = 0; row <= sheet.regions_up; ++row) {
    for (int column = 0; column <= sheet.regions_across; ++column) {
      int const number =
          row % sheet.regions_up * sheet.regions_across + column % sheet.regions_across;
      values.push_back(sheet.regions[static_cast<std::size_t>(number)][3]);
    }
  }
  return values;
}

void describe_pattern(HolePattern const& pattern, SheetInBeam& sheet) {
  Perforation const& given = pattern.perforation();
  double const straight = given.hole == Hole::Slotted ? given.length - given.size : 0.0;
  sheet.shape = shape_of(given.hole);
  sheet.tile = {pattern.width(), pattern.height()};
  sheet.half_hole = static_cast<float>(given.size / 2.0);
  sheet.half_slot = static_cast<float>(straight / 2.0);
  sheet.staggered = given.arrangement != Arrangement::Straight;
}

void describe_tile(OpacityTile const& tile, SheetInBeam& sheet) {
  sheet.shape = SheetShape::image;
  sheet.tile = {tile.width(), tile.height()};
  sheet.threshold = static_cast<float>(tile.threshold().value_or(-1.0));
}

// The displacement of a ray in the sheet's plane from its inside face to its outside face.
glm::dvec2 shift_of(Screens::Entry const& entry, glm::dvec3 const& towards_sun, double cosine) {
  return glm::dvec2(glm::dot(entry.u, towards_sun), glm::dot(entry.v, towards_sun)) *
         (entry.screen->sheet().thickness / cosine);
}

// Whether the same rays pass two screens' layers.
bool same_layers(Screens::Entry const& a, SheetInBeam const& in_a, Screens::Entry const& b,
                 SheetInBeam const& in_b) {
  return a.screen == b.screen && in_a.ray_offset == in_b.ray_offset && in_a.layers == in_b.layers;
}

// Gives cells to the images that rays meet often enough.
void add_cells(Screens const& screens, ScreensAtDirection const& wanted,
               std::span<SheetInBeam> sheets) {
  struct Alike {
    int first;
    double rays;
    std::shared_ptr<ImageCells const> cells;
  };
  std::vector<Alike> found;
  auto const each_image = [&](auto use) {
    for (std::size_t i = 0; i < wanted.in_view.size(); ++i) {
      if (!wanted.in_view[i] || sheets[i].layers <= 0 || !screens.entries()[i].screen->tile()) {
        continue;
      }
      int const number = static_cast<int>(i);
      auto const alike = std::find_if(found.begin(), found.end(), [&](Alike const& other) {
        return same_layers(screens[other.first], sheets[static_cast<std::size_t>(other.first)],
                           screens[number], sheets[i]);
      });
      use(number, alike);
    }
  };
  each_image([&](int number, auto alike) {
    double const rays = wanted.rays[static_cast<std::size_t>(number)];
    if (alike == found.end()) {
      found.push_back({number, rays, nullptr});
    } else {
      alike->rays += rays;
    }
  });
  for (Alike& each : found) {
    PerforatedScreen const& screen = *screens[each.first].screen;
    SheetInBeam const& sheet = sheets[static_cast<std::size_t>(each.first)];
    if (!ImageCells::worth(*screen.tile(), each.rays)) continue;
    each.cells = ImageRays(*screen.tile(), sheet, layer_depths(sheet.layers))
                     .make_cells(screen.image_bounds());
  }
  each_image([&](int number, auto alike) {
    sheets[static_cast<std::size_t>(number)].cells = alike->cells;
  });
}

}  // namespace

double pixel_in_sheet(Screens::Entry const& screen, View const& pixels) {
  glm::dvec3 const x(pixels.x);
  glm::dvec3 const y(pixels.y);
  return 1.0 / std::sqrt(std::abs(glm::dot(x, screen.u) * glm::dot(y, screen.v) -
                                  glm::dot(x, screen.v) * glm::dot(y, screen.u)));
}

bool may_see_effect(Screens::Entry const& screen, glm::dvec3 const& towards_sun,
                    double pixel_area) {
  // Fragment shaders compute the size of pixels themselves, in single precision.
  constexpr double margin = 1.1;
  double const pixel = std::sqrt(pixel_area / std::abs(glm::dot(screen.normal, towards_sun)));
  return margin * pixel > static_cast<double>(blend_of(*screen.screen).x);
}

bool varies(PerforatedScreen const& screen) {
  if (screen.pattern()) return false;
  return screen.transmittance().regions_across() * screen.transmittance().regions_up() > 1;
}

std::vector<double> layer_depths(int layers) {
  if (layers == 1) return {0.5};
  std::vector<double> depths;
  depths.reserve(static_cast<std::size_t>(std::max(0, layers)));
  for (int k = 0; k < layers; ++k) depths.push_back(static_cast<double>(k) / (layers - 1));
  return depths;
}

void ScreensAtDirection::add(int number, bool sees_effect, double rays_added) {
  auto const place = static_cast<std::size_t>(number);
  if (place >= in_view.size()) {
    in_view.resize(place + 1, false);
    by_effect.resize(place + 1, false);
    rays.resize(place + 1, 0.0);
  }
  in_view[place] = true;
  rays[place] += rays_added;
  if (sees_effect) by_effect[place] = true;
}

SheetInBeam sheet_in_beam(Screens::Entry const& entry, glm::dvec3 const& towards_sun,
                          double in_place, bool has_effect) {
  PerforatedScreen const& screen = *entry.screen;
  SheetInBeam sheet;
  double const cosine = glm::dot(entry.normal, towards_sun);
  bool const aside = std::abs(cosine) < from_the_side;
  glm::dvec2 const shift = aside ? glm::dvec2(0.0) : shift_of(entry, towards_sun, cosine);
  if (screen.pattern()) {
    describe_pattern(*screen.pattern(), sheet);
  } else {
    describe_tile(*screen.tile(), sheet);
  }
  sheet.normal = entry.normal;
  sheet.inside = static_cast<float>(entry.inside);
  sheet.outside = static_cast<float>(entry.outside);
  sheet.ray_offset = shift;
  sheet.in_place = static_cast<float>(in_place);
  glm::vec2 const blend = has_effect ? blend_of(screen) : glm::vec2(never, 2.0F * never);
  sheet.blend_from = blend.x;
  sheet.blend_to = blend.y;
  sheet.layers = aside ? solid_sheet : layers_of(screen, shift);
  if (!has_effect) return sheet;
  std::vector<glm::vec4> thirds = effective(screen, shift);
  sheet.effective = thirds.front();
  if (!varies(screen)) return sheet;
  sheet.regions_across = screen.transmittance().regions_across();
  sheet.regions_up = screen.transmittance().regions_up();
  sheet.regions = std::move(thirds);
  sheet.whole_path = repeated_once(sheet);
  return sheet;
}

std::vector<SheetInBeam> sheets_in_beam(Screens const& screens, ScreensAtDirection const& wanted,
                                        std::span<double const> deployments) {
  std::vector<SheetInBeam> sheets(screens.entries().size());
  for (std::size_t number = 0; number < wanted.in_view.size(); ++number) {
    if (!wanted.in_view[number]) continue;
    Screens::Entry const& entry = screens.entries()[number];
    sheets[number] = sheet_in_beam(entry, wanted.towards_sun, deployed(entry, deployments),
                                   wanted.by_effect[number]);
  }
  add_cells(screens, wanted, sheets);
  return sheets;
}

TextureCells texture_cells(OpacityTile const& tile, int max_texels) {
  int const most = max_texels - 2;
  TextureCells cells;
  cells.columns = std::min(tile.columns(), most);
  cells.rows = std::min(tile.rows(), most);
  cells.across = (tile.columns() + cells.columns - 1) / cells.columns;
  cells.up = (tile.rows() + cells.rows - 1) / cells.rows;
  return cells;
}

void add_block(SheetBlocks& blocks, SheetInBeam const& sheet, PerforatedScreen const& screen,
               int max_texels) {
  SheetBlock& block = blocks.sheets.emplace_back();
  block.normal = glm::vec4(sheet.normal, sheet.inside);
  block.ray = glm::vec4(sheet.ray_offset, sheet.outside, sheet.in_place);
  block.tile = glm::vec4(sheet.tile, sheet.blend_from, sheet.blend_to);
  block.hole = {sheet.half_hole, sheet.half_slot, sheet.staggered ? 1.0F : 0.0F, sheet.threshold};
  block.effective = sheet.effective;
  block.kind = {static_cast<int>(sheet.shape), sheet.layers,
                static_cast<int>(blocks.regions.size()), sheet.regions_across};
  block.image.x = sheet.regions_up;
  if (screen.tile()) {
    TextureCells const cells = texture_cells(*screen.tile(), max_texels);
    block.image.y = cells.columns;
    block.image.z = cells.rows;
    block.image.w = cells.across;
    block.texels = {screen.tile()->columns(), screen.tile()->rows(), 0.0F, 0.0F};
  }
  blocks.regions.insert(blocks.regions.end(), sheet.regions.begin(), sheet.regions.end());
}

}  // namespace gpu_shading
