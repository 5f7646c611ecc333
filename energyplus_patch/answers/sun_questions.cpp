#include "answers/sun_questions.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <numeric>
#include <utility>

#include "scene/sky_grid.h"

namespace gpu_shading::energyplus {
namespace {

std::vector<float> areas_of(std::vector<Sunlit> const& answers, std::span<double const> factors) {
  std::vector<float> areas;
  areas.reserve(answers.size());
  for (auto const& sunlit : answers) areas.push_back(static_cast<float>(sunlit.at(factors)));
  return areas;
}

}  // namespace

SunQuestions::SunQuestions(Site site) : site_(std::move(site)), asked_(site_.areas.size(), false) {}

void SunQuestions::open(CachedRenderer rendered) {
  rendered_.emplace(std::move(rendered));
  if (site_.sampling) sampled_.emplace(*site_.sampling, *rendered_);
}

void SunQuestions::close() {
  earlier_ += rendered_->counts();
  earlier_errors_ += rendered_->errors();
  sampled_.reset();
  rendered_.reset();
}

void SunQuestions::set_sun(SunDirection sun) {
  sun_ = predicted_.snap_to_known(sun, site_.latitude);
  sky_ = is_sky_patch(sun_);
  towards_kept_ = to_vector(sun_);
  towards_sun_ = to_vector(sun);
}

// Where screens and shades move, they may be elsewhere when the sun is where it is expected.
AskedSun SunQuestions::asked_sun() const {
  bool const days = !sampled_ && rendered_->known().states.size() == 1;
  return {sun_, days || sky_ ? predicted_.ahead() : std::span<SunDirection const>()};
}

// What the sun as EnergyPlus handed it over gives a surface that gets 1 from where answers are
// kept. EnergyPlus divides by the cosine of incidence, so that at grazing incidence the rounding
// between the two directions would count for much.
double SunQuestions::for_this_sun(SurfaceId surface) const {
  double const kept = glm::dot(site_.areas[surface], towards_kept_);
  return kept > 0.0 ? unshaded_area(surface) / kept : 1.0;
}

double SunQuestions::unshaded_area(SurfaceId surface) const {
  return std::max(glm::dot(site_.areas[surface], towards_sun_), 0.0);
}

Sunlit const* SunQuestions::find_sampled(SurfaceId receiver) {
  return sampled_ ? sampled_->find(receiver, {sun_, site_.latitude()}) : nullptr;
}

double SunQuestions::area(SurfaceId receiver, std::span<double const> factors) {
  asked_[receiver] = true;
  auto const* const sampled = find_sampled(receiver);
  double const kept =
      sampled != nullptr ? sampled->at(factors) : rendered_->area(receiver, asked_sun(), factors);
  return kept * for_this_sun(receiver);
}

// Empty if they have to be rendered.
std::vector<float> SunQuestions::sampled_interior_areas(InteriorKey const& key,
                                                        std::span<double const> factors) {
  auto const* const through = find_sampled(key.question.window);
  if (through == nullptr) return {};
  double const most = through->at(factors);
  auto const* const row = sampled_->find_interior(key, sun_);
  if (row == nullptr) return {};
  auto areas = areas_of(*row, factors);
  // Each area is interpolated separately, so their sum is limited to the window's area.
  double const sum = std::accumulate(areas.begin(), areas.end(), 0.0);
  if (sum > most) {
    for (auto& area : areas) area = static_cast<float>(area * most / sum);
  }
  return areas;
}

std::vector<float> SunQuestions::interior_areas(InteriorKey const& key,
                                                std::span<double const> factors) {
  if (sky_) return std::vector<float>(key.question.interiors.size(), 0.0F);
  auto areas = sampled_interior_areas(key, factors);
  if (areas.empty()) areas = rendered_->interior(key, asked_sun(), factors);
  auto const factor = static_cast<float>(for_this_sun(key.question.window));
  for (float& area : areas) area *= factor;
  return areas;
}

CachedRenderer::Counts SunQuestions::counts() const {
  auto counts = earlier_;
  if (rendered_) counts += rendered_->counts();
  return counts;
}

AnswerErrors SunQuestions::errors() const {
  auto errors = earlier_errors_;
  if (rendered_) errors += rendered_->errors();
  return errors;
}

}  // namespace gpu_shading::energyplus
