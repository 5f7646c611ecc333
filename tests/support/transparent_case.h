#pragma once

#include <cmath>
#include <memory>
#include <vector>

#include "gpu_shading/transmittance.h"
#include "support/shapes.h"

// The transparent case of Jones & Greenberg: a horizontal square receiver of 1 m, a shade of equal
// size 0.1 m above it, and the sun of a year at 42 degrees north.
namespace gpu_shading {

// Two panes of 5.7 mm, 48 % at normal incidence: the shape of a double glazing's curve over the
// cosine, 0 at grazing incidence.
inline Transmittance two_panes() {
  return Transmittance::polynomial_in_cosine({0.0, 0.61, 1.07, -2.28, 1.08});
}

inline Scene transparent_case() {
  Scene scene;
  scene.add({"receiver", level(0, 0, 0, 1, 1)});
  scene.add({"shade",
             level(0, 0, 0.1, 1, 1),
             Casting::always,
             {{AngularTransmittance{std::make_shared<Transmittance const>(two_panes())}}}});
  return scene;
}

// Exact sunlit fraction times the cosine (PSSF): the shadow is the shifted square.
inline double transparent_case_pssf(SunDirection sun) {
  double const slid = 0.1 / std::tan(sun.altitude);
  double const covered = std::max(0.0, 1.0 - std::abs(slid * std::sin(sun.azimuth))) *
                         std::max(0.0, 1.0 - std::abs(slid * std::cos(sun.azimuth)));
  double const tau = two_panes()(0.5 * std::numbers::pi - sun.altitude);
  return std::sin(sun.altitude) * (1.0 - covered * (1.0 - tau));
}

// Where the sun is up, every 6 minutes of a year's solar time; the declination after Cooper (1969).
inline std::vector<SunDirection> year_of_suns(double latitude) {
  std::vector<SunDirection> suns;
  for (int day = 1; day <= 365; ++day) {
    double const declination =
        23.45 * degree * std::sin(2.0 * std::numbers::pi * (284 + day) / 365);
    for (int step = 0; step < 240; ++step) {
      double const hour_angle = 15.0 * degree * (0.1 * step - 12.0);
      glm::dvec3 const sun(-std::cos(declination) * std::sin(hour_angle),
                           std::sin(declination) * std::cos(latitude) -
                               std::cos(declination) * std::cos(hour_angle) * std::sin(latitude),
                           std::sin(declination) * std::sin(latitude) +
                               std::cos(declination) * std::cos(hour_angle) * std::cos(latitude));
      if (sun.z > 0.0) suns.push_back(to_direction(sun));
    }
  }
  return suns;
}

}  // namespace gpu_shading
