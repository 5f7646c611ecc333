#pragma once

#include <cstdint>

#include "gpu_shading/transport.h"
#include "transport/reverse_paths.h"
#include "transport/solar_hours.h"

namespace gpu_shading {

// What is the same for all receivers.
struct LightRequest {
  TransportScene const& scene;
  TransportRequest const& transport;
  SolarHours const& year;
  RayConditions const& conditions;
};

// `seed`: as in Transport::to().
Transported light_on(LightRequest const& request, SurfaceId receiver, std::uint32_t seed);

}  // namespace gpu_shading
