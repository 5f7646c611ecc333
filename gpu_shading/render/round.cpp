#include "render/round.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <utility>

#include "render/stopwatch.h"
#include "render/view.h"

namespace gpu_shading {
namespace {

// Answers that are waited for at a time: their sums take memory.
constexpr std::size_t most_drawn = 16384;
// Questions whose casters are found at a time: what is found takes memory.
constexpr std::size_t most_asked = 64;

}  // namespace

Round::Round(Parts const& parts) : parts_(parts) {
  parts_.submissions.clear();
  if (parts_.coverage != nullptr) {
    counted_.emplace(*parts_.coverage, parts_.transmission, parts_.statistics);
  }
}

void Round::ask(Question const& question) {
  for (SurfaceId const id : question.interiors) parts_.receivers.surface(id);
  Receiver const& seen = parts_.receivers[question.receiver];
  if (!seen.frame || question.answers.empty()) return;
  double const cosine = glm::dot(seen.frame->normal, question.towards_sun);
  if (cosine <= edge_on) return;
  asked_.push_back({question, &seen, cosine});
  if (asked_.size() < most_asked) return;
  look();
  if (drawn_.size() >= most_drawn) finish();
}

void Round::look() {
  std::vector<InView> in_view(asked_.size());
  {
    Stopwatch const watch(parts_.statistics.cull_seconds);
    tbb::parallel_for(std::size_t{0}, asked_.size(), [&](std::size_t i) {
      Question const& question = asked_[i].question;
      in_view[i] = parts_.casters.in_view(parts_.scene, question.receiver, asked_[i].frame(),
                                          question.towards_sun, parts_.receivers.size().enough());
    });
  }
  for (std::size_t i = 0; i < asked_.size(); ++i) take(asked_[i], std::move(in_view[i]));
  asked_.clear();
  if (counted_) counted_->count();
}

void Round::take(FacedQuestion const& faced, InView in_view) {
  Question const& question = faced.question;
  Receiver const& seen = *faced.receiver;
  if (!question.through && in_view.casters.empty()) {
    Sunlit& clear = question.answers.front();
    clear.projected_area = clear.pixel_counted_area = seen.area * faced.cosine;
    ++parts_.statistics.receivers_clear;
    return;
  }
  // Where one surface inside ends and the next begins there is an edge as well.
  in_view.detail.across += static_cast<double>(std::min<std::size_t>(question.interiors.size(), 6));
  int const side =
      parts_.receivers.side_for(seen, in_view, parts_.transmission.any_screen(in_view.casters));
  Tile& tile = parts_.receivers.tile(question.receiver, side);
  if (counted_ && counted_->can_take(question, in_view.casters)) {
    counted_->add(faced, tile, std::move(in_view.casters));
  } else {
    draw(faced, tile, in_view.casters);
  }
}

void Round::draw(FacedQuestion const& faced, Tile& tile, std::span<SurfaceId const> casters) {
  Question const& question = faced.question;
  measure(question.receiver, tile);
  Drawn drawn{faced, &tile, casters.size(), true, std::nullopt, 0};
  drawn.opaque = !parts_.transmission.any_transmits(casters);
  if (!drawn.opaque) drawn.keys = parts_.transmission.keys(question.receiver, casters);
  Kind kind = question.through ? Kind::interior : Kind::opaque;
  if (!drawn.opaque) {
    kind = question.through ? Kind::shaded_interior
                            : (drawn.keys ? Kind::scheduled : Kind::unscheduled);
  }
  drawn.view = parts_.submissions.add(
      kind, tile.side, question.answers.size(),
      [&](DrawList& list, int layer) { gather(list, layer, drawn, casters); });
  drawn_.push_back(std::move(drawn));
}

void Round::measure(SurfaceId receiver, Tile& tile) {
  if (tile.drawn_pixels || measured_.contains(&tile)) return;
  std::size_t const view = parts_.submissions.add(
      Kind::opaque, tile.side, 1,
      [&](DrawList& list, int layer) { list.add_tile(tile.triangles, layer); });
  measured_.emplace(&tile, Measured{receiver, view});
}

void Round::gather(DrawList& list, int layer, Drawn const& drawn,
                   std::span<SurfaceId const> casters) {
  list.add_tile(drawn.tile->triangles, layer);
  if (!casters.empty()) gather_casters(list, layer, drawn, casters);
  if (drawn.faced.question.through) gather_interiors(list, layer, drawn);
}

void Round::gather_casters(DrawList& list, int layer, Drawn const& drawn,
                           std::span<SurfaceId const> casters) {
  PlaneFrame const& frame = drawn.faced.frame();
  glm::dvec3 const& towards_sun = drawn.faced.question.towards_sun;
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
                                   pixel_area_across_beam(drawn.faced, *drawn.tile));
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
  Question const& question = drawn.faced.question;
  PlaneFrame const& frame = drawn.faced.frame();
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
  look();
  parts_.submissions.finish();
  for (auto const& [tile, measured] : measured_) {
    double const pixels = parts_.submissions.sums(measured.view).front().begin()->second;
    if (pixels > 0.0) {
      tile->drawn_pixels = static_cast<std::uint64_t>(pixels);
    } else {
      parts_.receivers.bound(measured.receiver, *tile);
    }
  }
  std::vector<Question> again;
  for (Drawn const& drawn : drawn_) {
    if (drawn.tile->drawn_pixels) {
      answer(drawn);
    } else {
      again.push_back(drawn.faced.question);
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
    drawn.faced.question.answers[i] = sunlit(sums[i], drawn);
  }
  if (drawn.faced.question.through) return;
  ++parts_.statistics.receivers_drawn;
  parts_.statistics.casters_drawn += drawn.casters;
  if (!drawn.opaque) ++parts_.statistics.luminance_views;
}

Sunlit Round::sunlit(LuminanceByKey const& sums, Drawn const& drawn) {
  auto const& schedules = parts_.transmission.shades().schedules();
  Sunlit answer;
  for (auto const& [key, sum] : sums) {
    Sunlit part;
    set_areas(part, drawn.faced, *drawn.tile, sum, *drawn.tile->drawn_pixels);
    std::vector<std::pair<int, int>> powers;
    if (drawn.keys) powers = drawn.keys->powers(key);
    if (powers.empty()) {
      answer.projected_area = part.projected_area;
      answer.pixel_counted_area = part.pixel_counted_area;
      continue;
    }
    for (auto& [schedule, power] : powers) {
      schedule = schedules[static_cast<std::size_t>(schedule)];
    }
    answer.scheduled.push_back({std::move(powers), part.projected_area});
  }
  return answer;
}

}  // namespace gpu_shading
