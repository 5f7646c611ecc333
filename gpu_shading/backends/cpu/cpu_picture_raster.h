#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "backends/cpu/coverage.h"
#include "backends/cpu/surface_pieces.h"
#include "backends/interface/picture_raster.h"
#include "geometry/convex_area.h"

namespace gpu_shading {

// Rasterises pictures on the CPU, on all its cores: what shades a receiver as CpuBackend does, and
// the nearest surfaces in double precision with a depth for each pixel.
class CpuPictureRaster : public PictureRaster {
 public:
  explicit CpuPictureRaster(PictureScene const& scene);

  int max_pixels() const override;
  std::vector<std::uint32_t> nearest(PictureGrid const& grid,
                                     std::span<SurfaceId const> surfaces) override;
  std::vector<float> through_bodies(PictureGrid const& grid, glm::dvec3 const& towards_sun,
                                    std::span<SurfaceId const> surfaces) override;
  std::vector<float> luminance(PictureGrid const& grid, ShadedReceiver const& shaded) override;

 private:
  // A piece of a surface on a grid.
  struct Piece {
    ConvexArea area;
    DepthPlane depth;
    std::uint32_t number;
  };

  std::vector<Piece> lay_out(PictureGrid const& grid, std::span<SurfaceId const> surfaces) const;
  // What screens in view are at a direction of the sun, by number.
  std::vector<SheetInBeam> sheets(PictureGrid const& grid, glm::dvec3 const& towards_sun,
                                  std::span<int const> numbers) const;

  Transmission const& transmission_;
  Coverage coverage_;
  std::size_t surfaces_;
};

}  // namespace gpu_shading
