#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "gl/draw.h"
#include "gl/framebuffer.h"
#include "gl/texture.h"
#include "render/draw_list.h"
#include "render/geometry.h"
#include "render/reduction.h"

namespace gpu_shading {

// A receiver of luminance 1 and the casters before it, each of which multiplies by what it lets
// through (Jones & Greenberg). Multiplication commutes: nothing is sorted. Into the bound target,
// which is clear: luminance in every channel, or in alpha and the keys in the others.
void draw_luminance(Geometry& geometry, ReceiverJob const& job, gl::Blend how);

// Sums the luminance that unscheduled shades leave receivers. A float32 layer for each job of a
// batch; nothing is read back before it is asked for. For tiles of one side.
class Luminance {
 public:
  Luminance(int side, LuminanceSum how);

  // Draws from the draw list that `geometry` holds.
  void draw(Geometry& geometry, std::span<ReceiverJob const> jobs);

  // What was last drawn, a sum over the pixels for each job in order. Waits for it.
  std::vector<double> sums() const { return reduction_->sums(); }

 private:
  void make_layers(std::size_t wanted);

  int side_;
  std::unique_ptr<Reduction> reduction_;
  gl::LayeredTexture texture_;
  std::vector<gl::Framebuffer> layers_;
};

}  // namespace gpu_shading
