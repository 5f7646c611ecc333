#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "gpu_shading/polygon.h"
#include "gpu_shading/scene.h"
#include "model/input/pv_modules.h"
#include "reports/map_grid.h"

namespace gpu_shading::energyplus {

// A rectangle in the axes of a surface, m.
struct FlatBox {
  glm::dvec2 low{0.0};
  glm::dvec2 high{0.0};
};

// A module in its place.
struct PlacedModule {
  int column = 0;  // from the left
  int row = 0;     // from below
  int string = 0;  // from 0
  FlatBox box;
};

// The modules of one surface. Cells of a module are numbered row by row, a row running along the
// module's width.
class ModuleLayout {
 public:
  // `polygon`: the surface's. Throws Error if no module fits, or if more than max_modules do.
  ModuleLayout(PvModules const& modules, std::string surface, Polygon const& polygon);
  static constexpr std::size_t max_modules = 100'000;

  PvModules const& spec() const { return spec_; }
  std::string const& surface() const { return surface_; }
  MapAxes const& axes() const { return axes_; }
  std::vector<FlatRing> const& rings() const { return rings_; }  // of the surface

  // By string, and along each.
  std::vector<PlacedModule> const& modules() const { return modules_; }
  int strings() const { return modules_.back().string + 1; }

  FlatBox cell(PlacedModule const& module, std::size_t number) const;
  // The bypass diode, from 0, that protects a cell.
  int diode(std::size_t cell) const;

  // In world axes, seen from outside counterclockwise, `ray_lift` in front of the surface.
  Polygon polygon(FlatBox const& box) const;
  // Around all modules.
  FlatBox bounds() const;

 private:
  bool is_on_surface(FlatBox const& box) const;

  PvModules spec_;
  std::string surface_;
  MapAxes axes_;
  std::vector<FlatRing> rings_;
  std::vector<PlacedModule> modules_;
};

}  // namespace gpu_shading::energyplus
