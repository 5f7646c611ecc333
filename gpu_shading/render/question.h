#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

#include "gpu_shading/renderer.h"
#include "render/receiver.h"

namespace gpu_shading {

// What the sun at one direction sees of a receiver, or of the surfaces behind one.
struct Question {
  SurfaceId receiver = 0;
  glm::dvec3 towards_sun{0.0};
  bool through = false;  // the receiver is a window, and asked for are these:
  std::span<SurfaceId const> interiors;
  std::span<Sunlit> answers;  // the receiver's, or of each of `interiors`; zero when asked
};

// One whose receiver faces the sun.
struct FacedQuestion {
  Question question;
  Receiver const* receiver;
  double cosine;  // of the angle of incidence

  PlaneFrame const& frame() const { return *receiver->frame; }
};

// What a pixel of a tile covers across the beam, m2: of a bounding tile, too, all that is seen
// through it.
inline double pixel_area_across_beam(FacedQuestion const& faced, Tile const& tile) {
  return tile.map.pixel_area(tile.side) * faced.cosine;
}

// Areas of so many lit pixels, or of luminance summed over them, where the receiver has `pixels` on
// its tile.
inline void set_areas(Sunlit& answer, FacedQuestion const& faced, Tile const& tile, double lit,
                      std::uint64_t pixels) {
  double const whole = faced.receiver->area * faced.cosine;
  answer.projected_area = lit * (whole / static_cast<double>(pixels));
  answer.pixel_counted_area = lit * tile.pixel_area * faced.cosine;
}

}  // namespace gpu_shading
