#include "session/sampled_answers.h"

#include <utility>

#include "session/foreseen_directions.h"

namespace gpu_shading::energyplus {

SampledAnswers::SampledAnswers(Sampling sampling, std::vector<glm::dvec3> areas)
    : sampling_(sampling), areas_(std::move(areas)) {}

void SampledAnswers::sample(State& state, std::vector<SurfaceId> receivers, Source const& source) {
  std::erase_if(receivers, [&](SurfaceId id) { return state.places.contains(id); });
  std::vector<glm::dvec3> areas;
  areas.reserve(receivers.size());
  for (auto const id : receivers) {
    state.places[id] = {state.batches.size(), areas.size()};
    areas.push_back(areas_[id]);
  }
  state.batches.emplace_back(
      sampling_, latitude_, std::move(areas),
      [&](std::span<SunDirection const> directions) { return source(directions, receivers); });
  sampled_ += state.batches.back().directions().size();
  state.sun.reset();
}

// The first state is. Of the others, which may be as many as there are times of day, one is when as
// many directions were rendered for it as it would take samples: then no choice costs more than
// twice what the better one would have.
bool SampledAnswers::worth_samples(State& state, SunDirection sun) {
  if (states_.size() == 1 || !state.batches.empty()) return true;
  if (!last_rendered_ || !(*last_rendered_ == sun)) ++state.rendered;
  last_rendered_ = sun;
  return state.rendered > most_directions(sampling_.density);
}

Sunlit const* SampledAnswers::find(SurfaceId receiver, Question const& question,
                                   std::vector<SurfaceId> const& receivers, Source const& source) {
  auto const& [sun, number, latitude] = question;
  if (is_sky_patch(sun) || !in_suns_range(sun, latitude)) return nullptr;
  if (latitude != latitude_) states_.clear();
  latitude_ = latitude;
  auto& state = states_[number];
  if (!worth_samples(state, sun)) return nullptr;
  if (!state.places.contains(receiver)) sample(state, receivers, source);
  if (!state.sun || !(*state.sun == sun)) {
    state.rows.clear();
    for (auto const& batch : state.batches) state.rows.push_back(batch.at(sun));
    state.sun = sun;
    ++answered_;
  }
  auto const place = state.places.at(receiver);
  if (!state.batches[place.batch].knows(place.row)) return nullptr;
  return &state.rows[place.batch][place.row];
}

std::vector<Sunlit> const* SampledAnswers::find_interior(SurfaceId window,
                                                         std::uint64_t window_and_list,
                                                         std::size_t interiors,
                                                         Question const& question,
                                                         SunlitSource const& source) {
  auto& state = states_[question.state];
  auto const place = state.places.find(window);
  if (place == state.places.end() || !state.sun || !(*state.sun == question.sun)) return nullptr;
  auto const& batch = state.batches[place->second.batch];
  if (!batch.knows(place->second.row)) return nullptr;
  auto found = state.interiors.find(window_and_list);
  if (found == state.interiors.end()) {
    // What falls on an interior surface is a share of what the window might let in.
    std::vector<glm::dvec3> areas(interiors, areas_[window]);
    Interior interior{batch.with(std::move(areas), source), std::nullopt, {}};
    found = state.interiors.emplace(window_and_list, std::move(interior)).first;
  }
  auto& interior = found->second;
  if (!interior.sun || !(*interior.sun == question.sun)) {
    interior.row = interior.samples.at(question.sun);
    interior.sun = question.sun;
  }
  return &interior.row;
}

}  // namespace gpu_shading::energyplus
