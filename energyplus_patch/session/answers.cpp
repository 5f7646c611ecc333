#include "session/answers.h"

namespace gpu_shading::energyplus {

Answers::Direction& Answers::at(SunDirection sun) {
  auto const found = directions_.find(sun);
  if (found != directions_.end()) return found->second;
  std::size_t const each = surfaces_ * sizeof(float) + sizeof(Direction) + 64;
  if ((directions_.size() + 1) * each > max_bytes) directions_.clear();
  auto& direction = directions_[sun];
  direction.sun = sun;
  direction.projected_area.assign(surfaces_, std::numeric_limits<float>::quiet_NaN());
  return direction;
}

}  // namespace gpu_shading::energyplus
