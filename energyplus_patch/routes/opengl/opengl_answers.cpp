#include "routes/opengl/opengl_answers.h"

#include <cstdlib>
#include <string>
#include <utility>

#include "gpu_shading/error.h"
#include "routes/opengl/queries/rendered_model.h"

namespace gpu_shading::energyplus {
namespace {

RendererOptions options_of_environment() {
  constexpr char const* variable = "GPU_SHADING_ERROR";
  RendererOptions options;
  options.device.device = DeviceId{};
  char const* const given = std::getenv(variable);
  if (given == nullptr || *given == '\0') return options;
  char* end = nullptr;
  double const error = std::strtod(given, &end);
  if (*end != '\0' || !(error >= RendererOptions::min_error) ||
      error > RendererOptions::max_error) {
    throw Error(std::string(variable) + " is '" + given + "': expected a number, 1e-5 to 0.1");
  }
  options.error = error;
  return options;
}

// The session of this run, which outlives EnergyPlus's contexts.
std::unique_ptr<SessionAnswers>& session() {
  static std::unique_ptr<SessionAnswers> instance;
  return instance;
}

// Passes a context's questions on to the session.
class OfSession : public BoundaryAnswers {
 public:
  void set_model(std::span<glm::vec3 const> vertices,
                 std::span<DrawnRange const> surfaces) override {
    session()->set_model(vertices, surfaces);
  }
  double sunlit_area(glm::dvec3 const& towards_sun, std::size_t surface) override {
    return session()->sunlit_area(towards_sun, surface);
  }
  std::vector<double> interior_areas(glm::dvec3 const& towards_sun, std::size_t window,
                                     std::vector<std::size_t> const& interiors) override {
    return session()->interior_areas(towards_sun, window, interiors);
  }
};

}  // namespace

void answer_with(SessionAnswers::Input input) {
  session() = std::make_unique<SessionAnswers>(std::move(input));
}

void finish_answers() {
  auto const finished = std::move(session());
  if (finished) finished->finish();
}

void fail_task(std::string const& why) {
  if (session()) session()->fail(why);
}

std::unique_ptr<BoundaryAnswers> answers_of_run() {
  if (session()) return std::make_unique<OfSession>();
  return std::make_unique<RenderedModel>(options_of_environment());
}

}  // namespace gpu_shading::energyplus
