#pragma once

#include <cstdint>
#include <vector>

#include "gpu_shading/renderer.h"
#include "render/coverage.h"
#include "render/question.h"
#include "render/receivers.h"

namespace gpu_shading {

// Opaque views to be counted on the CPU, on all its cores.
class CountedViews {
 public:
  // What it refers to must outlive it.
  CountedViews(Coverage const& coverage, Receivers& receivers, RendererStatistics& statistics)
      : coverage_(coverage), receivers_(receivers), statistics_(statistics) {}

  void add(FacedQuestion const& faced, Tile& tile, std::vector<SurfaceId> casters);
  // Answers all that was added.
  void count();

 private:
  struct View {
    FacedQuestion faced;
    Tile const* tile;
    std::vector<SurfaceId> casters;
    std::vector<std::uint64_t> lit;  // once counted, of each answer
  };

  void measure(SurfaceId receiver, Tile& tile);
  void count(View& view, int threads) const;

  Coverage const& coverage_;
  Receivers& receivers_;
  RendererStatistics& statistics_;
  std::vector<View> views_;
};

}  // namespace gpu_shading
