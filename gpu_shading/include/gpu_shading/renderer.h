#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "gpu_shading/device.h"
#include "gpu_shading/image.h"
#include "gpu_shading/renderer_statistics.h"
#include "gpu_shading/scene.h"
#include "gpu_shading/sun_direction.h"
#include "gpu_shading/sunlit.h"

namespace gpu_shading {

// How a renderer computes: on which device, and how finely. Renderer's constructor checks the
// values.
struct RendererOptions {
  static constexpr double min_error = 1e-5;
  static constexpr double max_error = 0.1;

  DeviceChoice device;
  // Number of pixels along each side of every receiver's tile, 1 .. DeviceInfo::max_resolution.
  // Empty: it follows from `error`. In both cases, a receiver with fewer than side^2 / 16 pixels,
  // or fewer than 16, gets twice as many along each side, repeatedly, up to 4096.
  std::optional<int> resolution = std::nullopt;
  // Target accuracy, min_error .. max_error: 99 % of sunlit fractions are within this absolute
  // error. The size of a tile follows from it and from the length of the shadow edges in view.
  double error = 1e-3;
  // Otherwise views with few edges are answered exactly, without samples, where that costs less.
  bool samples_only = false;
  // Called with one line when the CPU takes over from an OpenGL device: the first views of each
  // kind are compared with the CPU's, and one was wrong; or the device cannot draw the scene; or,
  // where no device was named, it takes more than twice as long as the CPU. Without it, wrong
  // answers throw DeviceError, and a slower device is kept.
  std::function<void(std::string const&)> warn = {};
};

// A window, and the interior surfaces that the sun may reach through it.
struct InteriorQuestion {
  SurfaceId window = 0;
  std::vector<SurfaceId> interiors;
};

// Computes sunlit areas of a scene's surfaces, with OpenGL or on the CPU. Units and axes are those
// of Polygon and SunDirection. One thread at a time may use an object; it need not be the same one.
//
// Every function throws DeviceError if the device fails; a failure never changes an answer. It
// throws Error for a surface that is not in the scene, and if one view has too many scheduled
// shades to be counted separately: the binary digits of the numbers of shades of each schedule must
// fit in three times 24.
//
// Method: pixel counting after Jones, Greenberg & Pratt (2012). The receiver's plane is the image
// plane: casters are clipped at it and projected onto it along the sun's rays. This is the parallel
// projection of the sun's view followed by an affine map, so sunlit fractions are the same, and a
// receiver has the same pixels for every sun direction. The pixel grid is turned against the
// receiver's longest edge by the golden slope, or another where much in view lies along it, so that
// edges do not line up with rows of pixels. A receiver too thin for 16 pixels on its finest tile
// gets the sunlit fraction of its bounding rectangle.
//
// Views with few edges are answered without pixels, exact to rounding, where that takes less time:
// the trapezoids between all outlines, projected in the same way, are summed.
//
// Where a caster in view transmits, each pixel has a 32-bit luminance: 1 where the receiver is,
// multiplied by the transmittance of every caster (the second method of Jones & Greenberg), 0 for
// opaque ones. The mean over the receiver's pixels replaces the fraction of sunlit pixels, and is
// equal to it if all casters are opaque.
//
// The CPU rasterises by the same rule, on all cores: convex pieces row by row, perforated sheets
// ray by ray. It samples rows of its own, until the error that it measures is within the target. If
// the number of pixels is fixed, it samples these, as OpenGL does, which first rounds vertices to
// fractions of a pixel, so that the two differ where shadow edges meet pixel centres: by 1e-5 in
// the mean of random scenes at 512 pixels.
//
// OpenGL draws many views at once, each to its own layer of an array texture, so answers do not
// depend on other questions in the same call. Memory in addition to the scene and the answers:
// about 100 MiB on the host, and on a device up to 512 MiB of layers (64 MiB with Mesa's software
// renderer) and some 100 MiB of geometry.
class Renderer {
 public:
  // Throws Error if the resolution or the error of the options is out of range, and DeviceError if
  // the device is not available.
  Renderer(Scene scene, RendererOptions options);
  ~Renderer();
  Renderer(Renderer const&) = delete;
  Renderer& operator=(Renderer const&) = delete;
  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;

  Scene const& scene() const;
  DeviceInfo const& device() const;
  RendererStatistics const& statistics() const;

  // Sets the deployed fractions of screens, 0 .. 1, by PerforatedSheet::deployment, for all later
  // calls. Screens beyond the end are fully deployed. Beside its deployed fraction, a screen lets
  // the whole beam pass.
  void set_deployments(std::vector<double> shares);

  // Returns the sunlit area of each receiver, in order, for one sun direction. There is no ground
  // but the scene's: a direction below the horizon is answered as any other. A receiver that faces
  // away, as one does whose vertices run clockwise, has none.
  std::vector<Sunlit> projected_sunlit_areas(SunDirection sun,
                                             std::span<SurfaceId const> receivers);

  // The same for each direction, in order; faster than one call per direction.
  std::vector<std::vector<Sunlit>> projected_sunlit_areas(std::span<SunDirection const> suns,
                                                          std::span<SurfaceId const> receivers);

  // Projected areas (m2 normal to the beam) of each of `interiors` that the sun lights through
  // `window` alone, behind the window's own casters; the nearest interior surface along a ray
  // receives it. In the order of `interiors`; their sum is at most the window's projected sunlit
  // area, within the errors of both.
  std::vector<Sunlit> interior_sunlit_areas(SunDirection sun, SurfaceId window,
                                            std::span<SurfaceId const> interiors);

  // The same for each direction and, within it, for each window, in order; faster than one call
  // each.
  std::vector<std::vector<std::vector<Sunlit>>> interior_sunlit_areas(
      std::span<SunDirection const> suns, std::span<InteriorQuestion const> questions);

  // A picture of a receiver as the sun sees it, in fraction_colour() of the share of the beam that
  // reaches it, with factors[schedule] for schedules, 1 where there are too few. Casters are grey
  // by their tilt to the sun. World-up is up;
  // `size` is the number of pixels on the longer side, 1 .. DeviceInfo::max_resolution, otherwise
  // throws Error.
  Image sun_view(SunDirection sun, SurfaceId receiver, int size,
                 std::span<double const> factors = {});

 private:
  friend class RendererWithBackend;  // render/renderer_with_backend.h
  class Implementation;
  explicit Renderer(std::unique_ptr<Implementation> implementation);
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace gpu_shading
