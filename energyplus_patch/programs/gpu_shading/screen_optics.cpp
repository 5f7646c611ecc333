#include "programs/gpu_shading/screen_optics.h"

#include <cmath>
#include <glm/trigonometric.hpp>

namespace gpu_shading::energyplus {

double transmittance(PerforatedScreen const& screen, double theta, double phi) {
  auto const& pattern = screen.pattern();
  if (!pattern) return screen.transmittance()(glm::radians(theta), glm::radians(phi));
  double const shift = screen.sheet().thickness * std::tan(glm::radians(theta));
  return pattern->transmittance(shift * std::cos(glm::radians(phi)),
                                shift * std::sin(glm::radians(phi)));
}

}  // namespace gpu_shading::energyplus
