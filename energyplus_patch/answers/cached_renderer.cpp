#include "answers/cached_renderer.h"

#include <xxhash.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <numeric>
#include <utility>

#include "gpu_shading/error.h"

namespace gpu_shading::energyplus {
namespace {

// A larger batch is no faster.
constexpr std::size_t max_views = std::size_t{1} << 16U;

// As many of the directions ahead as are worth one batch with so many views of each.
std::span<SunDirection const> first_of(std::span<SunDirection const> ahead, std::size_t views) {
  return ahead.first(std::min(ahead.size(), max_views / std::max(views, std::size_t{1})));
}

std::vector<SunDirection> suns_of(std::vector<AnswerStore::Direction*> const& directions) {
  std::vector<SunDirection> suns;
  suns.reserve(directions.size());
  for (auto const* direction : directions) suns.push_back(direction->sun);
  return suns;
}

}  // namespace

InteriorKey::InteriorKey(InteriorQuestion asked)
    : question(std::move(asked)),
      hash(XXH3_64bits_withSeed(question.interiors.data(),
                                question.interiors.size() * sizeof(SurfaceId), question.window)) {}

AskedWindow::AskedWindow(Scene const& scene, SurfaceId window)
    : normal_(normal(scene[window].polygon)) {}

std::uint64_t AskedWindow::sides(glm::dvec3 const& towards_sun) const {
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < listed_.size(); ++i) {
    if (glm::dot(listed_[i].normal, towards_sun) > 0.0) bits |= std::uint64_t{1} << i;
  }
  return bits;
}

void AskedWindow::ask(Scene const& scene, InteriorKey const& key, glm::dvec3 const& towards_sun) {
  constexpr std::size_t most_surfaces = 64;
  constexpr std::size_t most_lists = 16;
  for (auto const surface : key.question.interiors) {
    bool const known =
        std::ranges::any_of(listed_, [&](Listed const& one) { return one.surface == surface; });
    if (known || listed_.size() == most_surfaces) continue;
    listed_.push_back({surface, normal(scene[surface].polygon)});
    for (Asked& asked : asked_) asked.sides = sides(asked.towards_sun);
  }
  auto const now = sides(towards_sun);
  std::erase_if(asked_, [&](Asked const& asked) { return asked.sides == now; });
  if (asked_.size() == most_lists) asked_.erase(asked_.begin());
  asked_.push_back({key, towards_sun, now});
}

InteriorKey const* AskedWindow::foresee(glm::dvec3 const& towards_sun) const {
  if (glm::dot(normal_, towards_sun) <= 0.0) return nullptr;
  auto const now = sides(towards_sun);
  auto const asked = std::ranges::find(asked_, now, &Asked::sides);
  return asked == asked_.end() ? nullptr : &asked->key;
}

CachedRenderer::Counts& CachedRenderer::Counts::operator+=(Counts const& other) {
  directions += other.directions;
  recalled += other.recalled;
  rendering += other.rendering;
  return *this;
}

CachedRenderer::CachedRenderer(Renderer renderer, std::optional<DiskCache> cache,
                               std::span<SurfaceId const> receivers, MovedRenderers::Positions rest,
                               MovedRenderers::Open open_moved)
    : renderers_(std::move(renderer), std::move(rest), std::move(open_moved)),
      current_(&renderers_.at_rest()),
      cache_(std::move(cache)),
      numbers_(current_->scene().size()) {
  for (auto const receiver : receivers) number_of(receiver);
}

ReceiverNumber CachedRenderer::number_of(SurfaceId receiver) {
  auto& number = numbers_[receiver];
  if (!number) {
    number = static_cast<ReceiverNumber>(known_.receivers.size());
    known_.receivers.push_back(receiver);
  }
  return *number;
}

std::vector<SurfaceId> const& CachedRenderer::receivers_with(SurfaceId receiver) {
  number_of(receiver);
  return known_.receivers;
}

void CachedRenderer::deploy(std::vector<double> const& shares,
                            std::vector<double> const& positions) {
  auto both = shares;
  both.insert(both.end(), positions.begin(), positions.end());
  auto const state = known_.states.number_of(both);
  if (state == state_ && deployed_) return;
  positions_ = positions.size();
  current_ = &renderers_.at(positions);
  current_->set_deployments(shares);
  state_ = state;
  deployed_ = true;
}

