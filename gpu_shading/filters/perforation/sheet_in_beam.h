#pragma once

#include <algorithm>
#include <cmath>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <span>
#include <vector>

#include "filters/perforation/screens.h"
#include "gpu_shading/perforated_screen.h"
#include "view/view.h"

namespace gpu_shading {

class ImageCells;

// The number of layers that represent a sheet at a shift, front and back included: 1 + ceil(shift /
// web), at most `most`, so that no ray steps over a web of that width; 0 beyond the longest path
// through a hole, where the sheet is solid. `web` is above 0 and may be infinite; shifts are 0 or
// more. Round, square and hexagonal holes of 64 texels drawn in this way are within 2e-3 of the
// closed form for theta from 0 to 85 degrees, and within 9e-4 on average. With OpacityTile::web(),
// images with stray texels take as many layers as clean ones and are as accurate.
inline int layers_for(double shift, double web, double longest_chord, int most = 64) {
  if (shift >= longest_chord) return 0;
  return static_cast<int>(std::min(1.0 + std::ceil(shift / web), static_cast<double>(most)));
}

// How a sheet's openings are described. screen.frag uses the same numbers.
enum class SheetShape { image, round_holes, square_holes, hexagonal_holes };

// Special values of the number of layers.
constexpr int solid_sheet = 0;  // nothing passes
constexpr int exact_sheet =
    -1;  // holes are convex: a ray passes if it is in the same hole at both faces

// Below this cosine between the beam and the sheet's normal, the sheet is seen edge-on and counts
// as solid.
inline constexpr double from_the_side = 1e-3;

// A perforated sheet at one sun direction. Lengths in metres, in single precision, which every back
// end uses.
struct SheetInBeam {
  glm::vec3 normal{0.0F};
  float inside = 0.0F;   // the inside face along the normal from the polygon
  float outside = 0.0F;  // the outside face
  glm::vec2 ray_offset{
      0.0F};  // displacement of a ray towards the sun from face to face, in the sheet's plane
  float in_place = 0.0F;  // deployed fraction of the screen, 0 .. 1
  glm::vec2 tile{0.0F};   // width and height
  // Sizes of pixels in the sheet: up to the first, holes are resolved; from the second on, only
  // their effective transmittance is used. Below 0 where that is what was asked for.
  float blend_from = 0.0F;
  float blend_to = 0.0F;
  SheetShape shape = SheetShape::image;
  float half_hole = 0.0F;  // half of a hole's size
  float half_slot = 0.0F;  // half of a slot's straight part
  bool staggered = false;
  float threshold = 0.0F;  // opacity above which an image is solid; negative: it multiplies
  int layers = solid_sheet;
  glm::vec4 effective{0.0F};  // transmittance at zero, one, two and three thirds of the path
  // The same by region of the tile, row after row, if it varies; otherwise empty.
  int regions_across = 0;
  int regions_up = 0;
  std::vector<glm::vec4> regions;
  // The last of them, each row followed by its first again, and so the rows.
  std::vector<float> whole_path;
  // Of an image that many rays meet; else null.
  std::shared_ptr<ImageCells const> cells;
};

// Whether rays through its holes pass or not, and nothing between, by functions for many at once.
inline bool has_edges(SheetInBeam const& sheet) {
  return sheet.shape == SheetShape::image ? sheet.threshold >= 0.0F : sheet.layers == exact_sheet;
}

// Depths of layers, from 0 at the inside face to 1 at the outside face.
std::vector<double> layer_depths(int layers);

// The size of pixels in a screen's plane, m; `pixels` has its x and y in pixels.
double pixel_in_sheet(Screens::Entry const& screen, View const& pixels);

// Whether the effective transmittance varies between regions. Computes the screen's table.
bool varies(PerforatedScreen const& screen);

// Whether pixels of this area normal to the beam, m2, may use a screen's effective transmittance.
// If none do, its table is not computed.
bool may_see_effect(Screens::Entry const& screen, glm::dvec3 const& towards_sun, double pixel_area);

// The screens in any view at one sun direction.
struct ScreensAtDirection {
  glm::dvec3 towards_sun{0.0};
  std::vector<bool> in_view;      // by index; not in view if too short
  std::vector<bool> by_effect;    // those whose effective transmittance some view may use
  std::vector<double> rays = {};  // that meet each, about

  void add(int number, bool sees_effect, double rays_added = 0.0);
};

// `in_place`: the deployed fraction. `has_effect`: whether its effective transmittance may be used.
SheetInBeam sheet_in_beam(Screens::Entry const& entry, glm::dvec3 const& towards_sun,
                          double in_place, bool has_effect);

// By index, the screens in view; empty for others. `deployments`: deployed fractions, 1 beyond the
// end.
std::vector<SheetInBeam> sheets_in_beam(Screens const& screens, ScreensAtDirection const& wanted,
                                        std::span<double const> deployments);

// SheetInBeam in the layout of Sheet in screen.vert, std430.
struct SheetBlock {
  glm::vec4 normal{0.0F};
  glm::vec4 ray{0.0F};
  glm::vec4 tile{0.0F};
  glm::vec4 hole{0.0F};
  glm::vec4 effective{0.0F};
  glm::ivec4 kind{0};
  glm::ivec4 image{0};
  glm::vec4 texels{0.0F};
};

// The data of screens at some directions: one block per screen, direction after direction.
struct SheetBlocks {
  std::vector<SheetBlock> sheets;
  std::vector<glm::vec4> regions;  // of screens whose effective transmittance varies
};

// How the image of a tile is divided into layers of a texture, all of equal size except at the
// ends, each with a border of one texel.
struct TextureCells {
  int columns = 0;  // of a layer, without the border
  int rows = 0;
  int across = 0;  // layers
  int up = 0;
};
TextureCells texture_cells(OpacityTile const& tile, int max_texels);

// `max_texels`: maximum number of texels per side of a texture.
void add_block(SheetBlocks& blocks, SheetInBeam const& sheet, PerforatedScreen const& screen,
               int max_texels);

}  // namespace gpu_shading
