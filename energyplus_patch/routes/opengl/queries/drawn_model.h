#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "calculation/session.h"
#include "routes/opengl/queries/triangle_polygons.h"
#include "tasks/task_file.h"

namespace gpu_shading::energyplus {

// The model that EnergyPlus draws, and the shading calculation that answers what EnergyPlus's pixel
// counting asks about it. Surfaces are numbered in the order of set_model(); areas are in m2 normal
// to the beam. Functions throw gpu_shading::Error.
class DrawnModel {
 public:
  // A model that was read.
  struct Input {
    Model model;
    std::vector<Surface> named;  // as EnergyPlus lists them
    // Schedules are needed where the model's shades have any.
    Simulation simulation;
    // The time that a direction to the sun stands for; needed for schedules. Nothing where it is
    // not known.
    std::function<std::optional<Moment>(glm::dvec3 const&)> time_of;
    // That EnergyPlus is run for, if it is: set_model() does it, and throws TaskDone.
    std::shared_ptr<AskedTask> task;
  };
  explicit DrawnModel(Input input);

  // Of a model that is known by its triangles alone. `make`: makes a calculation without surfaces.
  using MakeCalculation = std::function<std::unique_ptr<ShadingCalculation>()>;
  explicit DrawnModel(MakeCalculation make) : make_(std::move(make)) {}

  // Before the first question: the triangles of all surfaces, in metres, and the vertices of each
  // surface, in order. Only a model without input can be set again.
  void set_model(std::span<glm::vec3 const> vertices, std::span<DrawnRange const> surfaces);

  double sunlit_area(glm::dvec3 const& towards_sun, std::size_t surface);

  // The areas that the sun lights of interior surfaces through a window, in order.
  std::vector<double> interior_areas(glm::dvec3 const& towards_sun, std::size_t window,
                                     std::vector<std::size_t> const& interiors);

  // As ShadingCalculation::fail(); replies to the task, if there is one, that it cannot be done.
  void fail(std::string const& why);

  // As ShadingCalculation::finish().
  void finish();

 private:
  void add_named(std::span<glm::vec3 const> vertices, std::span<DrawnRange const> surfaces);
  void add_outlines(std::span<glm::vec3 const> vertices, std::span<DrawnRange const> surfaces);
  void set_time(SunDirection sun);
  void set_sun(glm::dvec3 const& towards_sun);

  std::optional<Input> input_;
  MakeCalculation make_;
  std::unique_ptr<ShadingCalculation> calculation_;  // once there are surfaces
  std::vector<std::vector<SurfaceId>> parts_;        // by surface, in the calculation
  std::optional<glm::dvec3> sun_;
};

}  // namespace gpu_shading::energyplus
