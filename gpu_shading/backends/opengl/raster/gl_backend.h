#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

#include "backends/interface/view_backend.h"
#include "backends/opengl/egl/device.h"
#include "backends/opengl/raster/geometry.h"
#include "backends/opengl/raster/schedule_keys.h"
#include "backends/opengl/raster/submissions.h"
#include "filters/transmission.h"

namespace gpu_shading {

// How a device is used.
struct GlSettings {
  std::optional<LuminanceSum> sum = std::nullopt;  // empty: whichever is faster on the device
  // Whether views of many opaque casters are covered by compute programs; empty: on a GPU.
  std::optional<bool> crowds = std::nullopt;
  int max_layers = 0;  // views drawn at once, at most; 0: as many as the device's bounds allow
};

// Draws views with OpenGL on an EGL device, many at once. The caller's context is restored after
// every call.
class GlBackend : public ViewBackend {
 public:
  // Adds to the statistics' seconds of submitting, waiting and reading. Answers are the same with
  // any settings, but for the rounding of sums. Throws DeviceError.
  GlBackend(egl::Device device, BackendInput const& input, GlSettings const& settings = {});
  ~GlBackend() override;
  GlBackend(GlBackend const&) = delete;
  GlBackend& operator=(GlBackend const&) = delete;
  GlBackend(GlBackend&&) = delete;
  GlBackend& operator=(GlBackend&&) = delete;

  DeviceInfo const& device() const override { return device_.info; }
  std::optional<std::size_t> few_casters(bool interiors) const override;

  // Also throws Error if a view has too many scheduled shades to count separately: the numbers of
  // shades of each schedule must fit in three times 24 bits.
  void add(std::vector<ReceiverView> views) override;
  std::vector<ViewSums> finish() override;
  void forget() override;

 private:
  // Must be created and destroyed with the context current.
  struct OnDevice;
  struct Drawn {
    Tile const* tile;
    std::optional<ScheduleKeys> keys;
    std::size_t view;  // of submissions, or of crowds
    bool crowd = false;
  };

  void draw(ReceiverView const& view);
  void cover(ReceiverView const& view);
  // Draws the receiver alone, once for each tile, because OpenGL first rounds vertices to fractions
  // of a pixel.
  void measure(Tile const& tile);
  void gather(DrawList& list, int layer, ReceiverView const& view, ScheduleKeys const* keys);
  void gather_casters(DrawList& list, int layer, ReceiverView const& view,
                      ScheduleKeys const* keys);
  void gather_interiors(DrawList& list, int layer, ReceiverView const& view);
  // Distance of the farthest of a window's interior surfaces behind its plane, m.
  double reach(ReceiverView const& view) const;
  // Keys of all schedules, to count those in front of a receiver separately; empty if none of its
  // casters has one.
  std::optional<ScheduleKeys> keys(ReceiverView const& view) const;

  egl::Device device_;
  Scene const& scene_;
  Transmission const& transmission_;
  std::unique_ptr<OnDevice> on_device_;
  std::vector<Drawn> drawn_;
  std::unordered_map<Tile const*, std::size_t> measured_;           // views being rasterised
  std::unordered_map<Tile const*, std::uint64_t> receiver_pixels_;  // more than 0
};

}  // namespace gpu_shading
