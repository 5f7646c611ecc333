#include "session/answers.h"

namespace gpu_shading::energyplus {

double Answers::Direction::area(SurfaceId surface, std::span<double const> factors) const {
  double const unscheduled = projected_area[surface];
  auto const parts = scheduled.find(surface);
  return parts == scheduled.end() ? unscheduled
                                  : unscheduled + through_schedules(parts->second, factors);
}

Answers::Direction& Answers::at(SunDirection sun, std::uint32_t state) {
  auto const found = directions_.find({sun, state});
  if (found != directions_.end()) return found->second;
  std::size_t const each = surfaces_ * sizeof(float) + sizeof(Direction) + 64;
  if ((directions_.size() + 1) * each > max_bytes) directions_.clear();
  auto& direction = directions_[{sun, state}];
  direction.sun = sun;
  direction.state = state;
  direction.projected_area.assign(surfaces_, std::numeric_limits<float>::quiet_NaN());
  return direction;
}

}  // namespace gpu_shading::energyplus
