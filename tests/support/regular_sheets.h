#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <random>
#include <span>
#include <vector>

#include "gpu_shading/hole_pattern.h"
#include "gpu_shading/perforated_screen.h"
#include "gpu_shading/polygon.h"
#include "gpu_shading/renderer.h"
#include "gpu_shading/scene.h"
#include "gpu_shading/screen_placement.h"
#include "gpu_shading/sun_direction.h"

namespace gpu_shading {

// A receiver in the plane y = 0 that faces south, behind perforated sheets so large that their ends
// never shade it.
// Its exact sunlit fraction is found independently of the library: the outline of what passes a
// hole is the overlap of the hole's outline at both faces, a convex polygon; along the rays on the
// receiver's plane, these polygons are clipped to the receiver and, behind two sheets, to one
// another.
class RegularSheets {
 public:
  struct Sheet {
    Perforation holes;
    double thickness = 0.0;  // m
    double distance = 0.5;   // of its middle from the receiver's, m
    // Of its outward normal: to the west and upwards, rad.
    double turn = 0.0;
    double tilt = 0.0;
    double rotation = 0.0;  // of its holes
  };

  // One sheet or two, the nearer first.
  RegularSheets(Polygon receiver, std::vector<Sheet> sheets);
  // Of a rectangle.
  RegularSheets(double width, double height, std::vector<Sheet> sheets);

  // The receiver, then the sheets.
  Scene scene(ScreenDetail detail = ScreenDetail::automatic) const;
  double projected_area(SunDirection sun) const;
  // None where the sun is behind the receiver or nearly in the plane of a sheet.
  std::optional<double> sunlit_fraction(SunDirection sun) const;

 private:
  using Ring = std::vector<glm::dvec2>;

  // What passes a sheet's holes, on the receiver's plane: an outline, repeated by a lattice.
  struct Passing {
    Ring outline;
    double area = 0.0;                // of a whole hole, without the error of the outline's arcs
    std::vector<glm::dvec2> origins;  // of one hole or, staggered, of two
    glm::dvec2 a{0.0};
    glm::dvec2 b{0.0};
  };

  Polygon polygon(Sheet const& sheet) const;
  std::optional<Passing> project(Sheet const& sheet, SunDirection sun) const;
  static double through_one(Ring const& piece, Passing const& passing);
  static double through_both(Ring const& piece, Passing const& near, Passing const& far);

  Polygon receiver_;
  std::vector<Ring> pieces_;  // of the receiver, convex: x and z
  glm::dvec2 low_{0.0};       // its bounding rectangle
  glm::dvec2 high_{0.0};
  std::vector<Sheet> sheets_;
};

// The errors of the sunlit fraction by a renderer of the sheets' scene; none where most directions
// have no exact fraction. `seconds` takes the time of the CPU.
std::vector<double> errors_behind(RegularSheets const& sheets, Renderer& renderer,
                                  std::span<SunDirection const> suns, double& seconds);

// A sheet with holes of any shape and arrangement, of 0.1 mm to 0.3 m, and a thickness of 0 to 4
// holes; every other one is parallel to the receiver, and every fourth has its rows along it.
RegularSheets::Sheet random_sheet(std::mt19937& generator, double least = 1e-4, double most = 0.3);

// Two thin sheets, 10 mm to 0.5 m apart, with holes of 0.7 to 30 mm. Of four numbers, two have
// equal holes, and the first of them in line.
std::vector<RegularSheets::Sheet> random_pair(std::mt19937& generator, int number);

}  // namespace gpu_shading
