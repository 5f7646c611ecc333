#include "opengl32/run_answers.h"

#include <windows.h>

#include <cstdio>
#include <cstdlib>
#include <string>

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

}  // namespace

std::unique_ptr<BoundaryAnswers> answers_of_run() {
  stay_loaded();
  return std::make_unique<RenderedModel>(options_of_environment());
}

void end_run(std::exception const& error) {
  std::fprintf(stderr, "gpu_shading: error: %s\n", error.what());
  std::fflush(stderr);
  ExitProcess(EXIT_FAILURE);
}

}  // namespace gpu_shading::energyplus
