#include "render/question_batch.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <utility>

#include "render/tile_stretch.h"
#include "threads/parallel.h"
#include "view/stopwatch.h"

namespace gpu_shading {
namespace {

// Number of answers awaited at a time, because their sums take memory.
constexpr std::size_t most_viewed = 16384;
// Number of questions whose casters are searched at a time, because the results take memory.
constexpr std::size_t most_asked = 64;

}  // namespace

QuestionBatch::QuestionBatch(Parts const& parts) : parts_(parts) { parts_.backend.forget(); }

void QuestionBatch::ask(Question const& question) {
  for (SurfaceId const id : question.interiors) parts_.receivers.surface(id);
  Receiver const& seen = parts_.receivers[question.receiver];
  if (!seen.frame || question.answers.empty()) return;
  double const cosine = glm::dot(seen.frame->normal, question.towards_sun);
  if (cosine <= edge_on) return;
  asked_.push_back({question, &seen, cosine});
  if (asked_.size() < most_asked) return;
  look();
  if (viewed_.size() >= most_viewed) finish();
}

void QuestionBatch::look() {
  std::vector<InView> in_view(asked_.size());
  {
    Stopwatch const watch(parts_.statistics.cull_seconds);
    for_each_index(asked_.size(), [&](std::size_t i) {
      Asked const& asked = asked_[i];
      in_view[i] =
          parts_.casters.in_view(parts_.scene, asked.question.receiver, *asked.receiver->frame,
                                 asked.question.towards_sun, parts_.receivers.size().enough());
    });
  }
  std::vector<ReceiverView> views;
  for (std::size_t i = 0; i < asked_.size(); ++i) take(asked_[i], std::move(in_view[i]), views);
  asked_.clear();
  if (parts_.backend.samples_pixels()) stretch_tiles(views);
  parts_.backend.add(std::move(views));
}

void QuestionBatch::take(Asked const& asked, InView in_view, std::vector<ReceiverView>& views) {
  Question const& question = asked.question;
  Receiver const& seen = *asked.receiver;
  if (!question.through && in_view.casters.empty()) {
    Sunlit& clear = question.answers.front();
    clear.projected_area = seen.area * asked.cosine;
    ++parts_.statistics.receivers_clear;
    return;
  }
  // Where one interior surface ends and the next begins, there is an edge too.
  in_view.detail.across += static_cast<double>(std::min<std::size_t>(question.interiors.size(), 6));
  int const side =
      parts_.receivers.side_for(seen, in_view, parts_.transmission.any_screen(in_view.casters));
  bool const transmits = parts_.transmission.any_transmits(in_view.casters);
  ReceiverView view{question.receiver, &*seen.frame,
                    nullptr,           question.towards_sun,
                    asked.cosine,      std::move(in_view.casters),
                    transmits,         question.through,
                    question.interiors};
  Tile& tile = parts_.receivers.tile(view.receiver, side);
  view.tile = &tile;
  viewed_.push_back({asked, side, &tile, view.casters.size(), transmits});
  views.push_back(std::move(view));
}

void QuestionBatch::stretch_tiles(std::vector<ReceiverView>& views) {
  std::vector<double> stretches(views.size());
  for_each_index(views.size(), [&](std::size_t i) {
    stretches[i] = stretch_without_aliasing(views[i], parts_.scene, parts_.transmission);
  });
  std::size_t const first = viewed_.size() - views.size();
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (stretches[i] == 1.0) continue;
    Viewed& viewed = viewed_[first + i];
    viewed.tile = &parts_.receivers.tile(views[i].receiver, viewed.side, stretches[i]);
    views[i].tile = viewed.tile;
  }
}

void QuestionBatch::finish() {
  look();
  std::vector<ViewSums> const sums = parts_.backend.finish();
  std::vector<Question> again;
  for (std::size_t i = 0; i < viewed_.size(); ++i) {
    if (sums[i].receiver_pixels > 0) {
      answer(viewed_[i], sums[i]);
    } else {
      Question const& question = viewed_[i].asked.question;
      parts_.receivers.bound(question.receiver, *viewed_[i].tile);
      again.push_back(question);
    }
  }
  viewed_.clear();
  for (Question const& question : again) ask(question);
  if (!again.empty()) finish();
}

void QuestionBatch::answer(Viewed const& viewed, ViewSums const& sums) {
  Question const& question = viewed.asked.question;
  for (std::size_t i = 0; i < sums.parts.size(); ++i) {
    question.answers[i] = sunlit(sums.parts[i], viewed, sums.receiver_pixels);
  }
  if (question.through) return;
  ++parts_.statistics.receivers_drawn;
  parts_.statistics.casters_drawn += viewed.casters;
  if (viewed.transmits) ++parts_.statistics.luminance_views;
}

Sunlit QuestionBatch::sunlit(LuminanceSums const& sums, Viewed const& viewed,
                             std::uint64_t pixels) const {
  Asked const& asked = viewed.asked;
  auto const& schedules = parts_.transmission.shades().schedules();
  double const a_pixel = asked.receiver->area * asked.cosine / static_cast<double>(pixels);
  Sunlit answer;
  answer.projected_area = sums.unscheduled * a_pixel;
  for (LuminanceSums::Scheduled const& part : sums.scheduled) {
    std::vector<std::pair<int, int>> powers = part.powers;
    for (auto& [schedule, power] : powers) {
      schedule = schedules[static_cast<std::size_t>(schedule)];
    }
    answer.scheduled.push_back({std::move(powers), part.sum * a_pixel});
  }
  return answer;
}

}  // namespace gpu_shading
