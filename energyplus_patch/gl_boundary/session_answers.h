#pragma once

#include <functional>
#include <string>
#include <vector>

#include "gl_boundary/boundary_answers.h"
#include "session/session.h"

namespace gpu_shading::energyplus {

// Answers of a session, for a model that is known. Its schedules are not: the time of a question
// does not reach OpenGL.
class SessionAnswers : public BoundaryAnswers {
 public:
  struct Input {
    Model model;
    std::vector<Surface> named;  // as EnergyPlus lists them
    Messages messages;
    std::function<double()> latitude;  // of the site, in radians
  };

  explicit SessionAnswers(Input input);

  void set_model(std::span<glm::vec3 const> vertices,
                 std::span<DrawnRange const> surfaces) override;
  double sunlit_area(glm::dvec3 const& towards_sun, std::size_t surface) override;
  std::vector<double> interior_areas(glm::dvec3 const& towards_sun, std::size_t window,
                                     std::vector<std::size_t> const& interiors) override;

  // As Session::finish().
  void finish();

 private:
  void set_sun(glm::dvec3 const& towards_sun);

  Input input_;
  Session session_;
  glm::dvec3 sun_{0.0};
};

}  // namespace gpu_shading::energyplus
