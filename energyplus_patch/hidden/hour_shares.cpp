#include "hidden/hour_shares.h"

#include <algorithm>

namespace gpu_shading::energyplus {

HourShares::Shares const& HourShares::at(int hour) {
  int const nearest = std::clamp(hour, 1, static_cast<int>(hours));
  auto& shares = known_.at(static_cast<std::size_t>(nearest - 1));
  if (!shares) {
    Moment const moment{nearest, 1};
    shares = Shares{optics_.factors_at(moment), optics_.deployments_at(moment)};
  }
  return *shares;
}

}  // namespace gpu_shading::energyplus
