#include "answers/sample_interpolation.h"

#include <algorithm>
#include <utility>

#include "scene/sky_grid.h"

namespace gpu_shading::energyplus {

void SampleInterpolation::sample(State& state, std::vector<SurfaceId> receivers) {
  std::erase_if(receivers, [&](SurfaceId id) { return state.places.contains(id); });
  std::vector<glm::dvec3> areas;
  areas.reserve(receivers.size());
  for (auto const id : receivers) {
    state.places[id] = {state.batches.size(), areas.size()};
    areas.push_back(rendered_->area_vector(id));
  }
  state.batches.emplace_back(
      sampling_, latitude_, std::move(areas),
      [&](std::span<SunDirection const> suns) { return rendered_->at(suns, receivers); });
  auto const& samples = state.batches.back();
  sampled_ += samples.directions().size();
  for (double const error : samples.expected_errors()) {
    expected_error_ = std::max(expected_error_, error);
  }
  state.sun.reset();
}

// The first state is always sampled. There may be as many others as times of day; each is sampled
// once the number of directions rendered for it equals that of its samples. No choice then costs
// more than twice the better one.
bool SampleInterpolation::worth_samples(State& state, SunDirection sun) {
  if (states_.size() == 1 || !state.batches.empty()) return true;
  if (!state.last_rendered || !(*state.last_rendered == sun)) ++state.rendered;
  state.last_rendered = sun;
  return state.rendered > max_directions(sampling_.density);
}

Sunlit const* SampleInterpolation::find(SurfaceId receiver, Question const& question) {
  auto const& [sun, latitude] = question;
  if (is_sky_patch(sun) || !in_suns_range(sun, latitude)) return nullptr;
  if (latitude != latitude_) states_.clear();
  latitude_ = latitude;
  auto& state = states_[rendered_->state()];
  if (!worth_samples(state, sun)) return nullptr;
  if (!state.places.contains(receiver)) sample(state, rendered_->receivers_with(receiver));
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

std::vector<Sunlit> const* SampleInterpolation::find_interior(InteriorKey const& key,
                                                              SunDirection sun) {
  auto& state = states_[rendered_->state()];
  auto const window = key.question.window;
  auto const place = state.places.find(window);
  if (place == state.places.end() || !state.sun || !(*state.sun == sun)) return nullptr;
  auto const& batch = state.batches[place->second.batch];
  if (!batch.knows(place->second.row)) return nullptr;
  auto found = state.interiors.find(key.hash);
  if (found == state.interiors.end()) {
    // The area lit on an interior surface is a fraction of what the window could let in.
    std::vector<glm::dvec3> areas(key.question.interiors.size(), rendered_->area_vector(window));
    auto const source = [&](std::span<SunDirection const> suns) {
      return rendered_->interior_at(suns, key);
    };
    Interior interior{batch.with(std::move(areas), source), std::nullopt, {}};
    found = state.interiors.emplace(key.hash, std::move(interior)).first;
  }
  auto& interior = found->second;
  if (!interior.sun || !(*interior.sun == sun)) {
    interior.row = interior.samples.at(sun);
    interior.sun = sun;
  }
  return &interior.row;
}

}  // namespace gpu_shading::energyplus
