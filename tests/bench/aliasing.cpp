// Errors behind shades that may alias with the grid of samples: louvres and fins against their
// exact sunlit fraction, and triangles at random against exact polygon clipping.
//
//     aliasing [ERROR]   one target error instead of four

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <random>
#include <string>
#include <vector>

#include "support/exact.h"
#include "support/regular_shades.h"
#include "support/shapes.h"
#include "table_main.h"

namespace gpu_shading {
namespace {

class Statistics {
 public:
  explicit Statistics(double target) : target_(target) {}

  void add_scene(std::vector<double> const& errors, double seconds) {
    double mean = 0.0;
    for (double const error : errors) {
      mean += error / static_cast<double>(errors.size());
      beyond_ += error > target_ ? 1 : 0;
      beyond_3_ += error > 3 * target_ ? 1 : 0;
    }
    worst_mean_ = std::max(worst_mean_, mean);
    errors_.insert(errors_.end(), errors.begin(), errors.end());
    seconds_ += seconds;
  }

  void print(std::string const& name) {
    std::sort(errors_.begin(), errors_.end());
    double mean = 0.0;
    for (double const error : errors_) mean += error / static_cast<double>(errors_.size());
    std::printf("%-7g %-20s %7zu %9.1e %9.1e %9.1e %9.1e %9.3f %6d %9.3f\n", target_, name.c_str(),
                errors_.size(), mean, errors_[errors_.size() * 99 / 100], errors_.back(),
                worst_mean_, 100.0 * beyond_ / static_cast<double>(errors_.size()), beyond_3_,
                1e3 * seconds_ / static_cast<double>(errors_.size()));
    std::fflush(stdout);
  }

 private:
  double target_;
  std::vector<double> errors_;
  double worst_mean_ = 0.0;
  int beyond_ = 0;
  int beyond_3_ = 0;
  double seconds_ = 0.0;
};

// CPU time of all threads of this process.
double processor_seconds() {
  std::timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

RendererOptions options_at(double error) {
  RendererOptions options;
  options.error = error;
  options.device = on_cpu;
  return options;
}

void print_blades(char const* name, bool upright, double error, double step, int least, int most) {
  Statistics statistics(error);
  std::vector<SunDirection> const suns = spread_suns(12);
  for (double const size : {0.5, 1.0, 3.0, 6.0, 12.0, 30.0}) {
    for (int const count : blade_counts(least, most, step, true)) {
      RegularShades const shades{count, upright, size};
      Renderer renderer(shades.scene(), options_at(error));
      double const whole = shades.width() * shades.height();
      std::vector<double> errors;
      double const start = processor_seconds();
      for (SunDirection const sun : suns) {
        double const cosine = -std::cos(sun.azimuth) * std::cos(sun.altitude);
        double const got = sunlit(renderer, sun, 0).projected_area / (whole * cosine);
        errors.push_back(std::abs(got - shades.sunlit_fraction(sun)));
      }
      statistics.add_scene(errors, processor_seconds() - start);
    }
  }
  statistics.print(std::string(name) + " " + std::to_string(least) + " to " + std::to_string(most));
}

// Opaque triangles of all sizes and ways in front of a receiver.
Scene soup(int count, std::uint32_t seed) {
  std::mt19937 generator(seed);
  auto const between = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(generator()) / std::mt19937::max();
  };
  Scene scene;
  scene.add({"receiver", south_facing(0, 0, 0, 3, 2)});
  for (int i = 0; i < count; ++i) {
    glm::dvec3 const corner(between(-1, 4), between(-2.0, -0.2), between(-0.5, 3.5));
    double const size = 6.0 / std::sqrt(count) * between(0.2, 1.0);
    auto const edge = [&] {
      return size * glm::dvec3(between(-0.5, 0.5), between(-0.09, 0.09), between(-0.5, 0.5));
    };
    glm::dvec3 const a = edge();
    scene.add({"leaf", {{corner, corner + a, corner + edge()}, {}}});
  }
  return scene;
}

void print_soups(double error, int scenes) {
  Statistics statistics(error);
  std::vector<SunDirection> const suns = spread_suns(20);
  for (int i = 0; i < scenes; ++i) {
    int const count = 200 + 1800 * i / std::max(scenes - 1, 1);
    Scene const scene = soup(count, static_cast<std::uint32_t>(1 + i));
    Renderer renderer(scene, options_at(error));
    std::vector<double> errors;
    double seconds = 0.0;
    for (SunDirection const sun : suns) {
      double const whole = exact::projected_area(scene, sun, 0);
      double const lit = exact::projected_sunlit_area(scene, sun, 0);
      double const start = processor_seconds();
      errors.push_back(std::abs(sunlit(renderer, sun, 0).projected_area - lit) / whole);
      seconds += processor_seconds() - start;
    }
    statistics.add_scene(errors, seconds);
  }
  statistics.print("triangles");
}

void print_table(std::vector<double> const& targets) {
  std::printf("%s\n", Renderer(Scene(), options_at(1e-3)).device().renderer.c_str());
  std::printf("%-7s %-20s %7s %9s %9s %9s %9s %9s %6s %9s\n", "target", "shades", "views", "mean",
              "99th", "max", "scene", "% beyond", "x 3", "ms");
  for (double const error : targets) {
    print_soups(error, 20);
    for (auto const& [least, most] :
         {std::pair(20, 500), std::pair(501, 2000), std::pair(2001, 5000)}) {
      print_blades("louvres", false, error, 1.05, least, most);
      print_blades("fins", true, error, 1.05, least, most);
    }
  }
}

}  // namespace
}  // namespace gpu_shading

int main(int count, char** arguments) {
  std::vector<double> targets{3e-3, 1e-3, 1e-4, 1e-5};
  if (count > 1) targets = {std::atof(arguments[1])};
  return gpu_shading::print_or_say_why("aliasing", [&] { gpu_shading::print_table(targets); });
}
