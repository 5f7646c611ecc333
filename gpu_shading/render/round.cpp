#include "render/round.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <utility>

#include "render/stopwatch.h"
#include "render/view.h"

namespace gpu_shading {
namespace {

// Answers that are waited for at a time: their sums take memory.
constexpr std::size_t most_drawn = 16384;

}  // namespace

Round::Round(Parts const& parts) : parts_(parts) { parts_.submissions.clear(); }

void Round::ask(Question const& question) {
  SurfaceId const id = question.receiver;
  Receiver const& seen = parts_.receivers[id];
  if (!seen.frame) return;
  double const cosine = glm::dot(seen.frame->normal, question.towards_sun);
  if (cosine <= edge_on || question.answers.empty()) return;

  InView in_view;
  int side = 0;
  {
    Stopwatch const watch(parts_.statistics.cull_seconds);
    in_view = parts_.casters.in_view(parts_.scene, id, *seen.frame, question.towards_sun,
                                     parts_.receivers.size().enough());
    // Where one surface inside ends and the next begins there is an edge as well.
    in_view.detail.across +=
        static_cast<double>(std::min<std::size_t>(question.interiors.size(), 6));
    side =
        parts_.receivers.side_for(seen, in_view, parts_.transmission.any_screen(in_view.casters));
  }
  if (!question.through && in_view.casters.empty()) {
    Sunlit& clear = question.answers.front();
    clear.projected_area = clear.pixel_counted_area = seen.area * cosine;
    ++parts_.statistics.receivers_clear;
    return;
  }
  Tile& tile = parts_.receivers.tile(id, side);
  measure(id, tile);
  Drawn drawn{question, &tile, cosine, in_view.casters.size(), true, std::nullopt, 0};
  drawn.opaque = !parts_.transmission.any_transmits(in_view.casters);
  if (!drawn.opaque) drawn.keys = parts_.transmission.keys(id, in_view.casters);
  Kind kind = question.through ? Kind::interior : Kind::opaque;
  if (!drawn.opaque) {
    kind = question.through ? Kind::shaded_interior
                            : (drawn.keys ? Kind::scheduled : Kind::unscheduled);
  }
  drawn.view = parts_.submissions.add(
      kind, tile.side, question.answers.size(),
      [&](DrawList& list, int layer) { gather(list, layer, drawn, in_view.casters); });
  drawn_.push_back(std::move(drawn));
  if (drawn_.size() >= most_drawn) finish();
}

void Round::measure(SurfaceId receiver, Tile& tile) {
  if (tile.pixels || measured_.contains(&tile)) return;
  std::size_t const view = parts_.submissions.add(
      Kind::opaque, tile.side, 1,
      [&](DrawList& list, int layer) { list.add_tile(tile.triangles, layer); });
  measured_.emplace(&tile, Measured{receiver, view});
}

void Round::gather(DrawList& list, int layer, Drawn const& drawn,
                   std::span<SurfaceId const> casters) {
  list.add_tile(drawn.tile->triangles, layer);
  if (!casters.empty()) gather_casters(list, layer, drawn, casters);
  if (drawn.question.through) gather_interiors(list, layer, drawn);
}

void Round::gather_casters(DrawList& list, int layer, Drawn const& drawn,
                           std::span<SurfaceId const> casters) {
  PlaneFrame const& frame = *parts_.receivers[drawn.question.receiver].frame;
  glm::dvec3 const& towards_sun = drawn.question.towards_sun;
  Transmission const& transmission = parts_.transmission;
  glm::ivec4 numbers(layer, -1, 0, 0);
  DirectionTables* tables = nullptr;
  if (!drawn.opaque) {
    tables = &list.tables(towards_sun, parts_.scene.size());
    if (drawn.keys) numbers.y = list.add_keys(drawn.keys->keys());
    numbers.z = static_cast<int>(tables->first_shade);
    numbers.w =
        static_cast<int>((list.directions().size() - 1) * parts_.geometry.screens().count());
  }
  std::uint32_t const view = list.add_view(view_in_front(frame, drawn.tile->map, towards_sun),
                                           parts_.geometry.scene_origin(), numbers);
  std::size_t const begin = list.begin_surfaces();
  for (SurfaceId const id : casters) {
    if (!transmission.shades().dims(id)) continue;
    list.add_triangles(parts_.geometry.triangles(id));
    if (tables == nullptr || !transmission.shades().transmits(id)) continue;
    std::size_t const place = tables->first_shade + id;
    if (!list.knows_shade(place)) list.set_shade(place, transmission.shade(id, towards_sun));
  }
  list.add_caster_draw(list.end_surfaces(begin), view);
  if (tables == nullptr) return;
  std::vector<int> const screens = transmission.screens_among(casters);
  if (screens.empty()) return;
  parts_.geometry.screens().add_to(list, *tables, view, screens,
                                   drawn.tile->map.pixel_area(drawn.tile->side) * drawn.cosine);
}

double Round::reach(Question const& question, PlaneFrame const& frame) {
  double farthest = clearance;
  for (SurfaceId const id : question.interiors) {
    for (glm::dvec3 const& vertex : parts_.receivers.surface(id).polygon.outline) {
      farthest = std::max(farthest, -glm::dot(frame.normal, vertex - frame.origin));
    }
  }
  return 1.01 * farthest;  // what lies at the far end is not nearer than nothing
}

void Round::gather_interiors(DrawList& list, int layer, Drawn const& drawn) {
  Question const& question = drawn.question;
  PlaneFrame const& frame = *parts_.receivers[question.receiver].frame;
  View const behind =
      view_behind(frame, drawn.tile->map, question.towards_sun, reach(question, frame));
  int identity = 0;
  for (SurfaceId const id : question.interiors) {
    std::uint32_t const view =
        list.add_view(behind, parts_.geometry.scene_origin(), glm::ivec4(layer, ++identity, 0, 0));
    std::size_t const begin = list.begin_surfaces();
    list.add_triangles(parts_.geometry.triangles(id));
    list.add_interior_draw(list.end_surfaces(begin), view);
  }
}

void Round::finish() {
  parts_.submissions.finish();
  for (auto const& [tile, measured] : measured_) {
    double const pixels = parts_.submissions.sums(measured.view).front().begin()->second;
    if (pixels > 0.0) {
      tile->pixels = static_cast<std::uint64_t>(pixels);
    } else {
      parts_.receivers.bound(measured.receiver, *tile);
    }
  }
  std::vector<Question> again;
  for (Drawn const& drawn : drawn_) {
    if (drawn.tile->pixels) {
      answer(drawn);
    } else {
      again.push_back(drawn.question);
    }
  }
  drawn_.clear();
  measured_.clear();
  parts_.submissions.clear();
  for (Question const& question : again) ask(question);
  if (!again.empty()) finish();
}

void Round::answer(Drawn const& drawn) {
  auto const sums = parts_.submissions.sums(drawn.view);
  for (std::size_t i = 0; i < sums.size(); ++i) {
    drawn.question.answers[i] = sunlit(sums[i], drawn);
  }
  if (drawn.question.through) return;
  ++parts_.statistics.receivers_drawn;
  parts_.statistics.casters_drawn += drawn.casters;
  if (!drawn.opaque) ++parts_.statistics.luminance_views;
}

Sunlit Round::sunlit(LuminanceByKey const& sums, Drawn const& drawn) {
  double const whole = parts_.receivers[drawn.question.receiver].area * drawn.cosine;
  double const share = whole / static_cast<double>(*drawn.tile->pixels);
  auto const& schedules = parts_.transmission.shades().schedules();
  Sunlit answer;
  for (auto const& [key, sum] : sums) {
    std::vector<std::pair<int, int>> powers;
    if (drawn.keys) powers = drawn.keys->powers(key);
    if (powers.empty()) {
      answer.projected_area = sum * share;
      answer.pixel_counted_area = sum * drawn.tile->pixel_area * drawn.cosine;
      continue;
    }
    for (auto& [schedule, power] : powers) {
      schedule = schedules[static_cast<std::size_t>(schedule)];
    }
    answer.scheduled.push_back({std::move(powers), sum * share});
  }
  return answer;
}

}  // namespace gpu_shading
