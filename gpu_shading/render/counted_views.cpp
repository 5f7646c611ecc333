#include "render/counted_views.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <utility>

#include "render/stopwatch.h"
#include "render/view.h"

namespace gpu_shading {
namespace {

// Casters from which on several cores share a view.
constexpr std::size_t worth_sharing = 200;

}  // namespace

void CountedViews::add(FacedQuestion const& faced, Tile& tile, std::vector<SurfaceId> casters) {
  measure(faced.question.receiver, tile);
  views_.push_back({faced, &tile, std::move(casters), {}});
}

void CountedViews::measure(SurfaceId receiver, Tile& tile) {
  if (tile.counted_pixels) return;
  std::uint64_t pixels = coverage_.lit(tile);
  if (pixels == 0) {
    receivers_.bound(receiver, tile);
    pixels = coverage_.lit(tile);
  }
  tile.counted_pixels = pixels;
}

void CountedViews::count() {
  Stopwatch const watch(statistics_.count_seconds);
  int const cores = tbb::this_task_arena::max_concurrency();
  bool const few = views_.size() < static_cast<std::size_t>(cores);
  tbb::parallel_for(std::size_t{0}, views_.size(), [&](std::size_t i) {
    count(views_[i], few && views_[i].casters.size() >= worth_sharing ? cores : 1);
  });
  for (View const& view : views_) {
    Question const& question = view.faced.question;
    for (std::size_t i = 0; i < view.lit.size(); ++i) {
      set_areas(question.answers[i], view.faced, *view.tile, static_cast<double>(view.lit[i]),
                *view.tile->counted_pixels);
    }
    if (question.through) continue;
    ++statistics_.receivers_drawn;
    statistics_.casters_drawn += view.casters.size();
  }
  views_.clear();
}

void CountedViews::count(View& view, int threads) const {
  Question const& question = view.faced.question;
  Tile const& tile = *view.tile;
  auto const before = view_in_front(view.faced.frame(), tile.map, question.towards_sun);
  if (question.through) {
    auto const behind = view_behind(view.faced.frame(), tile.map, question.towards_sun, 1.0);
    view.lit = coverage_.lit_inside(tile, before, view.casters, behind, question.interiors);
  } else {
    view.lit = {coverage_.lit(tile, before, view.casters, threads)};
  }
}

}  // namespace gpu_shading
