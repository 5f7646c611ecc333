#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "gpu_shading/device.h"
#include "gpu_shading/scene.h"
#include "gpu_shading/sun_direction.h"

namespace gpu_shading {

// How pixels are summed, each way in a fixed order; but for rounding of luminance they agree.
enum class LuminanceSum {
  automatic,  // readback in software, where it is the fastest of these; compute on a GPU
  compute,    // by a compute shader
  mipmaps,    // luminance from the coarsest mipmap, as Jones & Greenberg do; the rest by compute
  readback,   // on the CPU
};

struct RendererOptions {
  static constexpr double least_error = 1e-5;
  static constexpr double most_error = 0.1;

  DeviceChoice device;
  // Pixels a side of every receiver's tile, 1 .. DeviceInfo::max_resolution; nothing: by the error.
  // Either way the side is doubled for a receiver that would have fewer than side^2 / 64 pixels or
  // 16, until it has, up to 4096.
  std::optional<int> resolution = std::nullopt;
  // What 99 of a hundred sunlit fractions are to be right within, between those: the side of a tile
  // follows from it and from the shadows' edges in view (view/tile_size.h).
  double error = 1e-3;
  LuminanceSum luminance_sum = LuminanceSum::automatic;
  // Views that are drawn at once, at most; 0: as many as the bounds of the class allow. Answers are
  // the same to the bit.
  int most_layers = 0;
};

// The area that the sun lights through one combination of scheduled shades.
struct ScheduledPart {
  std::vector<std::pair<int, int>> powers;  // schedule and number of its shades, sorted by schedule
  double projected_area = 0.0;              // m2 at factors of 1, transmittances included
};

// The total with factors[schedule]: each part times the factors of its schedules, raised to the
// numbers of their shades. Throws Error if there are too few factors.
double through_schedules(std::span<ScheduledPart const> parts, std::span<double const> factors);

// The sunlit area of one receiver.
struct Sunlit {
  // Projected sunlit surface area (PSSA), m2 normal to the beam: the receiver's exact projected
  // area times the sunlit fraction of its own pixels, each weighted by the transmittance of the
  // unscheduled shades in front of it. 0 if the receiver faces away from the sun. What passes
  // scheduled shades is added to it.
  double projected_area = 0.0;
  // The same by plain pixel counting, N x Ap (Jones et al. 2012), for comparison.
  double pixel_counted_area = 0.0;
  // One part for each combination of schedules.
  std::vector<ScheduledPart> scheduled;

  // The total with factors[schedule]. Throws Error if there are too few factors.
  double at(std::span<double const> factors) const {
    return projected_area + through_schedules(scheduled, factors);
  }
};

// The interior surfaces that the sun may reach through a window.
struct InteriorQuestion {
  SurfaceId window = 0;
  std::vector<SurfaceId> interiors;
};

struct RendererStatistics {
  std::size_t directions = 0;       // requested by projected_sunlit_areas
  std::size_t receivers_drawn = 0;  // pairs of receiver and direction with a caster in view
  std::size_t receivers_clear = 0;  // pairs answered exactly: sunlit, with nothing in view
  std::size_t casters_drawn = 0;    // sum over all drawn pairs
  std::size_t luminance_views = 0;  // drawn pairs with a transmitting shade in view
  double seconds = 0.0;             // wall-clock time in the renderer, of which:
  double cull_seconds = 0.0;        // finding casters in view
  double submit_seconds = 0.0;      // collecting, uploading and issuing draws
  double count_seconds = 0.0;       // counting plain views on the CPU
  double wait_seconds = 0.0;        // waiting for the device
  double read_seconds = 0.0;        // sums on the CPU

