#pragma once

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gpu_shading/perforated_screen.h"
#include "support/shapes.h"

// Single rays through perforated sheets, and what passes by the rule: a table that every
// implementation of the rule is held to. All are 0.5 mm or more from an edge. Positions are in the
// sheet's plane, in metres, from the centre of a hole; a ray runs from `place` at the inside face
// to `place + way` at the outside face.
namespace gpu_shading {

struct SheetCase {
  std::string name;
  Perforation holes;
  std::optional<int> layers;  // empty: exactly
  glm::dvec2 place;
  glm::dvec2 way;
  double passed;
};

// How the holes are given to the renderer.
enum class SheetForm { pattern, image };

// A sheet as a surface, level at z = 0 with a hole's centre in the origin: u runs along y, v along
// -x.
inline Surface sheet_of(SheetCase const& one, SheetForm form) {
  HolePattern const holes(one.holes);
  Sheet const sheet{.thickness = 0.02,
                    .plane = SheetPlane::inside,
                    .layers = one.layers,
                    .detail = ScreenDetail::holes};
  Surface surface{"sheet", level(-0.5, -0.5, 0, 1, 1)};
  auto screen = form == SheetForm::pattern
                    ? std::make_shared<PerforatedScreen const>(holes, sheet)
                    : std::make_shared<PerforatedScreen const>(OpacityTile(holes, 1e-3), sheet);
  surface.filter.set(PerforatedSheet{std::move(screen), {.origin_u = 0.5, .origin_v = 0.5}});
  return surface;
}
inline glm::dvec3 towards_sun_of(SheetCase const& one) {
  return glm::normalize(glm::dvec3(-one.way.y, one.way.x, 0.02));
}

inline std::vector<SheetCase> sheet_cases() {
  // Holes of 40 mm; neighbours 100 mm apart.
  auto const of = [](Hole hole, Arrangement arrangement) {
    return Perforation{.hole = hole, .arrangement = arrangement, .size = 0.04, .pitch = 0.1};
  };
  Perforation const round = of(Hole::Round, Arrangement::Straight);
  Perforation const square = of(Hole::Square, Arrangement::Straight);
  Perforation const hexagonal = of(Hole::Hexagonal, Arrangement::Straight);
  Perforation const staggered = of(Hole::Round, Arrangement::Staggered45);
  Perforation slotted = of(Hole::Slotted, Arrangement::Straight);
  slotted.length = 0.08;
  glm::dvec2 const still(0.0);
  return {
      {"middle of a round hole", round, {}, {0.0, 0.0}, still, 1.0},
      {"inside the edge of a round hole", round, {}, {0.0138, 0.0138}, still, 1.0},   // 19.5 mm
      {"outside the edge of a round hole", round, {}, {0.0145, 0.0145}, still, 0.0},  // 20.5 mm
      {"corner of a square hole", square, {}, {0.019, 0.019}, still, 1.0},
      {"beyond the side of a square hole", square, {}, {0.0205, 0.0}, still, 0.0},
      {"beyond the top of a square hole", square, {}, {0.0, -0.0205}, still, 0.0},
      // A hexagon with flats at x = +-20 mm has corners at y = +-23.1 mm.
      {"corner of a hexagon", hexagonal, {}, {0.0, 0.0225}, still, 1.0},
      {"beyond the corner of a hexagon", hexagonal, {}, {0.0, 0.0237}, still, 0.0},
      {"beyond the flat of a hexagon", hexagonal, {}, {0.0205, 0.0}, still, 0.0},
      {"inside the slanted side of a hexagon", hexagonal, {}, {-0.0097, 0.0168}, still, 1.0},
      {"outside the slanted side of a hexagon", hexagonal, {}, {-0.0103, 0.0178}, still, 0.0},
      {"straight part of a slot", slotted, {}, {0.0195, 0.0195}, still, 1.0},
      {"round end of a slot", slotted, {}, {0.0395, 0.0}, still, 1.0},
      {"beside the round end of a slot", slotted, {}, {0.036, 0.016}, still, 0.0},  // 22.6 mm
      {"neighbouring hole", round, {}, {0.1, -0.2}, still, 1.0},
      {"between straight holes", round, {}, {0.05, 0.05}, still, 0.0},
      {"hole in the middle of the tile", staggered, {}, {0.0707, 0.0707}, still, 1.0},
      {"between staggered holes", staggered, {}, {0.0707, 0.0}, still, 0.0},
      {"slanted, within a hole", round, {}, {-0.015, 0.0}, {0.03, 0.0}, 1.0},
      {"slanted, out of a hole", round, {}, {-0.015, 0.0}, {0.04, 0.0}, 0.0},
      {"slanted, into a hole", round, {}, {0.025, 0.0}, {-0.025, 0.0}, 0.0},
      {"slanted, from one hole into another", round, {}, {0.0, 0.0}, {0.1, 0.0}, 0.0},
      {"slanted, from a corner into the middle", staggered, {}, {0, 0}, {0.0707, 0.0707}, 0.0},
      // Two layers do not see the web between two holes; three do.
      {"over a web between two layers", round, 2, {0.0, 0.0}, {0.1, 0.0}, 1.0},
      {"over a web with a layer in it", round, 3, {0.0, 0.0}, {0.1, 0.0}, 0.0},
      {"out of a hole, by its middle", round, 1, {0.0, 0.0}, {0.03, 0.0}, 1.0},
      {"out of a hole, by its layers", round, 2, {0.0, 0.0}, {0.03, 0.0}, 0.0},
  };
}

}  // namespace gpu_shading
