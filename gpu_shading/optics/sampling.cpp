#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "gpu_shading/error.h"
#include "gpu_shading/transmittance.h"

namespace gpu_shading {
namespace {

double angle_at(double u) {
  double const root = 1.0 - u * u;
  return root > 0.0 ? std::acos(root * root) : std::numbers::pi / 2.0;
}

}  // namespace

std::vector<float> sample(Transmittance const& model, int samples) {
  if (samples < 2) throw Error(fmt::format("{} samples, expected 2 or more", samples));
  std::vector<float> values;
  values.reserve(static_cast<std::size_t>(samples));
  for (int i = 0; i < samples; ++i) {
    values.push_back(static_cast<float>(model(angle_at(static_cast<double>(i) / (samples - 1)))));
  }
  return values;
}

double sampling_error(Transmittance const& model, std::span<float const> samples) {
  double error = 0.0;
  auto const steps = static_cast<double>(samples.size() - 1);
  for (std::size_t i = 0; i + 1 < samples.size(); ++i) {
    // A chord is farthest from a smooth curve near its middle; the quarters detect a kink.
    for (double const t : {0.0, 0.25, 0.5, 0.75, 1.0}) {
      double const exact = model(angle_at((static_cast<double>(i) + t) / steps));
      double const interpolated =
          std::lerp(static_cast<double>(samples[i]), static_cast<double>(samples[i + 1]), t);
      error = std::max(error, std::abs(exact - interpolated));
    }
  }
  return error;
}

int samples_within(Transmittance const& model, double tolerance) {
  constexpr int most = 4097;
  int samples = 2;
  while (samples < most && sampling_error(model, sample(model, samples)) > tolerance) {
    samples = 2 * samples - 1;
  }
  return samples;
}

}  // namespace gpu_shading
