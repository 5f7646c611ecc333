#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "filters/transmission.h"
#include "geometry/plane_frame.h"
#include "geometry/triangulation.h"
#include "gpu_shading/device.h"
#include "gpu_shading/renderer_statistics.h"
#include "gpu_shading/scene.h"
#include "scene/casters.h"
#include "scene/turns.h"
#include "view/tile.h"

namespace gpu_shading {

// A receiver on its tile as the sun sees it from one direction, and the casters in front of it.
// Objects that it points to must stay alive until the view is answered.
struct ReceiverView {
  SurfaceId receiver = 0;
  PlaneFrame const* frame = nullptr;
  Tile const* tile = nullptr;  // for a back end that samples its pixels
  glm::dvec3 towards_sun{0.0};
  double cosine = 0.0;  // cosine of the angle of incidence, above 0
  std::vector<SurfaceId> casters;
  bool transmits = false;  // some caster transmits part of the beam
  bool through =
      false;  // the receiver is a window, and the sun may reach these surfaces behind it:
  std::span<SurfaceId const> interiors;
  // Sampled once, as a device would: for comparison with it, and where the number of pixels is
  // fixed.
  bool at_pixels = false;
  // Where casters are many and the back end searches for them itself: all, and for the sample of
  // them in `casters` how many there are about.
  Casters const* crowd = nullptr;
  double crowd_count = 0.0;
  bool is_window = false;  // there are questions about the surfaces behind it
  // For a back end that measures its errors: to begin with, samples as of a tile of so many pixels
  // per side, in rows at these slopes.
  int side = 0;
  ReplicateSlopes slopes = replicate_slopes;
  double max_error = 0.0;  // of the sunlit fraction

  // Area of a pixel normal to the beam, m2; on a bounding tile, of all that is seen through it.
  double pixel_area() const {
    if (tile != nullptr) return tile->map.pixel_area(tile->side) * cosine;
    double const slope = slopes.front();
    double const around = (1.0 + std::abs(slope)) * (1.0 + std::abs(slope)) / (1.0 + slope * slope);
    return frame->width * frame->height * around * cosine / (static_cast<double>(side) * side);
  }
};

// Luminance summed over pixels: 1 for a sunlit pixel, less where casters transmit.
struct LuminanceSums {
  double unscheduled = 0.0;  // what passed no scheduled shade
  // What passed scheduled shades: schedules, as numbered by Transmission, with the number of shades
  // of each, in the order of schedules. Each combination once.
  struct Scheduled {
    std::vector<std::pair<int, int>> powers;
    double sum = 0.0;
  };
  std::vector<Scheduled> scheduled;
};

struct ViewSums {
  // The receiver's own pixels on its tile, as this back end finds them. If there are none, the
  // parts are meaningless, and the tile must be a bounding one.
  std::uint64_t receiver_pixels = 0;
  std::vector<LuminanceSums> parts;  // one, or one for each of the view's interior surfaces
  // The error that 99 % of such fractions stay within, where it is measured.
  std::optional<double> uncertainty = {};
};

// What a back end rasterises. All but the meshes must outlive it.
struct BackendInput {
  Scene const& scene;
  std::span<Mesh const> meshes;  // of all of the scene's surfaces, by id
  Transmission const& transmission;
  RendererStatistics& statistics;  // receives its seconds
};

// Rasterises views of one scene and sums their pixels. One thread at a time.
class ViewBackend {
 public:
  ViewBackend() = default;
  virtual ~ViewBackend() = default;
  ViewBackend(ViewBackend const&) = delete;
  ViewBackend& operator=(ViewBackend const&) = delete;
  ViewBackend(ViewBackend&&) = delete;
  ViewBackend& operator=(ViewBackend&&) = delete;

  virtual DeviceInfo const& device() const = 0;

  // Whether it samples views at the centres of their tiles' pixels, so that tiles should not alias
  // with what repeats in a view.
  virtual bool samples_pixels() const { return true; }

  // The number of opaque casters in view up to which each of them must be found for this back end,
  // which finds more itself, in views with `interiors` or without; empty: it finds none.
  virtual std::optional<std::size_t> few_casters(bool /*interiors*/) const { return std::nullopt; }

  // Takes a batch of views, which may be started at once or later. Throws DeviceError if the device
  // fails, and Error if a view cannot be answered; then call forget() to discard what was taken.
  virtual void add(std::vector<ReceiverView> views) = 0;
  // Sums of all views added since the last finish(), in their order. Throws DeviceError.
  virtual std::vector<ViewSums> finish() = 0;
  virtual void forget() = 0;
};

}  // namespace gpu_shading
