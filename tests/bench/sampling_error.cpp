// Sunlit fractions from samples against closed forms, over a year of sun positions, by latitude,
// samples and kind of shade: the mean error, that of the worst window and its estimate by the
// samples alone, the largest error, and the error of the year's beam.
//
//   sampling_error [every [samples]]    one day in so many, 5 when left out; one kind of samples

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <string_view>

#include "support/shaded_window.h"
#include "table_main.h"

namespace gpu_shading::shaded_window {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

struct Mode {
  char const* name;
  Sampling sampling;
};

constexpr std::array<Mode, 6> modes{{{"fine", {Sampling::Density::fine, false}},
                                     {"medium", {Sampling::Density::medium, false}},
                                     {"coarse", {Sampling::Density::coarse, false}},
                                     {"paper-fine", {Sampling::Density::fine, true}},
                                     {"paper-medium", {Sampling::Density::medium, true}},
                                     {"paper-coarse", {Sampling::Density::coarse, true}}}};

double expected_worst(SampledSunlit const& sampled) {
  auto const& errors = sampled.expected_errors();
  return errors.empty() ? 0.0 : *std::max_element(errors.begin(), errors.end());
}

void print_row(double latitude, Mode const& mode, Scene const& scene,
               std::vector<SunDirection> const& suns) {
  auto const start = std::chrono::steady_clock::now();
  SampledSunlit const sampled(mode.sampling, latitude * degree, receivers_of(scene.windows),
                              source_of(scene.windows));
  double const seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  auto const errors = errors_of(sampled, scene.windows, suns);
  std::printf("%6.1f  %-13s %-22s %8zu %9.4f %9.4f %9.4f %8.3f %9.2f %8.2f\n", latitude, mode.name,
              scene.name.c_str(), sampled.directions().size(), errors.mean, errors.worst,
              expected_worst(sampled), errors.largest, 100.0 * errors.beam, seconds);
  std::fflush(stdout);
}

void print_table(int every, std::string_view only) {
  std::printf("closed forms\n");
  std::printf(
      "latitude samples     shade               directions mean error   worst estimated largest  "
      "beam "
      "%% seconds\n");
  for (double const latitude : {0.0, 42.0, 66.5, 80.0, -35.0}) {
    auto const suns = year_of_suns(latitude * degree, every);
    for (auto const& mode : modes) {
      if (!only.empty() && only != mode.name) continue;
      for (auto const& scene : scenes()) print_row(latitude, mode, scene, suns);
    }
  }
}

}  // namespace
}  // namespace gpu_shading::shaded_window

int main(int argc, char** argv) {
  return gpu_shading::print_or_say_why("sampling_error", [&] {
    int const every = argc > 1 ? std::atoi(argv[1]) : 5;
    gpu_shading::shaded_window::print_table(std::max(1, every), argc > 2 ? argv[2] : "");
  });
}
