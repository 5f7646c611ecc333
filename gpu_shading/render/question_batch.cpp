#include "render/question_batch.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "antialias/antialias.h"
#include "platform/parallel.h"
#include "platform/stopwatch.h"

namespace gpu_shading {
namespace {

// Number of answers awaited at a time, because their sums take memory.
constexpr std::size_t max_viewed = 16384;
// Number of questions whose casters are searched at a time: few for a device, which draws those of
// before meanwhile, and otherwise as many as memory for so many casters allows, because threads
// wait for each other after each time.
constexpr std::size_t min_asked = 64;
constexpr std::size_t max_asked = 4096;
constexpr std::size_t max_casters = std::size_t{1} << 20U;

// Steps of an EdgeSweep that always take less time than samples.
constexpr double few_steps = 300.0;

// Time that the samples of a view take on one core, in steps of an EdgeSweep: an estimate within a
// factor of two (tests/bench/exact_cost). `side`: pixels per side of its tile.
double sample_cost(Detail const& detail, int side, bool transmits, std::size_t interiors) {
  double const rows = side;
  // Edges in a row that is covered already cost less: hence the root.
  double const crossed = std::sqrt(detail.total() * rows);
  double const behind = static_cast<double>(interiors);
  double const passed = transmits ? rows * rows : 0.0;
  return (1.5 + 1.4 * behind) * rows + 21.0 * crossed + 0.09 * passed;
}

// Edges behind a window: where one interior surface ends and the next begins.
double behind(Question const& question) {
  return static_cast<double>(std::min<std::size_t>(question.interiors.size(), 6));
}

}  // namespace

QuestionBatch::QuestionBatch(Parts const& parts)
    : parts_(parts), may_be_crowd_(parts.transmission.all_opaque()), at_once_(min_asked) {
  start();
}

void QuestionBatch::start() {
  asked_.clear();
  viewed_.clear();
  at_once_ = min_asked;
  parts_.backend.forget();
  parts_.receivers.forget_many();
}

bool QuestionBatch::measured() const {
  return !parts_.backend.samples_pixels() && !parts_.receivers.size().is_fixed();
}

void QuestionBatch::ask(Question const& question) {
  for (SurfaceId const id : question.interiors) parts_.receivers.surface(id);
  Receiver const& seen = question.through ? parts_.receivers.window(question.receiver)
                                          : parts_.receivers[question.receiver];
  if (!seen.frame || question.answers.empty()) return;
  double const cosine = glm::dot(seen.frame->normal, question.towards_sun);
  if (cosine <= edge_on) return;
  asked_.push_back(
      {question, &seen, cosine, parts_.receivers.in_sector(question.receiver, question.towards_sun),
       question.through ? parts_.receivers.behind(question.receiver, question.interiors)
                        : std::span<RelativePolygon const>()});
  if (asked_.size() < at_once_) return;
  cull();
  if (viewed_.size() >= max_viewed) finish();
}

void QuestionBatch::cull() {
  found_.resize(asked_.size());
  {
    Stopwatch const watch(parts_.statistics.cull_seconds);
    for_each_short(asked_.size(), [&](std::size_t i) { found_[i] = find(asked_[i]); });
  }
  if (parts_.backend.device().id.is_cpu()) {
    std::size_t casters = 1;
    for (Found const& each : found_) casters += each.casters;
    at_once_ = std::clamp(max_casters * asked_.size() / casters, min_asked, max_asked);
  }
  std::vector<ReceiverView> views;
  for (std::size_t i = 0; i < asked_.size(); ++i) enqueue(asked_[i], std::move(found_[i]), views);
  asked_.clear();
  if (!measured()) stretch_tiles(views);
  parts_.backend.add(std::move(views));
}

std::optional<QuestionBatch::Blades> QuestionBatch::blades(Asked const& asked) const {
  PlaneFrame const& frame = *asked.receiver->frame;
  glm::dvec3 const& towards_sun = asked.question.towards_sun;
  // Within the error where an edge as long as the tile runs along them.
  double const rows = 0.51 / parts_.receivers.error_on_rectangle(*asked.receiver);
  // Fewer are drawn as soon.
  auto const few = static_cast<std::size_t>(std::min(rows * rows / 16.0, 4000.0));
  constexpr std::size_t max_sample = 32;
  auto crowd = parts_.casters.crowd_in_view(parts_.scene, asked.question.receiver, frame,
                                            towards_sun, few, max_sample);
  if (!crowd) return std::nullopt;
  auto const slopes = slopes_along(repeats_among(parts_.scene, crowd->sample), frame, towards_sun);
  if (!slopes) return std::nullopt;
  return Blades{std::move(*crowd), *slopes};
}

QuestionBatch::Found QuestionBatch::find(Asked const& asked) const {
  Question const& question = asked.question;
  Receiver const& seen = *asked.receiver;
  Found found;
  Casters const& casters = parts_.casters;
  std::size_t const interiors = question.interiors.size();
  auto const lay_out = [&](Detail& detail, bool screened) {
    detail.across += behind(question);
    found.side = parts_.receivers.side_for(seen, detail, screened);
    if (!measured()) found.slope = turn_slopes.at(best_turn(detail));
  };
  bool const tried =
      asked.in_sector != nullptr && asked.in_sector->all_flat && !parts_.samples_only;
  auto const counted = tried ? answer_in_sector(asked) : std::nullopt;
  if (counted) {
    found.answered = true;
    found.casters = *counted;
    found.transmits = asked.in_sector->any_transmits;
    return found;
  }
  double const enough = parts_.receivers.size().enough();
  auto const few = may_be_crowd_ ? parts_.backend.few_casters(question.through) : std::nullopt;
  if (few) {
    auto along = measured() && asked.in_sector == nullptr ? blades(asked) : std::nullopt;
    auto crowd = along ? std::move(along->crowd)
                       : casters.crowd_in_view(parts_.scene, question.receiver, *seen.frame,
                                               question.towards_sun, *few);
    if (crowd) {
      found.crowd_count = crowd->count();
      found.in_view.casters = std::move(crowd->sample);
      found.casters = found.in_view.casters.size();
      if (along) found.slopes = along->slopes;
      if (measured()) {
        found.side = parts_.receivers.side_for(
            seen, casters.crowd_shadow(found.in_view.casters, *seen.frame, question.towards_sun),
            behind(question));
        return found;
      }
      Detail detail = casters.detail(found.in_view.casters, *seen.frame, question.towards_sun,
                                     enough / crowd->each);
      detail *= crowd->each;
      lay_out(detail, false);
      return found;
    }
  }
  // Kept from one question to the next.
  static thread_local std::vector<SurfaceId> spare;
  auto& memory = spare;
  auto reused = std::exchange(memory, {});
  found.in_view = asked.in_sector != nullptr
                      ? casters.in_view_of(asked.in_sector->positions, *seen.frame,
                                           question.towards_sun, std::move(reused))
                      : casters.in_view(parts_.scene, question.receiver, *seen.frame,
                                        question.towards_sun, std::move(reused));
  InView& in_view = found.in_view;
  found.casters = in_view.casters.size();
  found.answered = !question.through && in_view.casters.empty();
  if (found.answered) {
    question.answers.front().projected_area = seen.area * asked.cosine;
    memory = std::move(in_view.casters);
    return found;
  }
  found.transmits = parts_.transmission.any_transmits(in_view.casters);
  bool const screened = parts_.transmission.any_screen(in_view.casters);
  bool const may_be_exact =
      !parts_.samples_only && !in_view.warped && !parts_.transmission.any_body(in_view.casters);
  auto const answer_of = [&](double most_steps) {
    if (static_cast<double>(in_view.casters.size()) > most_steps) return false;
    if (!answer_exactly(asked, relative(in_view.casters, seen), most_steps)) return false;
    memory = std::move(in_view.casters);
    return true;
  };
  found.answered = may_be_exact && !tried && answer_of(few_steps);
  if (found.answered) return found;
  Detail detail = casters.detail(in_view.casters, *seen.frame, question.towards_sun, enough);
  lay_out(detail, screened);
  double const most_steps = sample_cost(detail, found.side, found.transmits, interiors);
  found.answered = may_be_exact && most_steps > few_steps && answer_of(most_steps);
  return found;
}

std::optional<std::size_t> QuestionBatch::answer_in_sector(Asked const& asked) const {
  static thread_local std::vector<RelativePolygon const*> kept;
  auto& counted = kept;
  counted.clear();
  for (std::size_t i = 0; i < asked.in_sector->positions.size(); ++i) {
    if (parts_.casters.counts_at(asked.in_sector->positions[i], asked.question.towards_sun)) {
      counted.push_back(asked.in_sector->polygons[i]);
    }
  }
  return answer_exactly(asked, counted, few_steps);
}

std::optional<std::size_t> QuestionBatch::answer_exactly(Asked const& asked, Polygons casters,
                                                         double most_steps) const {
  Receiver const& seen = *asked.receiver;
  auto const found = exact_sums(parts_.scene, parts_.transmission,
                                {seen.outline, *seen.frame, asked.question.towards_sun, casters,
                                 asked.question.through, asked.interiors},
                                most_steps);
  if (!found) return std::nullopt;
  answer(asked, found->sums, 1.0, 0.0);
  return found->casters;
}

QuestionBatch::Polygons QuestionBatch::relative(std::span<SurfaceId const> casters,
                                                Receiver const& receiver) const {
  // Kept from one question to the next.
  struct Workspace {
    std::vector<RelativePolygon> polygons;
    std::vector<RelativePolygon const*> pointers;
  };
  static thread_local auto const workspace = std::make_unique<Workspace>();
  auto& [polygons, pointers] = *workspace;
  if (polygons.size() < casters.size()) polygons.resize(casters.size());
  pointers.clear();
  for (std::size_t i = 0; i < casters.size(); ++i) {
    polygons[i].set(casters[i], parts_.scene[casters[i]].polygon, *receiver.frame,
                    RelativePolygon::Side::in_front);
    pointers.push_back(&polygons[i]);
  }
  return pointers;
}

void QuestionBatch::enqueue(Asked const& asked, Found found, std::vector<ReceiverView>& views) {
  Question const& question = asked.question;
  Receiver const& seen = *asked.receiver;
  if (found.answered) {
    if (question.through) return;
    if (found.casters == 0) {
      ++parts_.statistics.receivers_clear;
    } else {
      count(found.casters, found.transmits);
    }
    return;
  }
  ReceiverView view{question.receiver,    &*seen.frame,     nullptr,
                    question.towards_sun, asked.cosine,     std::move(found.in_view.casters),
                    found.transmits,      question.through, question.interiors};
  if (found.crowd_count > 0.0) {
    view.crowd = &parts_.casters;
    view.crowd_count = found.crowd_count;
    view.is_window = seen.is_window;
  }
  view.side = found.side;
  view.slopes = found.slopes;
  view.max_error = parts_.receivers.size().error();
  Tile* tile = nullptr;
  if (!measured()) {
    tile = &parts_.receivers.tile(view.receiver, found.side, {.slope = found.slope});
  }
  view.tile = tile;
  view.at_pixels = parts_.receivers.size().is_fixed();
  std::size_t const casters_drawn =
      view.crowd != nullptr ? static_cast<std::size_t>(view.crowd_count) : view.casters.size();
  viewed_.push_back({asked, found.side, tile, casters_drawn, found.transmits});
  views.push_back(std::move(view));
}

void QuestionBatch::stretch_tiles(std::vector<ReceiverView>& views) {
  std::vector<double> stretches(views.size());
  for_each_index(views.size(), [&](std::size_t i) {
    ReceiverView const& view = views[i];
    if (view.crowd != nullptr) {
      stretches[i] = 1.0;
      return;
    }
    stretches[i] =
        stretch_without_aliasing({view.receiver, *view.frame, *view.tile, view.towards_sun,
                                  view.pixel_area(), view.casters, view.transmits},
                                 parts_.scene, parts_.transmission);
  });
  std::size_t const first = viewed_.size() - views.size();
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (stretches[i] == 1.0) continue;
    Viewed& viewed = viewed_[first + i];
    TileLay const lay{viewed.tile->lay.slope, stretches[i]};
    viewed.tile = &parts_.receivers.tile(views[i].receiver, viewed.side, lay);
    views[i].tile = viewed.tile;
  }
}

