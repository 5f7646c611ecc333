#include "scene/perez_sky.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numeric>

#include "gpu_shading/sun_direction.h"
#include "scene/sky_grid.h"

namespace gpu_shading::energyplus {
namespace {

using std::numbers::pi;

// Directions in each patch, at equal steps of azimuth and of the sine of altitude.
constexpr int per_side = 4;
constexpr int per_patch = per_side * per_side;

struct Dome {
  std::vector<glm::dvec3> directions;  // per_patch for each patch
  std::vector<double> solid_angles;    // by patch, sr
};

Dome const& dome() {
  static auto const made = [] {
    Dome dome;
    for (auto const& centre : sky_patches()) {
      double const low = std::sin(centre.altitude - sky_step / 2.0);
      double const high = std::sin(centre.altitude + sky_step / 2.0);
      for (int i = 0; i < per_patch; ++i) {
        double const across = (i % per_side + 0.5) / per_side;
        double const up = (i / per_side + 0.5) / per_side;  // NOLINT(bugprone-integer-division)
        dome.directions.push_back(to_vector(
            {centre.azimuth + (across - 0.5) * sky_step, std::asin(low + up * (high - low))}));
      }
      dome.solid_angles.push_back((high - low) * sky_step);
    }
    return dome;
  }();
  return made;
}

// Coefficients 1 to 4 of the parameters a to e (table 1 of the paper).
using Row = std::array<std::array<double, 4>, 5>;
struct Bin {
  double clearness;  // the largest
  Row coefficients;
};
constexpr std::array<Bin, 8> bins{{
    {1.065,
     {{{1.3525, -0.2576, -0.2690, -1.4366},
       {-0.7670, 0.0007, 1.2734, -0.1233},
       {2.8000, 0.6004, 1.2375, 1.0000},
       {1.8734, 0.6297, 0.9738, 0.2809},
       {0.0356, -0.1246, -0.5718, 0.9938}}}},
    {1.230,
     {{{-1.2219, -0.7730, 1.4148, 1.1016},
       {-0.2054, 0.0367, -3.9128, 0.9156},
       {6.9750, 0.1774, 6.4477, -0.1239},
       {-1.5798, -0.5081, -1.7812, 0.1080},
       {0.2624, 0.0672, -0.2190, -0.4285}}}},
    {1.500,
     {{{-1.1000, -0.2515, 0.8952, 0.0156},
       {0.2782, -0.1812, -4.5000, 1.1766},
       {24.7219, -13.0812, -37.7000, 34.8438},
       {-5.0000, 1.5218, 3.9229, -2.6204},
       {-0.0156, 0.1597, 0.4199, -0.5562}}}},
    {1.950,
     {{{-0.5484, -0.6654, -0.2672, 0.7117},
       {0.7234, -0.6219, -5.6812, 2.6297},
       {33.3389, -18.3000, -62.2500, 52.0781},
       {-3.5000, 0.0016, 1.1477, 0.1062},
       {0.4659, -0.3296, -0.0876, -0.0329}}}},
    {2.800,
     {{{-0.6000, -0.3566, -2.5000, 2.3250},
       {0.2937, 0.0496, -5.6812, 1.8415},
       {21.0000, -4.7656, -21.5906, 7.2492},
       {-3.5000, -0.1554, 1.4062, 0.3988},
       {0.0032, 0.0766, -0.0656, -0.1294}}}},
    {4.500,
     {{{-1.0156, -0.3670, 1.0078, 1.4051},
       {0.2875, -0.5328, -3.8500, 3.3750},
       {14.0000, -0.9999, -7.1406, 7.5469},
       {-3.4000, -0.1078, -1.0750, 1.5702},
       {-0.0672, 0.4016, 0.3017, -0.4844}}}},
    {6.200,
     {{{-1.0000, 0.0211, 0.5025, -0.5119},
       {-0.3000, 0.1922, 0.7023, -1.6317},
       {19.0000, -5.0000, 1.2438, -1.9094},
       {-4.0000, 0.0250, 0.3844, 0.2656},
       {1.0468, -0.3788, -2.4517, 1.4656}}}},
    {INFINITY,
     {{{-1.0500, 0.0289, 0.4260, 0.3590},
       {-0.3250, 0.1156, 0.7781, 0.0025},
       {31.0625, -14.5000, -46.1148, 55.3750},
       {-7.2312, 0.4050, 13.3500, 0.6234},
       {1.5000, -0.6426, 1.8564, 0.5636}}}},
}};

struct Parameters {
  double a, b, c, d, e;
};

Parameters parameters_of(SkyWeather const& weather) {
  constexpr double solar_constant = 1367.0;  // W/m2
  double const zenith = std::acos(std::clamp(weather.towards_sun.z, 0.0, 1.0));
  double const cubed = 1.041 * zenith * zenith * zenith;
  double const clearness =
      std::max((1.0 + weather.beam / weather.diffuse + cubed) / (1.0 + cubed), 1.0);
  // Spencer (1971) and Kasten (1966).
  double const angle = 2.0 * pi * (weather.day_of_year - 1) / 365.0;
  double const eccentricity = 1.00011 + 0.034221 * std::cos(angle) + 0.00128 * std::sin(angle) +
                              0.000719 * std::cos(2.0 * angle) + 0.000077 * std::sin(2.0 * angle);
  double const air_mass =
      1.0 / (std::cos(zenith) + 0.15 * std::pow(93.885 - glm::degrees(zenith), -1.253));
  double brightness = std::max(weather.diffuse * air_mass / (solar_constant * eccentricity), 0.01);
  if (clearness > 1.065 && clearness < 2.8) brightness = std::max(brightness, 0.2);

  auto const bin = std::find_if(bins.begin(), bins.end() - 1,
                                [&](Bin const& one) { return clearness < one.clearness; });
  auto const& rows = bin->coefficients;
  auto const linear = [&](std::size_t row) {
    auto const& x = rows[row];
    return x[0] + x[1] * zenith + brightness * (x[2] + x[3] * zenith);
  };
  Parameters found{linear(0), linear(1), linear(2), linear(3), linear(4)};
  if (bin == bins.begin()) {
    auto const& c = rows[2];
    auto const& d = rows[3];
    found.c = std::exp(std::pow(brightness * (c[0] + c[1] * zenith), c[2])) - c[3];
    found.d = -std::exp(brightness * (d[0] + d[1] * zenith)) + d[2] + brightness * d[3];
  }
  return found;
}

}  // namespace

std::vector<double> perez_radiances(SkyWeather const& weather) {
  auto const [a, b, c, d, e] = parameters_of(weather);
  auto const& [directions, solid_angles] = dome();
  std::vector<double> radiances;
  double horizontal = 0.0;
  for (std::size_t patch = 0; patch < solid_angles.size(); ++patch) {
    double sum = 0.0;
    double height = 0.0;
    for (std::size_t i = patch * per_patch; i < (patch + 1) * per_patch; ++i) {
      auto const& direction = directions[i];
      double const cosine = std::clamp(glm::dot(direction, weather.towards_sun), -1.0, 1.0);
      double const radiance = (1.0 + a * std::exp(b / direction.z)) *
                              (1.0 + c * std::exp(d * std::acos(cosine)) + e * cosine * cosine);
      sum += std::max(radiance, 0.0);
      height += direction.z;
    }
    radiances.push_back(sum / per_patch);
    horizontal += radiances.back() * height * solid_angles[patch] / per_patch;
  }
  for (auto& radiance : radiances) radiance /= horizontal;
  return radiances;
}

std::vector<double> const& patch_solid_angles() { return dome().solid_angles; }

std::vector<double> patch_projections(glm::dvec3 const& normal) {
  auto const& [directions, solid_angles] = dome();
  std::vector<double> projections;
  for (std::size_t patch = 0; patch < solid_angles.size(); ++patch) {
    auto const first = directions.begin() + static_cast<std::ptrdiff_t>(patch * per_patch);
    projections.push_back(solid_angles[patch] / per_patch *
                          std::accumulate(first, first + per_patch, 0.0,
                                          [&](double sum, glm::dvec3 const& direction) {
                                            return sum + std::max(glm::dot(normal, direction), 0.0);
                                          }));
  }
  return projections;
}

}  // namespace gpu_shading::energyplus
