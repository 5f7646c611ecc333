// Errors behind shades that may alias with the grid of samples: louvres and fins against their
// exact sunlit fraction, perforated sheets and triangles at random against exact polygon clipping.
//
//     aliasing [--pixels] [--screens SEED] [ERROR [EVERY]]
//
// --pixels: at the centres of pixels, where OpenGL samples. --screens: only single perforated
// sheets, other ones for another seed (1 otherwise). One target error instead of four; one scene in
// so many.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "support/exact.h"
#include "support/pixels_on_cpu.h"
#include "support/processor_time.h"
#include "support/random_scene.h"
#include "support/regular_shades.h"
#include "support/regular_sheets.h"
#include "support/shapes.h"
#include "table_main.h"

namespace gpu_shading {
namespace {

class Statistics {
 public:
  explicit Statistics(double target) : target_(target) {}

  void add_scene(std::vector<double> const& errors, double seconds) {
    if (errors.empty()) return;
    double mean = 0.0;
    for (double const error : errors) {
      mean += error / static_cast<double>(errors.size());
      beyond_ += error > target_ ? 1 : 0;
      beyond_3_ += error > 3 * target_ ? 1 : 0;
    }
    auto const out = static_cast<double>(
        std::count_if(errors.begin(), errors.end(), [&](double error) { return error > target_; }));
    worst_share_ = std::max(worst_share_, out / static_cast<double>(errors.size()));
    worst_mean_ = std::max(worst_mean_, mean);
    errors_.insert(errors_.end(), errors.begin(), errors.end());
    seconds_ += seconds;
  }

  void print(std::string const& name) {
    std::sort(errors_.begin(), errors_.end());
    double mean = 0.0;
    for (double const error : errors_) mean += error / static_cast<double>(errors_.size());
    std::printf("%-7g %-26s %7zu %9.1e %9.1e %9.1e %9.1e %7.1f %9.3f %6d %9.3f\n", target_,
                name.c_str(), errors_.size(), mean, errors_[errors_.size() * 99 / 100],
                errors_.back(), worst_mean_, 100.0 * worst_share_,
                100.0 * beyond_ / static_cast<double>(errors_.size()), beyond_3_,
                1e3 * seconds_ / static_cast<double>(errors_.size()));
    std::fflush(stdout);
  }

 private:
  double target_;
  std::vector<double> errors_;
  double worst_mean_ = 0.0;
  double worst_share_ = 0.0;
  int beyond_ = 0;
  int beyond_3_ = 0;
  double seconds_ = 0.0;
};

// How a scene is computed.
struct How {
  double error;
  bool at_pixels;

