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

bool CountedViews::can_take(Question const& question, std::span<SurfaceId const> casters) const {
  if (!transmission_.any_transmits(casters)) return true;
  return !question.through && !transmission_.any_schedule(casters) &&
         !transmission_.any_screen(casters);
}

void CountedViews::add(FacedQuestion const& faced, Tile const& tile,
                       std::vector<SurfaceId> casters) {
  bool const transmits = transmission_.any_transmits(casters);
  views_.push_back({faced, &tile, std::move(casters), transmits, {}});
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
    for (std::size_t i = 0; i < view.sums.size(); ++i) {
      set_areas(question.answers[i], view.faced, *view.tile, view.sums[i],
                view.tile->counted_pixels);
    }
    if (question.through) continue;
    ++statistics_.receivers_drawn;
    statistics_.casters_drawn += view.casters.size();
    if (view.transmits) ++statistics_.luminance_views;
  }
  views_.clear();
}

void CountedViews::count(View& view, int threads) const {
  Question const& question = view.faced.question;
  Tile const& tile = *view.tile;
  auto const before = view_in_front(view.faced.frame(), tile.map, question.towards_sun);
  if (question.through) {
    auto const behind = view_behind(view.faced.frame(), tile.map, question.towards_sun, 1.0);
    auto const lit = coverage_.lit_inside(tile, before, view.casters, behind, question.interiors);
    view.sums.assign(lit.begin(), lit.end());
  } else if (view.transmits) {
    std::vector<float> shares;
    shares.reserve(view.casters.size());
    for (SurfaceId const id : view.casters) {
      shares.push_back(transmission_.shade(id, question.towards_sun).transmittance);
    }
    view.sums = {coverage_.luminance(tile, before, view.casters, shares)};
  } else {
    view.sums = {static_cast<double>(coverage_.lit(tile, before, view.casters, threads))};
  }
}

}  // namespace gpu_shading
