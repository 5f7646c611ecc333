#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "backends/interface/picture_raster.h"
#include "pictures/picture_frame.h"

namespace gpu_shading {

// Which surfaces the sun sees in each pixel of a picture from its side: an illustration's shadows.
class ShadowMap {
 public:
  // `shown`: surfaces, those that transmit after `opaque` others. `frame` about `origin`, and
  // `reach` as for make_grid().
  ShadowMap(PictureRaster& raster, std::span<SurfaceId const> shown, std::size_t opaque,
            PictureFrame const& frame, SunAxes const& axes, glm::dvec3 const& origin, double reach);

  // Of a position on a surface: 1 in the sun, 0 in the shadow of an opaque surface, between them
  // behind one that transmits. Outside of the frame 1.
  double light(SurfaceId surface, glm::dvec3 const& position) const;
  // The same below everything that is shown.
  double light_on_ground(glm::dvec3 const& position) const;

 private:
  struct Pixel {
    int x;
    int y;
  };
  std::optional<Pixel> pixel_at(glm::dvec3 const& position) const;

  SunAxes axes_;
  glm::dvec3 origin_;
  PictureFrame frame_;
  PictureGrid grid_;
  std::vector<std::uint32_t> nearest_;
  std::vector<std::uint32_t> nearest_opaque_;
};

}  // namespace gpu_shading
