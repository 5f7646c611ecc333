// Errors of sampled answers in scenes that are invented by seed, against exact references.
//
//     error_campaign [--check] [SCENES OF A FAMILY [FIRST SEED [FAMILY]]]
//
// For each target: the 99th percentile and the largest of true errors, in targets; the shares of
// views, in %, whose true error exceeds the target ("beyond") or the stated error ("under"), whose
// stated error exceeds five times the true one ("over"), and whose stated error exceeds the target
// ("miss"); and milliseconds of one core a view.
//
// --check: exits with 1 unless errors are within their targets and stated well. Leaves out 1e-4.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "gpu_shading/renderer.h"
#include "platform/parallel.h"
#include "support/exact.h"
#include "support/invented_scenes.h"
#include "support/processor_time.h"
#include "support/shapes.h"
#include "table_main.h"

namespace gpu_shading {
namespace {

constexpr int suns_a_scene = 8;

// Of sampled views at one target.
class Errors {
 public:
  explicit Errors(double target) : target_(target) {}

  double target() const { return target_; }

  void add(double true_error, double stated, double seconds) {
    // Of coordinates to 10 nm, and of outlines in single precision.
    constexpr double rounding = 1e-6;
    true_errors_.push_back(true_error / target_);
    understated_ += true_error > stated + rounding ? 1 : 0;
    overstated_ += stated > 5.0 * true_error + rounding ? 1 : 0;
    missed_ += stated > target_ ? 1 : 0;
    seconds_ += seconds;
  }
  void add(Errors const& other) {
    true_errors_.insert(true_errors_.end(), other.true_errors_.begin(), other.true_errors_.end());
    understated_ += other.understated_;
    overstated_ += other.overstated_;
    missed_ += other.missed_;
    seconds_ += other.seconds_;
  }

  std::ptrdiff_t beyond(double targets) const {
    return std::ranges::count_if(true_errors_, [&](double error) { return error > targets; });
  }

  void print() {
    std::ranges::sort(true_errors_);
    std::size_t const last = std::max<std::size_t>(true_errors_.size(), 1) - 1;
    auto const error_at = [&](std::size_t i) {
      return true_errors_.empty() ? 0.0 : true_errors_[i];
    };
    std::printf("  %6.2f %6.2f %6.2f %6.2f %6.1f %5.1f %7.3f", error_at(last * 99 / 100),
                error_at(last), 100.0 * share(beyond(1.0)), 100.0 * share(understated_),
                100.0 * share(overstated_), 100.0 * share(missed_), 1e3 * seconds_ * share(1));
  }

  // What a few views of a family may show.
  bool are_within() const { return beyond(1.0) <= 1 && beyond(3.0) == 0; }
  // And those of all families.
  bool are_well_stated() const {
    return share(beyond(1.0)) <= 0.01 && share(understated_) <= 0.02 && share(overstated_) <= 0.6 &&
           missed_ == 0;
  }

 private:
  double share(std::ptrdiff_t views) const {
    return static_cast<double>(views) /
           static_cast<double>(std::max<std::size_t>(1, true_errors_.size()));
  }

  double target_;
  std::vector<double> true_errors_;  // in targets
  int understated_ = 0;
  int overstated_ = 0;
  int missed_ = 0;
  double seconds_ = 0.0;
};

std::vector<Sunlit> answers_of(Renderer& renderer, InventedScene const& invented,
                               SunDirection sun) {
  if (invented.interiors.empty()) return {sunlit(renderer, sun, 0)};
  return renderer.interior_sunlit_areas(sun, 0, invented.interiors);
}

// Views with a caster, all of them sampled.
void add_scene(InventedScene const& invented, std::vector<Errors>& errors) {
  Scene const& scene = invented.scene;
  std::vector<ReferenceFractions> references;
  for (SunDirection const sun : invented.suns) references.push_back(invented.reference(scene, sun));
  for (Errors& at_target : errors) {
    RendererOptions options;
    options.device = on_cpu;
    options.error = at_target.target();
    options.samples_only = true;
    Renderer renderer(scene, options);
    for (std::size_t i = 0; i < references.size(); ++i) {
      auto const& [exact, error] = references[i];
      if (exact.empty()) continue;
      double const start = processor_seconds();
      auto const answers = answers_of(renderer, invented, invented.suns[i]);
      double const seconds = processor_seconds() - start;
      double const stated = answers.front().error.value();
      if (stated == 0.0) continue;  // without a caster
      auto const found = fractions_of(answers, exact::projected_area(scene, invented.suns[i], 0));
      double off = 0.0;
      for (std::size_t k = 0; k < exact.size(); ++k) {
        off = std::max(off, std::abs(found[k] - exact[k]) - error);
      }
      at_target.add(off, stated, seconds);
    }
  }
}

void print_row(char const* name, std::vector<Errors>& errors) {
  std::printf("%-24s", name);
  for (Errors& each : errors) each.print();
  std::printf("\n");
  std::fflush(stdout);
}

struct Campaign {
  std::vector<double> targets{1e-2, 1e-3, 1e-4};
  int scenes = 20;  // of a family
  std::uint32_t first_seed = 1;
  std::string family;  // all if empty

  // Prints a table; returns whether errors are within the limits.
  bool run() const {
    limit_threads(1);
    std::printf("%-24s", "");
    for (double const target : targets) std::printf("  target %-42g", target);
    std::printf("\n%-24s", "family");
    for (std::size_t i = 0; i < targets.size(); ++i) {
      std::printf("  %6s %6s %6s %6s %6s %5s %7s", "99th", "most", "beyond", "under", "over",
                  "miss", "ms");
    }
    std::printf("\n");
    std::vector<Errors> all(targets.begin(), targets.end());
    bool within = true;
    for (SceneFamily const& each : scene_families()) {
      if (!family.empty() && family != each.name) continue;
      std::vector<Errors> errors(targets.begin(), targets.end());
      for (int i = 0; i < scenes; ++i) {
        add_scene(each.invent(first_seed + static_cast<std::uint32_t>(i), suns_a_scene), errors);
      }
      for (std::size_t i = 0; i < targets.size(); ++i) all[i].add(errors[i]);
      within = within && std::ranges::all_of(errors, &Errors::are_within);
      print_row(each.name, errors);
    }
    print_row("all", all);
    return within && std::ranges::all_of(all, &Errors::are_well_stated);
  }
};

}  // namespace
}  // namespace gpu_shading

int main(int count, char** arguments) {
  std::vector<std::string> given(arguments + 1, arguments + count);
  gpu_shading::Campaign campaign;
  bool const check = !given.empty() && given.front() == "--check";
  if (check) {
    given.erase(given.begin());
    campaign.targets.pop_back();
    campaign.scenes = 4;
  }
  if (!given.empty()) campaign.scenes = std::atoi(given[0].c_str());
  if (given.size() > 1)
    campaign.first_seed = static_cast<std::uint32_t>(std::atoi(given[1].c_str()));
  if (given.size() > 2) campaign.family = given[2];
  bool within = true;
  int const failed =
      gpu_shading::print_or_say_why("error_campaign", [&] { within = campaign.run(); });
  return failed != 0 || (check && !within) ? 1 : 0;
}
