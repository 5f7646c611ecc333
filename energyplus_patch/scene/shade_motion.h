#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <vector>

#include "gpu_shading/polygon.h"
#include "gpu_shading/scene.h"
#include "model/input/moving_shades.h"
#include "model/input/screen_maker.h"

// Where the surfaces of a GPUShading:MovingShade stand at its positions.
namespace gpu_shading::energyplus {

// Moves a point of a surface from where it is drawn.
using PointMotion = std::function<glm::dvec3(glm::dvec3 const&)>;
PointMotion motion_of(Polygon const& drawn, MovingShade const& shade, double position);

// The polygon of a surface, from where it is drawn.
Polygon moved(Polygon const& drawn, MovingShade const& shade, double position);

// Where texture coordinates of a mesh lie then. With Slide and Rotate.
TextureAxes moved(TextureAxes const& drawn, MovingShade const& shade, double position);

// For TrackSun: throws Error unless surfaces with an area face the sun at the same positions, to a
// degree or a step.
void expect_parallel(std::vector<Surface> const& drawn, MovingShade const& shade);

// Of Fold, from the panels as they are drawn. Throws Error.
MovingShade::Track fold_track(std::vector<Polygon> const& drawn, MovingShade const& shade);

// An axis of Rotate; the direction is a unit vector.
struct RotationAxis {
  glm::dvec3 point;
  glm::dvec3 direction;
};
RotationAxis rotation_axis(Polygon const& drawn, MovingShade const& shade);

// The position, within 180 degrees of the drawn one, at which a surface of Rotate faces the sun as
// far as its axis allows. Another 180 degrees turn its other side to the sun. 0 if the sun is in
// line with the axis.
double facing_position(Polygon const& drawn, MovingShade const& shade,
                       glm::dvec3 const& towards_sun);

}  // namespace gpu_shading::energyplus