glm::dvec3 CachedRenderer::area_vector(SurfaceId id) const {
  auto const& polygon = current_->scene()[id].polygon;
  double const size = gpu_shading::area(polygon);
  return size > 0.0 ? size * normal(polygon) : glm::dvec3(0.0);
}

Renderer& CachedRenderer::renderer_in(std::uint32_t state) {
  auto const& both = known_.states[state];
  auto const middle = both.end() - static_cast<std::ptrdiff_t>(positions_);
  deploy({both.begin(), middle}, {middle, both.end()});
  return *current_;
}

// Directions that are held across this call are lost.
void CachedRenderer::make_room() {
  if (!known_.answers.is_full()) return;
  errors_of_forgotten_ = errors();
  known_.answers.clear();
  last_ = nullptr;
  ahead_.clear();
}

// Most questions are about the direction of the one before: only the first of them looks it up.
AnswerStore::Direction& CachedRenderer::direction_at(SunDirection sun) {
  if (last_ == nullptr || last_->state != state_ || !(last_->sun == sun)) {
    make_room();
    last_ = directions_ahead({&sun, 1}).front();
    ahead_.pop_back();
  }
  return *last_;
}

// Those that are known need not be searched for again.
CachedRenderer::Directions CachedRenderer::directions_ahead(std::span<SunDirection const> suns) {
  Directions directions;
  directions.reserve(suns.size());
  bool follows = true;
  for (auto const sun : suns) {
    auto const place = directions.size();
    follows = follows && place < ahead_.size();
    auto* const next = follows ? ahead_[ahead_.size() - 1 - place] : nullptr;
    follows = follows && next->state == state_ && next->sun == sun;
    directions.push_back(follows ? next : &known_.answers.at(sun, state_));
  }
  if (!follows) ahead_.assign(directions.rbegin(), directions.rend());
  return directions;
}

void CachedRenderer::recall(Direction& direction) {
  if (cache_) cache_->recall(known_, direction);
}

double CachedRenderer::area(SurfaceId receiver, AskedSun const& asked,
                            std::span<double const> factors) {
  auto const number = number_of(receiver);
  auto& direction = direction_at(asked.sun);
  if (!direction.knows(number)) recall(direction);
  if (!direction.knows(number)) {
    auto directions = directions_ahead(first_of(asked.ahead, known_.receivers.size()));
    for (auto* const next : directions) recall(*next);
    directions.push_back(&direction);
    // EnergyPlus asks about some receivers never, which shows at the sky's patches.
    std::vector<ReceiverNumber> wanted(known_.receivers.size());
    std::iota(wanted.begin(), wanted.end(), ReceiverNumber{0});
    if (!asked_.empty()) {
      std::erase_if(wanted, [&](auto other) {
        return other != number && (other >= asked_.size() || !asked_[other]);
      });
    }
    render(directions, wanted);
  }
  if (number >= asked_.size()) asked_.resize(known_.receivers.size(), false);
  asked_[number] = true;
  if (!direction.asked && !direction.recalled) ++directions_;
  direction.asked = true;
  return direction.area(number, factors);
}

std::vector<std::vector<Sunlit>> CachedRenderer::at(std::span<SunDirection const> suns,
                                                    std::span<SurfaceId const> receivers) {
  make_room();
  std::vector<ReceiverNumber> numbers;
  for (auto const receiver : receivers) numbers.push_back(number_of(receiver));
  Directions directions;
  for (auto const sun : suns) {
    auto& direction = known_.answers.at(sun, state_);
    bool const lacks_any =
        std::ranges::any_of(numbers, [&](auto number) { return !direction.knows(number); });
    if (lacks_any) recall(direction);
    direction.sampled = true;
    directions.push_back(&direction);
  }
  directions_ += render(directions, numbers);
  std::vector<std::vector<Sunlit>> rows;
  for (auto const* direction : directions) {
    auto& row = rows.emplace_back();
    for (auto const number : numbers) row.push_back(direction->sunlit(number));
  }
  return rows;
}