  RendererStatistics& operator+=(RendererStatistics const& other);
};

// An 8-bit image, rows from the top.
struct Image {
  int width = 0;
  int height = 0;
  int channels = 3;
  std::vector<std::uint8_t> pixels;
};

// Renders receivers as the sun sees them, by OpenGL or on the CPU. One thread at a time, but any
// thread. Every function throws DeviceError when the device fails; no answer is ever made up.
// Error when too many scheduled shades are in one view to be told apart: the binary digits of how
// many there are of each schedule have to fit three times 24.
//
// Method: pixel counting after Jones, Greenberg & Pratt (2012), PSSF = N Ap / At. The receiver's
// plane is the image plane: casters are clipped at it and slid along the sun's rays onto it, which
// is the parallel projection of the sun's view followed by an affine map, so that lit shares are
// the same and the receiver keeps the same pixels at every direction. The pixel lattice is turned
// against the receiver's longest edge by an angle of golden slope, so that edges parallel to it do
// not line up with rows of pixels. A receiver too thin for 16 pixels of its finest tile gets the
// lit share of its bounding rectangle.
// Views with shades that transmit in them keep a luminance of 32 bits for each pixel, 1 where the
// receiver is, which every caster multiplies by what it lets through (the second method of Jones &
// Greenberg); opaque ones by 0. Its mean over the receiver's pixels takes the place of their lit
// share, and equals it where all are opaque.
//
// The CPU rasterises by the same rule and on the same lattice as OpenGL: a bit for each pixel, and
// a luminance of 32 bits where something transmits, convex pieces row by row, screens ray by ray,
// on all cores. OpenGL rounds corners to parts of a pixel first, so that the two differ where the
// edges of shadows meet the centres of pixels: by 1e-5 in the mean of random scenes at 512 pixels.
//
// OpenGL draws many views at once, each to a layer of its own of an array of textures, so that a
// view has the same pixels whatever it is drawn with: answers do not depend on what else is asked.
// The CPU culls for the next views while the device draws; one submission is under way in software,
// three on a GPU. Memory beside the scene's and the answers': on the host about 100 MiB; on the
// device a target takes 1 MiB in software, 32 MiB on a GPU, or one layer where that is more (16
// bytes a pixel where schedules are told apart, 24 for interiors behind shades), all of them 64 and
// 512 MiB, and what is drawn to them some 100 MiB. A device without
// GL_ARB_shader_viewport_layer_array draws one view at a time.
class Renderer {
 public:
  // Throws Error when the resolution is out of range, DeviceError when the device cannot be had.
  Renderer(Scene scene, RendererOptions options);
  ~Renderer();
  Renderer(Renderer const&) = delete;
  Renderer& operator=(Renderer const&) = delete;
  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;

  Scene const& scene() const;
  DeviceInfo const& device() const;
  RendererStatistics const& statistics() const;

  // Sets the deployed fractions of screens from now on, by Surface::deployment, 0 .. 1; screens
  // beyond the end are fully deployed. The rest of a screen lets everything pass.
  void set_deployments(std::vector<double> shares);

  // Returns one answer per receiver, in order.
  std::vector<Sunlit> projected_sunlit_areas(SunDirection sun,
                                             std::span<SurfaceId const> receivers);

  // The same for each direction, in order; faster than one call per direction.
  std::vector<std::vector<Sunlit>> projected_sunlit_areas(std::span<SunDirection const> suns,
                                                          std::span<SurfaceId const> receivers);

  // Projected areas (m2 normal to the beam) of each of `interiors` that the sun lights through
  // `window` alone, behind the window's own casters; the nearest interior surface along a ray
  // receives it. In the order of `interiors`; their sum is at most the window's projected sunlit
  // area.
  std::vector<Sunlit> interior_sunlit_areas(SunDirection sun, SurfaceId window,
                                            std::span<SurfaceId const> interiors);

  // The same for each direction and, within it, for each window, in order; faster than one call
  // each.
  std::vector<std::vector<std::vector<Sunlit>>> interior_sunlit_areas(
      std::span<SunDirection const> suns, std::span<InteriorQuestion const> questions);

  // What the sun sees of a receiver: lit receiver pixels yellow, shaded ones blue, casters grey by
  // their tilt to the sun. Where a caster in view transmits, the receiver is grey by its luminance,
  // schedules by `factors`, 1 where those are too few. World-up is up; `size` pixels on the longer
  // side.
  Image sun_view(SunDirection sun, SurfaceId receiver, int size,
                 std::span<double const> factors = {});

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace gpu_shading
