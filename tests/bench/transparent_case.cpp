// The transparent case of Jones & Greenberg over a year: error of the projected sunlit surface
// fraction against its closed form, and seconds, by resolution.
//
//   transparent_case [every]    one position in so many; all when left out

#include "support/transparent_case.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>

#include "support/pixel_count.h"
#include "table_main.h"

namespace gpu_shading {
namespace {

void print_row(std::vector<SunDirection> const& suns, std::size_t every, int resolution) {
  PixelCount renderer(transparent_case(),
                      {.device = {}, .resolution = resolution, .samples_only = true});
  double signed_mean = 0.0;
  double counted_mean = 0.0;
  double mean = 0.0;
  double most = 0.0;
  std::size_t positions = 0;
  auto const start = std::chrono::steady_clock::now();
  for (std::size_t i = 0; i < suns.size(); i += every) {
    auto const [answered, counted] = renderer.areas(suns[i], 0);
    double const exact = transparent_case_pssf(suns[i]);
    double const error = answered - exact;
    signed_mean += error;
    mean += std::abs(error);
    counted_mean += std::abs(counted - exact);
    most = std::max(most, std::abs(error));
    ++positions;
  }
  double const seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  auto const n = static_cast<double>(positions);
  std::printf("%10d %9zu %+11.2e %9.2e %9.2e %20.2e %8.1f\n", resolution, positions,
              signed_mean / n, mean / n, most, counted_mean / n, seconds);
  std::fflush(stdout);
}

void print_table(std::size_t every) {
  std::vector<SunDirection> const suns = year_of_suns(42 * degree);
  std::printf("%s\n", renderer_of(transparent_case()).device().renderer.c_str());
  std::printf("resolution positions signed mean  mean abs   largest mean abs of N x Ap  seconds\n");
  for (int const resolution : {128, 256, 512, 1024, 2048}) print_row(suns, every, resolution);
}

}  // namespace
}  // namespace gpu_shading

int main(int argc, char** argv) {
  return gpu_shading::print_or_say_why("transparent_case", [&] {
    int const every = argc > 1 ? std::atoi(argv[1]) : 1;
    gpu_shading::print_table(static_cast<std::size_t>(std::max(1, every)));
  });
}
