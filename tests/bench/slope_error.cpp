// Errors of the sunlit fraction behind edges of one slope, at all pitches, against exact polygons.
//
//   slope_error [target [step]]    1e-3, and pitches in steps of 0.1 degrees, when left out

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "support/sloped_shades.h"
#include "table_main.h"

namespace gpu_shading {
namespace {

// All pitches before all receivers; a scene is one of each.
void print_row(SlopedShades shades, double target, double step, bool samples_only) {
  std::vector<SunDirection> const suns = suns_over_edges(20);
  double most = 0.0;
  double beyond = 0.0;
  double worst = 0.0;
  int scenes = 0;
  for (auto const receiver : SlopedShades::receivers) {
    shades.receiver = receiver;
    for (int i = 1; i * step < 90.0; ++i) {
      shades.pitch = i * step;
      SlopeErrors errors;
      errors.add(shades, suns, target, samples_only);
      most = std::max(most, errors.most());
      beyond += errors.beyond(target);
      worst = std::max(worst, errors.beyond(target));
      ++scenes;
    }
  }
  std::printf("%-8s  %-9s  %-10s  %6d %9.1e %8.3f %8.1f\n", samples_only ? "samples" : "default",
              SlopedShades::name(shades.shade), SlopedShades::name(shades.beam), scenes, most,
              100.0 * beyond / scenes, 100.0 * worst);
  std::fflush(stdout);
}

void print_table(double target, double step) {
  std::printf("CPU rasteriser, target %g, pitches every %g degrees\n", target, step);
  std::printf("answers   shade      beam        scenes   largest beyond %% worst %% of a scene\n");
  for (bool const samples_only : {false, true}) {
    for (auto const shade : SlopedShades::shades) {
      for (auto const beam : SlopedShades::beams) {
        print_row({SlopedShades::receivers.front(), shade, beam}, target, step, samples_only);
      }
    }
  }
}

}  // namespace
}  // namespace gpu_shading

int main(int argc, char** argv) {
  return gpu_shading::print_or_say_why("slope_error", [&] {
    double const target = argc > 1 ? std::atof(argv[1]) : 1e-3;
    double const step = argc > 2 ? std::atof(argv[2]) : 0.1;
    gpu_shading::print_table(target, step > 0.0 ? step : 0.1);
  });
}