  Renderer renderer(Scene scene) const {
    RendererOptions options;
    options.error = error;
    options.samples_only = true;
    options.device = on_cpu;
    return at_pixels ? counting_pixels(std::move(scene), options)
                     : Renderer(std::move(scene), options);
  }
};

// Number of scenes if one in `every` is taken.
int share_of(int scenes, int every) { return std::max(1, scenes / every); }

struct Blades {
  char const* name;
  bool upright;
  double transmittance;
};

// One in `every` of some numbers of blades before receivers of these sizes.
void print_blades(std::string const& numbers, Blades const& blades, How const& how, int every,
                  std::vector<int> const& counts, std::vector<double> const& sizes) {
  Statistics statistics(how.error);
  std::vector<SunDirection> const suns = spread_suns(12);
  int scene = 0;
  for (double const size : sizes) {
    for (int const count : counts) {
      if (scene++ % every != 0) continue;
      RegularShades const shades{count, blades.upright, size, blades.transmittance};
      Renderer renderer = how.renderer(shades.scene());
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
  statistics.print(std::string(blades.name) + " " + numbers);
}

// Every number up to 600, where one may alias and the next may not, and some above.
std::vector<int> dense_counts() {
  std::vector<int> counts;
  for (int count = 20; count <= 5000; count += count < 600 ? 1 : 23) counts.push_back(count);
  return counts;
}

void print_soups(How const& how, int scenes) {
  Statistics statistics(how.error);
  std::vector<SunDirection> const suns = spread_suns(20);
  for (int i = 0; i < scenes; ++i) {
    int const count = 200 + 1800 * i / std::max(scenes - 1, 1);
    Scene const scene = triangle_soup(count, static_cast<std::uint32_t>(1 + i));
    Renderer renderer = how.renderer(scene);
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

void print_screens(How const& how, int scenes, unsigned seed) {
  Statistics statistics(how.error);
  std::vector<SunDirection> const suns = spread_suns(30);
  std::mt19937 generator(seed);
  constexpr std::array sizes{0.5, 1.0, 3.0, 6.0};
  for (int i = 0; i < scenes; ++i) {
    double const size = sizes.at(generator() % sizes.size());
    RegularSheets const sheets(size, 0.7 * size, {random_sheet(generator)});
    double seconds = 0.0;
    Renderer renderer = how.renderer(sheets.scene());
    std::vector<double> const errors = errors_behind(sheets, renderer, suns, seconds);
    statistics.add_scene(errors, seconds);
  }
  statistics.print("screens");
}

void print_pairs(How const& how, int scenes) {
  Statistics statistics(how.error);
  std::vector<SunDirection> const suns = spread_suns(10);
  std::mt19937 generator(7);
  for (int i = 0; i < scenes; ++i) {
    RegularSheets const sheets(0.3, 0.21, random_pair(generator, i));
    double seconds = 0.0;
    Renderer renderer = how.renderer(sheets.scene());
    std::vector<double> const errors = errors_behind(sheets, renderer, suns, seconds);
    statistics.add_scene(errors, seconds);
  }
  statistics.print("pairs of screens");
}

// `screens_of`: only screens, of this seed.
void print_table(std::vector<double> const& targets, bool at_pixels, int every,
                 std::optional<unsigned> screens_of) {
  std::printf("CPU%s\n", at_pixels ? ", centres of pixels" : "");
  std::printf("%-7s %-26s %7s %9s %9s %9s %9s %7s %9s %6s %9s\n", "target", "shades", "views",
              "mean", "99th", "max", "scene", "share", "% beyond", "x 3", "ms");
  for (double const error : targets) {
    How const how{error, at_pixels};
    if (screens_of) {
      print_screens(how, share_of(200, every), *screens_of);
      continue;
    }
    print_soups(how, share_of(20, every));
    print_screens(how, share_of(200, every), 1);
    print_pairs(how, share_of(40, every));
    for (Blades const& blades : {Blades{"louvres", false, 0.0}, Blades{"fins", true, 0.0},
                                 Blades{"glass louvres", false, 0.4}}) {
      for (auto const& [least, most] :
           {std::pair(20, 500), std::pair(501, 2000), std::pair(2001, 5000)}) {
        std::string const numbers = std::to_string(least) + " to " + std::to_string(most);
        print_blades(numbers, blades, how, every, blade_counts(least, most, 1.05, true),
                     {0.5, 1.0, 3.0, 6.0, 12.0, 30.0});
      }
      print_blades("of any number", blades, how, every, dense_counts(), {3.0});
    }
  }
}

}  // namespace
}  // namespace gpu_shading

int main(int count, char** arguments) {
  std::vector<std::string> given(arguments + 1, arguments + count);
  bool const at_pixels = !given.empty() && given[0] == "--pixels";
  if (at_pixels) given.erase(given.begin());
  std::optional<unsigned> screens_of;
  if (given.size() > 1 && given[0] == "--screens") {
    screens_of = static_cast<unsigned>(std::atoi(given[1].c_str()));
    given.erase(given.begin(), given.begin() + 2);
  }
  std::vector<double> targets{3e-3, 1e-3, 1e-4, 1e-5};
  if (!given.empty()) targets = {std::atof(given[0].c_str())};
  int const every = given.size() > 1 ? std::max(1, std::atoi(given[1].c_str())) : 1;
  return gpu_shading::print_or_say_why(
      "aliasing", [&] { gpu_shading::print_table(targets, at_pixels, every, screens_of); });
}
