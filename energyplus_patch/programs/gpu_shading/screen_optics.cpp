#include <fmt/format.h>

#include <cmath>
#include <glm/trigonometric.hpp>

#include "programs/gpu_shading/screen_files.h"

namespace gpu_shading::energyplus {

double transmittance(PerforatedScreen const& screen, double theta, double phi) {
  auto const& pattern = screen.pattern();
  if (!pattern) return screen.transmittance()(glm::radians(theta), glm::radians(phi));
  double const shift = screen.sheet().thickness * std::tan(glm::radians(theta));
  return pattern->transmittance(shift * std::cos(glm::radians(phi)),
                                shift * std::sin(glm::radians(phi)));
}

void write_transmittances(PerforatedScreen const& screen, std::ostream& csv) {
  constexpr int last_theta = 89;
  constexpr int phi_step = 5;
  constexpr int circle = 360;
  csv << "theta [deg],phi [deg],tau [-]\n";
  for (int theta = 0; theta <= last_theta; ++theta) {
    for (int phi = 0; phi < circle; phi += phi_step) {
      csv << fmt::format("{},{},{:.6f}\n", theta, phi, transmittance(screen, theta, phi));
    }
  }
}

}  // namespace gpu_shading::energyplus
