// Cost of a view of louvres drawn by OpenGL and computed on the CPU, one view at a time, and the
// difference between the two.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>
#include <vector>

#include "support/crowds.h"
#include "support/processor_time.h"
#include "support/shapes.h"
#include "table_main.h"

namespace gpu_shading {
namespace {

constexpr int directions = 40;

struct Cost {
  double seconds = 0.0;
  double processor = 0.0;
  std::vector<double> fractions;
};

Cost cost(Scene const& scene, DeviceChoice how) {
  RendererOptions options;
  options.device = how;
  Renderer renderer(scene, options);
  sunlit(renderer, sun_at(180, 45), 0);  // creates the target and the receiver's tile
  Cost cost;
  double const before = renderer.statistics().seconds;
  double const processor = processor_seconds();
  for (int i = 0; i < directions; ++i) {
    double const area = sunlit(renderer, sun_at(100 + 4 * i, 5 + 1.5 * i), 0).projected_area;
    cost.fractions.push_back(area / 6.0);
  }
  cost.processor = (processor_seconds() - processor) / directions;
  cost.seconds = (renderer.statistics().seconds - before) / directions;
  return cost;
}

void print_table() {
  std::printf("%s\n", Renderer(fine_louvres(1, 0.5), {}).device().renderer.c_str());
  std::printf("          milliseconds a view (of processors)               difference of PSSF\n");
  std::printf("louvres         drawn            counted    drawn/counted     mean      most\n");
  for (int const count : {1, 20, 200, 1000, 8000, 32000}) {
    Scene const scene = fine_louvres(count, 0.5);
    Cost const drawn = cost(scene, by_opengl);
    Cost const counted = cost(scene, on_cpu);
    double mean = 0.0;
    double most = 0.0;
    for (std::size_t i = 0; i < drawn.fractions.size(); ++i) {
      double const difference = std::abs(drawn.fractions[i] - counted.fractions[i]);
      mean += difference / directions;
      most = std::max(most, difference);
    }
    std::printf("%7d  %8.3f (%8.3f) %8.3f (%7.3f)  %5.1f (%5.1f)  %.1e   %.1e\n", count,
                1e3 * drawn.seconds, 1e3 * drawn.processor, 1e3 * counted.seconds,
                1e3 * counted.processor, drawn.seconds / counted.seconds,
                drawn.processor / counted.processor, mean, most);
    std::fflush(stdout);
  }
}

}  // namespace
}  // namespace gpu_shading

int main() { return gpu_shading::print_or_say_why("opaque_cost", gpu_shading::print_table); }
