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
    std::vector<int> screens;  // of the casters
    std::size_t direction;     // where there are any
    std::vector<double> sums;  // once counted, of each answer
  };

  // The place of what is known of the screens at a view's direction.
  std::size_t note_screens(View const& view);
  void count(View& view, std::span<ScreenView const> seen, int threads) const;

  Coverage const& coverage_;
  Transmission const& transmission_;
  RendererStatistics& statistics_;
  std::vector<View> views_;
  std::vector<DirectionTables> directions_;
};

}  // namespace gpu_shading