// Renders the directions and the receivers of which something is unknown. Returns the number of
// directions.
std::size_t CachedRenderer::render(Directions const& directions,
                                   std::span<ReceiverNumber const> receivers) {
  Directions unknown;
  std::vector<bool> lacking(receivers.size(), false);
  for (auto* const direction : directions) {
    bool lacks_any = false;
    for (std::size_t i = 0; i < receivers.size(); ++i) {
      if (direction->knows(receivers[i])) continue;
      lacking[i] = true;
      lacks_any = true;
    }
    if (lacks_any) unknown.push_back(direction);
  }
  if (unknown.empty()) return 0;
  to_store_ = true;
  std::vector<ReceiverNumber> wanted;
  std::vector<SurfaceId> surfaces;
  for (std::size_t i = 0; i < receivers.size(); ++i) {
    if (!lacking[i]) continue;
    wanted.push_back(receivers[i]);
    surfaces.push_back(known_.receivers[receivers[i]]);
  }
  auto rendered = current_->projected_sunlit_areas(suns_of(unknown), surfaces);
  for (std::size_t i = 0; i < unknown.size(); ++i) {
    unknown[i]->projected_area.reserve(known_.receivers.size());
    for (std::size_t k = 0; k < wanted.size(); ++k) {
      known_.answers.keep(*unknown[i], wanted[k], std::move(rendered[i][k]));
    }
  }
  return unknown.size();
}

// nullptr: unknown.
AnswerStore::Direction::Interior* CachedRenderer::find_interior(Direction& direction,
                                                                std::uint64_t hash) {
  auto const known = direction.interior.find(hash);
  if (known != direction.interior.end()) return &known->second;
  return cache_ ? cache_->recall_interior(known_, direction, hash) : nullptr;
}

std::vector<float> CachedRenderer::interior(InteriorKey const& key, AskedSun const& asked,
                                            std::span<double const> factors) {
  auto const& scene = renderer().scene();
  auto const window = key.question.window;
  auto& direction = direction_at(asked.sun);
  auto const answer = [&](Direction::Interior& known) {
    known.window = window;
    return direction.areas(known, factors);
  };
  if (auto* const known = find_interior(direction, key.hash)) return answer(*known);
  windows_.try_emplace(window, scene, window).first->second.ask(scene, key, to_vector(asked.sun));
  // Questions by the directions at which they are unknown: of most windows, these are the same.
  std::vector<std::pair<Directions, std::vector<InteriorKey const*>>> batches;
  std::vector<std::pair<Direction*, glm::dvec3>> ahead{{&direction, to_vector(asked.sun)}};
  for (auto* const next : directions_ahead(first_of(asked.ahead, windows_.size()))) {
    ahead.emplace_back(next, to_vector(next->sun));
  }
  for (auto const& [other, asked_window] : windows_) {
    std::vector<std::pair<InteriorKey const*, Directions>> foreseen;
    for (auto const& [next, towards_sun] : ahead) {
      auto const* const question = asked_window.foresee(towards_sun);
      if (question == nullptr || find_interior(*next, question->hash) != nullptr) continue;
      if (foreseen.empty() || foreseen.back().first != question) foreseen.push_back({question, {}});
      foreseen.back().second.push_back(next);
    }
    for (auto& each : foreseen) {
      auto const batch = std::ranges::find_if(
          batches, [&](auto const& known) { return known.first == each.second; });
      if (batch != batches.end()) {
        batch->second.push_back(each.first);
      } else {
        batches.emplace_back(std::move(each.second), std::vector{each.first});
      }
    }
  }
  for (auto const& [directions, questions] : batches) render_interiors(directions, questions);
  if (find_interior(direction, key.hash) == nullptr) render_interiors({&direction}, {&key});
  return answer(*find_interior(direction, key.hash));
}