void QuestionBatch::finish() {
  cull();
  std::vector<ViewSums> const sums = parts_.backend.finish();
  std::vector<Question> again;
  for (std::size_t i = 0; i < viewed_.size(); ++i) {
    Viewed const& viewed = viewed_[i];
    if (sums[i].receiver_pixels > 0) {
      auto error = sums[i].uncertainty;
      if (error) error = std::max(*error, Sunlit::rounding);
      answer(viewed.asked, sums[i].parts, static_cast<double>(sums[i].receiver_pixels), error);
      if (!viewed.asked.question.through) count(viewed.casters, viewed.transmits);
    } else {
      Question const& question = viewed.asked.question;
      parts_.receivers.bound(question.receiver, *viewed.tile);
      again.push_back(question);
    }
  }
  viewed_.clear();
  for (Question const& question : again) ask(question);
  if (!again.empty()) finish();
}

void QuestionBatch::answer(Asked const& asked, std::span<LuminanceSums const> parts, double whole,
                           std::optional<double> error) const {
  for (std::size_t i = 0; i < parts.size(); ++i) {
    asked.question.answers[i] = sunlit(parts[i], asked, whole);
    asked.question.answers[i].error = error;
  }
}

void QuestionBatch::count(std::size_t casters, bool transmits) {
  ++parts_.statistics.receivers_drawn;
  parts_.statistics.casters_drawn += casters;
  if (transmits) ++parts_.statistics.luminance_views;
}

Sunlit QuestionBatch::sunlit(LuminanceSums const& sums, Asked const& asked, double whole) const {
  auto const& schedules = parts_.transmission.schedules();
  double const per_sum = asked.receiver->area * asked.cosine / whole;
  Sunlit answer;
  answer.projected_area = sums.unscheduled * per_sum;
  for (LuminanceSums::Scheduled const& part : sums.scheduled) {
    std::vector<std::pair<int, int>> powers = part.powers;
    for (auto& [schedule, power] : powers) {
      schedule = schedules[static_cast<std::size_t>(schedule)];
    }
    answer.scheduled.push_back({std::move(powers), part.sum * per_sum});
  }
  return answer;
}

}  // namespace gpu_shading
