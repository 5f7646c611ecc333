#include "tasks/trace_maps.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace gpu_shading::energyplus {
namespace {

// EnergyPlus hands over vertices in single precision: a ray begins this far in front of the
// receiver, m, so that a surface in the same plane does not stop it.
constexpr double lift = 1e-5;

// EnergyPlus's limit of the cosine of incidence.
constexpr double least_cosine = 1e-5;

constexpr std::size_t rays_in_batch = 65536;

bool alike(MapTime const& a, MapTime const& b) {
  return a.factors == b.factors && a.deployments == b.deployments;
}

// Neighbouring cells begin at other points, so that the edge of a shadow along a row or a column
// does not pass all of them in one place.
std::size_t turn_of(MapCell const& cell) {
  constexpr std::size_t from_row_to_row = 37;
  return static_cast<std::size_t>(cell.column) +
         from_row_to_row * static_cast<std::size_t>(cell.row);
}

// Rays of successive times with the same conditions, traced together.
class RayBatch {
 public:
  RayBatch(RayScene const& rays, SurfaceId receiver, MapGrid const& grid,
           MapSettings const& settings)
      : rays_(rays), receiver_(receiver), grid_(grid), settings_(settings) {
    values_.resize(grid.cells().size());
  }

  void add(MapTime const& time, std::size_t number) {
    auto const sun = to_vector(time.sun);
    double const cosine = glm::dot(sun, grid_.axes().normal);
    if (cosine < least_cosine) return;
    if (!times_.empty() && (batch_.size() >= rays_in_batch || !alike(*times_.front().time, time))) {
      trace();
    }
    times_.push_back({&time, cosine});
    auto const start = grid_.axes().normal * lift;
    auto const rays = settings_.rays_per_cell;
    for (auto const& cell : grid_.cells()) {
      auto const first = rays * (number + turn_of(cell));
      for (std::size_t i = 0; i < rays; ++i) {
        batch_.push_back({grid_.point(cell, first + i) + start, sun});
      }
    }
  }

  std::vector<MapValue> finish() {
    trace();
    return std::move(values_);
  }

 private:
  struct Added {
    MapTime const* time;
    double cosine;
  };

  void trace() {
    if (times_.empty()) return;
    passed_.resize(batch_.size());
    auto const& first = *times_.front().time;
    rays_.transmittances(
        batch_, {.receiver = receiver_, .factors = first.factors, .deployments = first.deployments},
        passed_);
    auto passed = passed_.begin();
    double const share = settings_.hours_per_step / static_cast<double>(settings_.rays_per_cell);
    constexpr double watts_in_kilowatt = 1000.0;
    for (auto const& [time, cosine] : times_) {
      for (auto& value : values_) {
        double hours = 0.0;
        for (std::size_t i = 0; i < settings_.rays_per_cell; ++i) hours += share * *passed++;
        value.hours += hours;
        value.energy += hours * cosine * time->beam / watts_in_kilowatt;
      }
    }
    times_.clear();
    batch_.clear();
  }

  RayScene const& rays_;
  SurfaceId receiver_;
  MapGrid const& grid_;
  MapSettings settings_;
  std::vector<Added> times_;
  std::vector<Ray> batch_;
  std::vector<double> passed_;
  std::vector<MapValue> values_;
};

}  // namespace

std::vector<MapValue> trace_map(RayScene const& rays, SurfaceId receiver, MapGrid const& grid,
                                std::vector<MapTime> const& times, MapSettings const& settings,
                                std::function<void(std::size_t)> const& done) {
  RayBatch batch(rays, receiver, grid, settings);
  for (std::size_t i = 0; i < times.size(); ++i) {
    batch.add(times[i], i);
    done(i + 1);
  }
  return batch.finish();
}

}  // namespace gpu_shading::energyplus
