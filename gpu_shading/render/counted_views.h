#pragma once

#include <vector>

#include "gpu_shading/renderer.h"
#include "render/coverage.h"
#include "render/question.h"
#include "render/transmission.h"

namespace gpu_shading {

// Plain views (PlainViews) to be counted on the CPU, on all its cores.
class CountedViews {
 public:
  // What it refers to must outlive it.
  CountedViews(Coverage const& coverage, Transmission const& transmission,
               RendererStatistics& statistics)
      : coverage_(coverage), transmission_(transmission), statistics_(statistics) {}

  // Whether what is asked behind these casters can be counted.
  bool can_take(Question const& question, std::span<SurfaceId const> casters) const;

  void add(FacedQuestion const& faced, Tile const& tile, std::vector<SurfaceId> casters);
  // Answers all that was added.
  void count();

 private:
  struct View {
    FacedQuestion faced;
    Tile const* tile;
    std::vector<SurfaceId> casters;
    bool transmits;
    std::vector<double> sums;  // once counted, of each answer
  };

  void count(View& view, int threads) const;

  Coverage const& coverage_;
  Transmission const& transmission_;
  RendererStatistics& statistics_;
  std::vector<View> views_;
};

}  // namespace gpu_shading
