#pragma once

#include <utility>

#include "gpu_shading/scene.h"
#include "gpu_shading_answers.h"

namespace gpu_shading::energyplus {

inline Ring ring_of(answers::Coordinates const& xyz) {
  Ring ring;
  ring.reserve(xyz.size() / 3);
  for (std::size_t i = 0; i + 2 < xyz.size(); i += 3) {
    ring.emplace_back(xyz[i], xyz[i + 1], xyz[i + 2]);
  }
  return ring;
}

inline Surface surface_of(answers::PlainSurface plain) {
  Surface surface;
  surface.name = std::move(plain.name);
  surface.polygon.outline = ring_of(plain.outline);
  for (auto const& hole : plain.holes) surface.polygon.holes.push_back(ring_of(hole));
  return surface;
}

}  // namespace gpu_shading::energyplus
