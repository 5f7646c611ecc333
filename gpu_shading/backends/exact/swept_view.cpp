#include "backends/exact/swept_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>
#include <utility>

#include "backends/exact/depth.h"
#include "backends/exact/edge_sweep.h"
#include "geometry/ring.h"

namespace gpu_shading {
namespace {

using Powers = std::vector<std::pair<int, int>>;

// Adds up what reaches each part of a receiver.
class Light {
 public:
  static constexpr std::size_t most_combinations = 64;

  // Begins anew.
  void start(std::size_t parts) {
    shades_.clear();
    depths_.clear();
    opaque_ = 0;
    receiving_ = false;
    passed_.clear();
    reached_.clear();
    combinations_.clear();
    sums_.resize(parts);
    for (Part& part : sums_) {
      part.plain = 0.0;
      part.scheduled.clear();
    }
    area_ = 0.0;
    doubtful_ = 0.0;
    too_many_ = false;
  }

  // Polygons are numbered: the receiver, the casters, and the interior surfaces.
  void add(Shade const& shade) { shades_.push_back(shade); }
  void add(Depth const& depth) { depths_.push_back(depth); }

  void toggle(std::uint32_t polygon, bool inside) {
    if (polygon == 0) {
      receiving_ = inside;
    } else if (polygon <= shades_.size()) {
      if (shades_[polygon - 1].transmittance > 0.0F) {
        change(passed_, polygon - 1, inside);
      } else {
        opaque_ += inside ? 1 : -1;
      }
    } else {
      change(reached_, polygon - 1 - static_cast<std::uint32_t>(shades_.size()), inside);
    }
  }

  bool wanted() const { return receiving_; }

  void cell(EdgeSweep::Cell const& cell) {
    double const area = cell.area();
    area_ += area;
    if (opaque_ > 0 || too_many_) return;
    std::size_t part = 0;
    if (!depths_.empty()) {
      if (reached_.empty()) return;
      part = nearest(cell, area);
    }
    if (passed_.empty()) {
      sums_[part].plain += area;
    } else {
      add_shaded(part, area);
    }
  }

  // In parts of the receiver; empty if there is a reason not to believe them.
  std::optional<std::vector<LuminanceSums>> result() const {
    constexpr double negligible = 1e-7;
    if (too_many_ || area_ <= 0.0 || doubtful_ > negligible * area_) return std::nullopt;
    std::vector<LuminanceSums> sums;
    sums.reserve(sums_.size());
    for (Part const& part : sums_) {
      LuminanceSums& sum = sums.emplace_back();
      sum.unscheduled = part.plain / area_;
      for (std::size_t i = 0; i < part.scheduled.size(); ++i) {
        if (part.scheduled[i] > 0.0) {
          sum.scheduled.push_back({combinations_[i], part.scheduled[i] / area_});
        }
      }
      std::sort(sum.scheduled.begin(), sum.scheduled.end(),
                [](auto const& a, auto const& b) { return a.powers < b.powers; });
    }
    return sums;
  }

 private:
  struct Part {
    double plain = 0.0;
    std::vector<double> scheduled;  // by combination
  };

  static void change(std::vector<std::uint32_t>& numbers, std::uint32_t number, bool inside) {
    if (inside) {
      numbers.push_back(number);
    } else {
      numbers.erase(std::find(numbers.begin(), numbers.end(), number));
    }
  }

  // The interior surface that a ray in the cell meets first; the first of those in one place.
  std::size_t nearest(EdgeSweep::Cell const& cell, double area) {
    if (reached_.size() == 1) return reached_.front();
    glm::dvec2 const middle = cell.middle();
    std::uint32_t found = reached_.front();
    for (std::uint32_t const other : reached_) {
      double const nearer = depths_[found].at(middle) - depths_[other].at(middle);
      if (nearer > same_place || (nearer >= -same_place && other < found)) found = other;
    }
    auto const behind = [&](glm::dvec2 const& corner) {
      double const depth = depths_[found].at(corner);
      return std::any_of(reached_.begin(), reached_.end(), [&](std::uint32_t other) {
        return depths_[other].at(corner) < depth - 2.0 * same_place;
      });
    };
    if (behind(cell.low_left) || behind(cell.low_right) || behind(cell.high_left) ||
        behind(cell.high_right)) {
      doubtful_ += area;
    }
    return found;
  }

