#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "calculation/session.h"
#include "routes/opengl/queries/boundary_answers.h"
#include "scene/schedules.h"
#include "tasks/asked_task.h"

namespace gpu_shading::energyplus {

// Answers of a session, for a model that is known.
class SessionAnswers : public BoundaryAnswers {
 public:
  struct Input {
    Model model;
    std::vector<Surface> named;  // as EnergyPlus lists them
    Messages messages;
    std::function<double()> latitude;  // of the site, in radians
    Schedules schedules;               // needed where the model's shades have any
    // The time that a direction to the sun stands for; needed for schedules. Nothing where it is
    // not known.
    std::function<std::optional<Moment>(glm::dvec3 const&)> time_of;
    // That EnergyPlus is run for, if it is: set_model() does it, and throws TaskDone.
    std::shared_ptr<AskedTask> task;
  };

  explicit SessionAnswers(Input input);

  void set_model(std::span<glm::vec3 const> vertices,
                 std::span<DrawnRange const> surfaces) override;
  double sunlit_area(glm::dvec3 const& towards_sun, std::size_t surface) override;
  std::vector<double> interior_areas(glm::dvec3 const& towards_sun, std::size_t window,
                                     std::vector<std::size_t> const& interiors) override;

  // Replies to the task, if there is one, that it cannot be done.
  void fail(std::string const& why);

  // As Session::finish().
  void finish();

 private:
  void warn_of_mirrored() const;
  void set_time(SunDirection sun);
  void set_sun(glm::dvec3 const& towards_sun);

  Input input_;
  Session session_;
  glm::dvec3 sun_{0.0};
};

}  // namespace gpu_shading::energyplus
