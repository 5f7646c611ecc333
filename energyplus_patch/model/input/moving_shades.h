#pragma once

#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "model/extensions/extension_fields.h"
#include "model/idf/input_object.h"
#include "model/idf/mentions.h"
#include "model/input/shading_input.h"

namespace gpu_shading::energyplus {

// A GPUShading:MovingShade: shading surfaces that move together.
struct MovingShade {
  using Motion = extension::moving_shade::Motion;
  using Axis = extension::moving_shade::Axis;
  using Control = extension::moving_shade::Control;

  std::string name;
  std::string where;                  // type and name, for messages
  std::vector<std::string> surfaces;  // upper case, sorted
  Motion motion = Motion::rotate;
  Axis axis = Axis::centre_line;
  glm::dvec3 direction{0.0};  // unit vector, or 0
  glm::dvec3 point{0.0};
  double minimum = 0.0;
  double maximum = 0.0;
  double step = 0.0;
  double rest = 0.0;  // on the grid
  // Whether maps show it at rest, as set_rest() asks for, instead of where its control moves it.
  bool stands = false;
  Control control = Control::schedule;
  std::string schedule;      // upper case, or ""
  std::string receivers;     // pattern, or ""
  std::string availability;  // upper case, or ""
  std::optional<double> minimum_beam = std::nullopt;
  double tolerance = 0.0;  // share of a receiver, 0 .. 1
  double hysteresis = 0.0;
  std::optional<double> maximum_wind = std::nullopt;  // m/s
  // For Fold, once the surfaces are known (fold_track): where panels begin along the direction, in
  // order, and to where their hinges move (unit vector).
  struct Track {
    std::vector<double> starts;
    glm::dvec3 outward{0.0};
  } track = {};

  // The nearest position at which the surfaces can stand.
  double nearest(double position) const;
  // The next one above or below a position, or the end of the range.
  double neighbour(double position, bool above) const;
  // All of these, in order.
  std::vector<double> positions() const;
  bool turns() const { return motion == Motion::rotate; }
  bool folds() const { return motion == Motion::fold; }
  // "deg", "m" or "share".
  std::string_view unit() const;
  // "20 surfaces rotate from 0 to 90 deg in steps of 1, at rest at 0: BlockBeam"
  std::string describe() const;
};

// Reads every GPUShading:MovingShade of a model. Throws Error, naming object, field and value.
// `surroundings`: the types of shading surfaces that EnergyPlus does not see, by name.
std::vector<MovingShade> read_moving_shades(std::vector<InputObject> const& objects,
                                            ShadingInput const& input,
                                            std::map<std::string, std::string> const& surroundings);

// Sets positions at rest: "Louvres=40,Awning=0.5". Throws Error, naming `option`.
void set_rest(std::vector<MovingShade>& shades, std::string const& option,
              std::string const& positions);

}  // namespace gpu_shading::energyplus
