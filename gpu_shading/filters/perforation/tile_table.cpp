#include "filters/perforation/tile_table.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

#include "filters/perforation/tile_rays.h"
#include "platform/parallel.h"

namespace gpu_shading {
namespace {

using std::numbers::pi;

constexpr double infinite = std::numeric_limits<double>::infinity();

// Tangent of the largest angle of incidence that is followed, 89.1 degrees.
constexpr double max_tangent = 64.0;

// Total number of steps of TileRays, of about 10 ns each, and the overhead of a ray in steps.
constexpr double max_work = 2.4e8;
constexpr std::size_t work_of_ray = 4;

struct Start {
  double u;
  double v;
  double openness;
};

struct Starts {
  double openness = 0.0;  // mean over all points, which are more than the rays
  std::vector<Start> rays;
};

Starts open_starts(TileRays const& rays, Extent const& extent, std::size_t region,
                   std::size_t places, std::size_t max_rays) {
  Starts starts;
  Places const place(extent, region);
  for (std::size_t n = 0; n < places; ++n) {
    double const u = place.u(n);
    double const v = place.v(n);
    float const opacity = rays.opacity(u, v);
    if (opacity >= TileRays::solid) continue;
    double const openness = 1.0 - static_cast<double>(opacity);
    starts.openness += openness;
    if (starts.rays.size() < max_rays) starts.rays.push_back({u, v, openness});
  }
  starts.openness /= static_cast<double>(places);
  return starts;
}

// Follows a ray to its end and calls `visit(shift, loss)` for each loss of openness on its path.
// Returns the shift at which nothing is left, and adds to the work.
template <typename Visit>
double follow(TileRays const& rays, Start const& start, TileRays::Direction const& direction,
              double farthest, std::vector<TileRays::Rise>& rises, std::size_t& work,
              Visit const& visit) {
  work += work_of_ray + rays.follow(start.u, start.v, direction, farthest, rises);
  double left = start.openness;
  for (TileRays::Rise const& rise : rises) {
    double const after =
        rise.opacity >= TileRays::solid ? 0.0 : 1.0 - static_cast<double>(rise.opacity);
    visit(rise.shift, left - after);
    left = after;
    if (left == 0.0) return rise.shift;
  }
  return infinite;
}

class Maker {
 public:
  Maker(OpacityTile const& tile, double thickness, int max_directions);

  TileTable make();

 private:
  static constexpr std::size_t trial_rays = 8;

  std::size_t regions() const {
    return static_cast<std::size_t>(table_.regions_across) *
           static_cast<std::size_t>(table_.regions_up);
  }
  Extent extent(std::size_t region) const;
  TileRays::Direction direction(std::size_t index) const {
    return rays_.direction(static_cast<double>(index) * pi / table_.directions);
  }

  void lay_out(int max_directions);
  // Determines the number of rays and the step from a few trial rays.
  void try_out();

  // For one region: the fractions of the open beam lost up to each step, all directions one after
  // the other, with `steps` values each.
  struct Region {
    std::size_t steps = 0;
    double longest_chord = 0.0;
    std::vector<float> values;
  };
  Region made(std::size_t region) const;
  std::vector<Region> made_all() const;