std::vector<std::vector<Sunlit>> CachedRenderer::interior_at(std::span<SunDirection const> suns,
                                                             InteriorKey const& key) {
  make_room();
  Directions directions;
  Directions unknown;
  for (auto const sun : suns) {
    auto& direction = known_.answers.at(sun, state_);
    directions.push_back(&direction);
    if (find_interior(direction, key.hash) == nullptr) unknown.push_back(&direction);
  }
  render_interiors(unknown, {&key});
  std::vector<std::vector<Sunlit>> rows;
  rows.reserve(directions.size());
  for (auto* const direction : directions) {
    auto& known = *find_interior(*direction, key.hash);
    known.window = key.question.window;
    rows.push_back(direction->sunlit(known));
  }
  return rows;
}

void CachedRenderer::render_interiors(Directions const& directions,
                                      std::vector<InteriorKey const*> const& questions) {
  if (directions.empty()) return;
  to_store_ = true;
  std::vector<InteriorQuestion> wanted;
  wanted.reserve(questions.size());
  for (auto const* key : questions) wanted.push_back(key->question);
  auto rendered = current_->interior_sunlit_areas(suns_of(directions), wanted);
  for (std::size_t i = 0; i < directions.size(); ++i) {
    for (std::size_t k = 0; k < questions.size(); ++k) {
      known_.answers.keep_interior(*directions[i], questions[k]->hash, std::move(rendered[i][k]));
    }
  }
}

void CachedRenderer::store() {
  if (!cache_ || !to_store_) return;
  to_store_ = false;
  cache_->store(known_);
}

CachedRenderer::Counts CachedRenderer::counts() const {
  return {directions_, cache_ ? cache_->directions_recalled() : 0, renderers_.statistics()};
}

AnswerErrors CachedRenderer::errors() const {
  AnswerErrors errors = errors_of_forgotten_;
  std::vector<glm::dvec3> facing;
  facing.reserve(known_.receivers.size());
  for (auto const id : known_.receivers) facing.push_back(normal(renderer().scene()[id].polygon));
  known_.answers.for_each([&](Direction const& direction) {
    if (!direction.asked && !direction.sampled) return;
    auto const towards_sun = to_vector(direction.sun);
    for (ReceiverNumber number = 0; number < direction.projected_area.size(); ++number) {
      bool const wanted = direction.sampled || (number < asked_.size() && asked_[number]);
      if (wanted && direction.knows(number) && glm::dot(facing[number], towards_sun) > 0.0) {
        errors.add(known_.receivers[number], direction.error(number));
      }
    }
    for (auto const& [question, answers] : direction.interior) {
      if (answers.window) errors.add(*answers.window, error_of(answers.error));
    }
  });
  return errors;
}

RendererOptions watched_options(Options const& options, Messages const& messages) {
  auto watched = renderer_options(options);
  if (options.mode != Mode::require) watched.warn = messages.warning;
  return watched;
}

CachedRenderer open_renderer(SceneAssembly const& scene, std::span<SurfaceId const> receivers,
                             DeviceChoice const& device, Messages const& messages) {
  auto const& options = scene.model().options;
  auto rendering = watched_options(options, messages);
  rendering.device = device;
  Renderer renderer(scene.scene_at(scene.rest_positions()), rendering);
  std::optional<DiskCache> cache;
  if (options.cache) {
    auto const hash = scene.hash(renderer.scene(), renderer.device());
    AnswerLimits limits{{}, scene.optics().factor_names().size()};
    for (SurfaceId id = 0; id < renderer.scene().size(); ++id) {
      // An awning is largest as it is drawn.
      double const drawn = id < scene.surfaces().size() ? area(scene.surfaces()[id].polygon) : 0.0;
      limits.areas.push_back(std::max(drawn, area(renderer.scene()[id].polygon)));
    }
    cache.emplace(*options.cache, hash, std::move(limits), messages.remark);
  }
  CachedRenderer answers(
      std::move(renderer), std::move(cache), receivers, scene.rest_positions(),
      [&scene, rendering](MovedRenderers::Positions const& positions, DeviceId const& opened) {
        auto moved = rendering;
        moved.device = DeviceChoice{opened};
        return Renderer(scene.scene_at(positions), moved);
      });
  answers.deploy(scene.optics().deployments(), scene.positions());
  return answers;
}

void write_cache(CachedRenderer& answers, Messages const& messages) {
  try {
    answers.store();
  } catch (Error const& error) {
    messages.warning(error.what());
  }
}

}  // namespace gpu_shading::energyplus
