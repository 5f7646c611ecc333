#include "opengl32/run_answers.h"

#include <windows.h>

#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>

#include "gl_boundary/rendered_model.h"
#include "gpu_shading/error.h"

namespace gpu_shading::energyplus {
namespace {

// The library's threads must not lose their code when GLFW unloads it.
void stay_loaded() {
  HMODULE self = nullptr;
  GetModuleHandleExA(GET_MODULE_HANDLE_EX_FLAG_PIN | GET_MODULE_HANDLE_EX_FLAG_FROM_ADDRESS,
                     reinterpret_cast<char const*>(&stay_loaded), &self);
}

RendererOptions options_of_environment() {
  constexpr char const* variable = "GPU_SHADING_ERROR";
  RendererOptions options;
  options.device.kind = DeviceChoice::Kind::cpu;
  char const* const given = std::getenv(variable);
  if (given == nullptr || *given == '\0') return options;
  char* end = nullptr;
  double const error = std::strtod(given, &end);
  if (*end != '\0' || !(error >= RendererOptions::least_error) ||
      error > RendererOptions::most_error) {
    throw Error(std::string(variable) + " is '" + given + "': expected a number, 1e-5 to 0.1");
  }
  options.error = error;
  return options;
}

// The session of this process, which outlives EnergyPlus's contexts.
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
  if (session()) session()->finish();
}

std::unique_ptr<BoundaryAnswers> answers_of_run() {
  stay_loaded();
  if (session()) return std::make_unique<OfSession>();
  return std::make_unique<RenderedModel>(options_of_environment());
}

void end_run(std::exception const& error) {
  std::fprintf(stderr, "gpu_shading: error: %s\n", error.what());
  std::fflush(stderr);
  ExitProcess(EXIT_FAILURE);
}

}  // namespace gpu_shading::energyplus