  OpacityTile const& tile_;
  TileRays rays_;
  TileTable table_;
  double farthest_;
  std::size_t places_ = 0;
  std::size_t rays_each_ = 0;
  std::size_t max_steps_ = 0;
};

Maker::Maker(OpacityTile const& tile, double thickness, int max_directions)
    : tile_(tile),
      rays_(tile),
      farthest_(std::min(max_tangent * thickness, 8.0 * (tile.width() + tile.height()))) {
  lay_out(max_directions);
  try_out();
}

void Maker::lay_out(int max_directions) {
  constexpr int undivided = 256;
  constexpr double texels = 128.0;
  constexpr int most = 32;
  table_.directions = max_directions;
  if (std::max(tile_.columns(), tile_.rows()) <= undivided) {
    places_ = 65536;
    return;
  }
  auto const regions_along = [=](int count) {
    return std::clamp(static_cast<int>(std::lround(count / texels)), 1, most);
  };
  table_.regions_across = regions_along(tile_.columns());
  table_.regions_up = regions_along(tile_.rows());
  table_.directions = max_directions / 4;
  places_ = 16384;
}

Extent Maker::extent(std::size_t region) const {
  auto const across = static_cast<std::size_t>(table_.regions_across);
  double const width = tile_.width() / table_.regions_across;
  double const height = tile_.height() / table_.regions_up;
  std::size_t const row = region / across;
  return {.u = static_cast<double>(region - row * across) * width,
          .v = static_cast<double>(row) * height,
          .width = width,
          .height = height};
}

void Maker::try_out() {
  auto const directions = static_cast<std::size_t>(table_.directions);
  std::vector<TileRays::Rise> rises;
  std::size_t work = 0;
  std::size_t followed = 0;
  double lost = 0.0;
  double lost_shifts = 0.0;
  double longest = 0.0;
  for (std::size_t region = 0; region < regions(); ++region) {
    Starts const starts = open_starts(rays_, extent(region), region, 1024, trial_rays);
    for (std::size_t index = 0; index < directions; ++index) {
      TileRays::Direction const towards = direction(index);
      for (Start const& start : starts.rays) {
        follow(rays_, start, towards, farthest_, rises, work, [&](double shift, double loss) {
          lost += loss;
          lost_shifts += loss * shift;
          longest = std::max(longest, shift);
        });
      }
    }
    followed += starts.rays.size();
  }
  double const work_each =
      static_cast<double>(work) / static_cast<double>(std::max<std::size_t>(1, followed));
  constexpr double max_rays = 4096.0;
  rays_each_ = static_cast<std::size_t>(std::clamp(
      max_work / (static_cast<double>(regions()) * std::max(1.0, work_each)), 32.0, max_rays));
  constexpr double max_values = 12U << 20U;
  max_steps_ = static_cast<std::size_t>(
      std::min(2049.0, max_values / (static_cast<double>(regions()) * table_.directions)));
  double const texel = std::min(tile_.texel_width(), tile_.texel_height());
  double const mean = lost > 0.0 ? lost_shifts / lost : texel;
  // The trial rays may have missed the longest path.
  table_.step = std::clamp(1.25 * longest / static_cast<double>(max_steps_ - 1),
                           std::max(mean, texel) / 64.0, std::max(mean, texel) / 16.0);
}

Maker::Region Maker::made(std::size_t region) const {
  Starts const starts = open_starts(rays_, extent(region), region, places_, rays_each_);
  Region found;
  found.steps = 2;
  auto const directions = static_cast<std::size_t>(table_.directions);
  if (starts.rays.empty()) {
    found.values.assign(directions * found.steps, 0.0F);
    return found;
  }
  double all = 0.0;
  for (Start const& start : starts.rays) all += start.openness;
  std::vector<double> losses(directions * max_steps_, 0.0);
  std::vector<TileRays::Rise> rises;
  std::size_t work = 0;
  for (std::size_t index = 0; index < directions; ++index) {
    double* const of_direction = &losses[index * max_steps_];
    TileRays::Direction const towards = direction(index);
    for (Start const& start : starts.rays) {
      double const end =
          follow(rays_, start, towards, farthest_, rises, work, [&](double shift, double loss) {
            // The first step beyond it.
            double const place = std::ceil(shift / table_.step);
            if (place >= static_cast<double>(max_steps_)) return;
            auto const step = static_cast<std::size_t>(place);
            of_direction[step] += loss;
            found.steps = std::max(found.steps, step + 1);
          });
      found.longest_chord = std::max(found.longest_chord, end);
    }
  }
  found.values.reserve(directions * found.steps);
  for (std::size_t index = 0; index < directions; ++index) {
    double left = all;
    for (std::size_t step = 0; step < found.steps; ++step) {
      left -= losses[index * max_steps_ + step];
      found.values.push_back(static_cast<float>(starts.openness * std::max(0.0, left / all)));
    }
  }
  return found;
}

std::vector<Maker::Region> Maker::made_all() const {
  std::vector<Region> all(regions());
  for_each_index(all.size(), [&](std::size_t region) { all[region] = made(region); });
  return all;
}

TileTable Maker::make() {
  std::vector<Region> const all = made_all();
  std::size_t steps = 2;
  for (Region const& region : all) {
    steps = std::max(steps, region.steps);
    table_.longest_chord = std::max(table_.longest_chord, region.longest_chord);
  }
  table_.steps = static_cast<int>(steps);
  // The step from which on nothing passes.
  table_.longest_chord = std::ceil(table_.longest_chord / table_.step) * table_.step;
  auto const directions = static_cast<std::size_t>(table_.directions);
  table_.values.reserve(directions * steps * all.size());
  for (std::size_t index = 0; index < directions; ++index) {
    for (std::size_t step = 0; step < steps; ++step) {
      for (Region const& region : all) {
        table_.values.push_back(
            region.values[index * region.steps + std::min(step, region.steps - 1)]);
      }
    }
  }
  return std::move(table_);
}

}  // namespace

TileTable make_tile_table(OpacityTile const& tile, double thickness, int max_directions) {
  return Maker(tile, thickness, max_directions).make();
}

}  // namespace gpu_shading
