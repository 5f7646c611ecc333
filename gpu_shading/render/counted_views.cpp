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

// Textures have layers on a device alone.
constexpr int texels_of_a_layer = 4096;

}  // namespace

bool CountedViews::can_take(Question const& question, std::span<SurfaceId const> casters) const {
  if (!transmission_.any_transmits(casters)) return true;
  return !question.through && !transmission_.any_schedule(casters);
}

void CountedViews::add(FacedQuestion const& faced, Tile const& tile,
                       std::vector<SurfaceId> casters) {
  View view{faced, &tile, std::move(casters), false, {}, 0, {}};
  view.transmits = transmission_.any_transmits(view.casters);
  if (view.transmits) view.screens = transmission_.screens_among(view.casters);
  if (!view.screens.empty()) view.direction = note_screens(view);
  views_.push_back(std::move(view));
}

std::size_t CountedViews::note_screens(View const& view) {
  glm::dvec3 const& towards_sun = view.faced.question.towards_sun;
  if (directions_.empty() || directions_.back().towards_sun != towards_sun) {
    directions_.push_back({towards_sun, 0, {}, {}});
  }
  double const pixel_area = pixel_area_across_beam(view.faced, *view.tile);
  for (int const number : view.screens) {
    Screens::Entry const& screen = transmission_.screens()[number];
    directions_.back().add_screen(
        number, may_see_effect(*screen.screen, screen.normal, towards_sun, pixel_area));
  }
  return directions_.size() - 1;
}

void CountedViews::count() {
  Stopwatch const watch(statistics_.count_seconds);
  std::vector<ScreenView> seen(directions_.size());
  tbb::parallel_for(std::size_t{0}, seen.size(), [&](std::size_t i) {
    seen[i] = transmission_.see({&directions_[i], 1}, texels_of_a_layer);
  });
  int const cores = tbb::this_task_arena::max_concurrency();
  bool const few = views_.size() < static_cast<std::size_t>(cores);
  tbb::parallel_for(std::size_t{0}, views_.size(), [&](std::size_t i) {
    View& view = views_[i];
    bool const shared = few && (view.casters.size() >= worth_sharing || !view.screens.empty());
    count(view, seen, shared ? cores : 1);
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
  directions_.clear();
}

void CountedViews::count(View& view, std::span<ScreenView const> seen, int threads) const {
  Question const& question = view.faced.question;
  Tile const& tile = *view.tile;
  auto const before = view_in_front(view.faced.frame(), tile.map, question.towards_sun);
  if (question.through) {
    auto const behind = view_behind(view.faced.frame(), tile.map, question.towards_sun, 1.0);
    auto const lit = coverage_.lit_inside(tile, before, view.casters, behind, question.interiors);
    view.sums.assign(lit.begin(), lit.end());
  } else if (view.transmits) {
    std::vector<SurfaceId> const plain = transmission_.plain_among(view.casters);
    std::vector<float> shares;
    shares.reserve(plain.size());
    for (SurfaceId const id : plain) {
      shares.push_back(transmission_.shade(id, question.towards_sun).transmittance);
    }
    ScreensInView screens;
    if (!view.screens.empty()) {
      screens = {&transmission_.screens(), &seen[view.direction], view.screens};
    }
    view.sums = {coverage_.luminance(tile, before, plain, shares, screens, threads)};
  } else {
    view.sums = {static_cast<double>(coverage_.lit(tile, before, view.casters, threads))};
  }
}

}  // namespace gpu_shading
