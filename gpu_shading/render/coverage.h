#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "gpu_shading/scene.h"
#include "render/draw_list.h"
#include "render/pixel_mask.h"
#include "render/receiver.h"
#include "render/screen_shading.h"
#include "render/view.h"
#include "scene/triangulation.h"

namespace gpu_shading {

// Counts the pixels that casters leave lit, on the CPU: what a rasterizer in software does, but
// with a bit a pixel, without triangles, and in double precision up to the edges. Where there is no
// GPU it takes the place of OpenGL for plain views, at a tenth of the time
// (tests/bench/opaque_cost). Any number of threads may ask.
class Coverage {
 public:
  // `meshes`: of all surfaces, by id. Refers to nothing of them.
  explicit Coverage(std::span<Mesh const> meshes);

  // Of a tile as `view`, in front of its receiver, has the casters. On so many threads at most; the
  // same on any number.
  std::uint64_t lit(Tile const& tile, View const& view, std::span<SurfaceId const> casters,
                    int threads) const;
  // The sum over the lit pixels of what reaches them, where each caster lets a share through, 0 for
  // an opaque one, and screens what they do. On so many threads at most; the same on any number.
  double luminance(Tile const& tile, View const& view, std::span<SurfaceId const> casters,
                   std::span<float const> shares, ScreensInView const& screens, int threads) const;
  // Of the lit pixels, those where each of `interiors` is the nearest in the view `behind`; of
  // surfaces in the same place the first has them.
  std::vector<std::uint64_t> lit_inside(Tile const& tile, View const& view,
                                        std::span<SurfaceId const> casters, View const& behind,
                                        std::span<SurfaceId const> interiors) const;

 private:
  std::span<glm::uvec4 const> pieces(SurfaceId id) const {
    return {pieces_.data() + ranges_[id].first, ranges_[id].count};
  }
  void darken(PixelMask& mask, Tile const& tile, View const& view,
              std::span<SurfaceId const> casters) const;
  // The caster's areas in a view whose x and y are in pixels, one after another.
  template <typename Use>
  void each_area(SurfaceId caster, View const& pixels, int side, Use use) const;

  std::vector<glm::dvec3> points_;
  std::vector<glm::uvec4> pieces_;  // corners, the last twice where there are three
  std::vector<Range> ranges_;       // of pieces_, by surface
};

}  // namespace gpu_shading