  void add_shaded(std::size_t part, double area) {
    double product = area;
    powers_.clear();
    for (std::uint32_t const number : passed_) {
      Shade const& shade = shades_[number];
      product *= static_cast<double>(shade.transmittance);
      if (shade.schedule == Shade::unscheduled) continue;
      auto const place = std::find_if(powers_.begin(), powers_.end(), [&](auto const& power) {
        return power.first == shade.schedule;
      });
      if (place != powers_.end()) {
        ++place->second;
      } else {
        powers_.emplace_back(shade.schedule, 1);
      }
    }
    if (powers_.empty()) {
      sums_[part].plain += product;
      return;
    }
    std::sort(powers_.begin(), powers_.end());
    auto const known = std::find(combinations_.begin(), combinations_.end(), powers_);
    auto const number = static_cast<std::size_t>(known - combinations_.begin());
    if (known == combinations_.end()) {
      too_many_ = combinations_.size() == most_combinations;
      if (too_many_) return;
      combinations_.push_back(powers_);
    }
    std::vector<double>& scheduled = sums_[part].scheduled;
    if (scheduled.size() <= number) scheduled.resize(number + 1, 0.0);
    scheduled[number] += product;
  }

  std::vector<Shade> shades_;  // of casters
  std::vector<Depth> depths_;  // of interior surfaces
  int opaque_ = 0;             // opaque casters around a cell
  bool receiving_ = false;
  std::vector<std::uint32_t> passed_;   // other casters around it
  std::vector<std::uint32_t> reached_;  // interior surfaces around it
  std::vector<Powers> combinations_;
  Powers powers_;
  std::vector<Part> sums_;
  double area_ = 0.0;
  double doubtful_ = 0.0;  // area where surfaces pass through one another
  bool too_many_ = false;
};

// Adds the rings of a question's surfaces to a sweep.
class Outlines {
 public:
  void start(Projection const& projection) {
    constexpr double half = 0.5 + 1e-6;  // with room for rounding
    sweep_.start(glm::dvec2(-half), glm::dvec2(half));
    projection_ = &projection;
    count_ = 0;
  }

  void add(RelativePolygon const& polygon) {
    for (std::size_t i = 0; i < polygon.rings(); ++i) {
      places_.clear();
      for (glm::dvec3 const& place : polygon.ring(i)) places_.push_back((*projection_)(place));
      sweep_.add(places_, count_);
    }
    ++count_;
  }
  void add_nothing() { ++count_; }

  EdgeSweep& sweep() { return sweep_; }

 private:
  EdgeSweep sweep_;
  Projection const* projection_ = nullptr;
  std::uint32_t count_ = 0;  // of polygons
  std::vector<glm::dvec2> places_;
};

// Kept from one question to the next, so that memory is asked for but once.
struct Workspace {
  Outlines outlines;
  Light light;
  std::vector<LuminanceSums> sums;
};

}  // namespace

std::optional<ExactAnswer> swept_sums(Scene const& scene, Transmission const& transmission,
                                      ExactQuestion const& question, Projection const& projection,
                                      double most_steps) {
  // Behind a pointer, or the address is looked up again wherever it is used.
  static thread_local auto const workspace = std::make_unique<Workspace>();
  auto& [outlines, light, sums] = *workspace;
  outlines.start(projection);
  light.start(question.through ? question.interiors.size() : 1);
  outlines.add(question.receiver);
  for (RelativePolygon const* const caster : question.casters) {
    light.add(transmission.shade(caster->id(), question.towards_sun));
    outlines.add(*caster);
    if (outlines.sweep().expected_steps() > most_steps) return std::nullopt;
  }
  if (question.through) {
    for (RelativePolygon const& interior : question.interiors) {
      Ring const& outline = scene[interior.id()].polygon.outline;
      auto const depth = depth_of(outline, question.frame, question.towards_sun);
      light.add(depth.value_or(Depth{}));
      if (depth) {
        outlines.add(interior);
      } else {
        outlines.add_nothing();
      }
    }
  }
  if (!outlines.sweep().sweep(most_steps, light)) return std::nullopt;
  auto found = light.result();
  if (!found) return std::nullopt;
  sums = std::move(*found);
  return ExactAnswer{sums, question.casters.size()};
}

}  // namespace gpu_shading
