#include "answers/answer_store.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace gpu_shading::energyplus {
namespace {

std::size_t bytes_of(std::vector<ScheduledPart> const& parts) {
  std::size_t bytes = 0;
  for (auto const& part : parts) {
    bytes += sizeof part + part.powers.size() * sizeof part.powers.front();
  }
  return bytes;
}

}  // namespace

float kept_error(std::optional<double> error) {
  return error ? static_cast<float>(*error) : std::numeric_limits<float>::quiet_NaN();
}

std::optional<double> error_of(float kept) {
  return std::isnan(kept) ? std::nullopt : std::optional<double>(kept);
}

bool AnswerLimits::allow(Sunlit const& answer, double area) const {
  // Answers are rounded to single precision.
  constexpr double rounding = 1e-5;
  auto const most = area * (1.0 + rounding) + rounding * rounding;
  auto const allows = [&](double part) { return part >= 0.0 && part <= most; };
  double sum = answer.projected_area;
  if (!allows(sum) || !(answer.error.value_or(0.0) >= 0.0)) return false;
  for (auto const& part : answer.scheduled) {
    sum += part.projected_area;
    if (!allows(part.projected_area) || !allows(sum)) return false;
    for (auto const& [schedule, power] : part.powers) {
      if (schedule < 0 || static_cast<std::size_t>(schedule) >= schedules || power < 1)
        return false;
    }
  }
  return true;
}

Sunlit AnswerStore::Direction::sunlit(ReceiverNumber receiver) const {
  Sunlit answer;
  answer.error = error(receiver);
  answer.projected_area = projected_area[receiver];
  auto const parts = scheduled.find(receiver);
  if (parts != scheduled.end()) answer.scheduled = parts->second;
  return answer;
}

double AnswerStore::Direction::area(ReceiverNumber receiver,
                                    std::span<double const> factors) const {
  double const unscheduled = projected_area[receiver];
  auto const parts = scheduled.find(receiver);
  return parts == scheduled.end() ? unscheduled
                                  : unscheduled + through_schedules(parts->second, factors);
}

std::vector<Sunlit> AnswerStore::Direction::sunlit(Interior const& answers) const {
  std::vector<Sunlit> found(answers.count);
  for (std::uint32_t i = 0; i < answers.count; ++i) {
    found[i].projected_area = interior_area[answers.first + i];
    found[i].error = error_of(answers.error);
    auto const parts = interior_scheduled.find(answers.first + i);
    if (parts != interior_scheduled.end()) found[i].scheduled = parts->second;
  }
  return found;
}

std::vector<float> AnswerStore::Direction::areas(Interior const& answers,
                                                 std::span<double const> factors) const {
  auto const first = interior_area.begin() + answers.first;
  std::vector<float> areas(first, first + answers.count);
  if (interior_scheduled.empty()) return areas;
  for (std::uint32_t i = 0; i < answers.count; ++i) {
    auto const parts = interior_scheduled.find(answers.first + i);
    if (parts == interior_scheduled.end()) continue;
    areas[i] = static_cast<float>(areas[i] + through_schedules(parts->second, factors));
  }
  return areas;
}

void AnswerStore::clear() {
  directions_.clear();
  bytes_ = 0;
}

AnswerStore::Direction& AnswerStore::at(SunDirection sun, std::uint32_t state) {
  auto const [found, added] = directions_.try_emplace({sun, state});
  auto& direction = found->second;
  if (added) {
    direction.sun = sun;
    direction.state = state;
    bytes_ += sizeof(Direction);
  }
  return direction;
}

AnswerStore::Direction const* AnswerStore::find(SunDirection sun, std::uint32_t state) const {
  auto const found = directions_.find({sun, state});
  return found == directions_.end() ? nullptr : &found->second;
}

void AnswerStore::keep(Direction& direction, ReceiverNumber receiver, Sunlit answer) {
  auto& areas = direction.projected_area;
  if (receiver >= areas.size()) {
    auto const before = areas.size();
    areas.resize(receiver + std::size_t{1}, std::numeric_limits<float>::quiet_NaN());
    bytes_ += (areas.size() - before) * sizeof areas.front();
  }
  areas[receiver] = static_cast<float>(answer.projected_area);
  auto& errors = direction.errors;
  if (answer.error != 0.0 || receiver < errors.size()) {
    auto const before = errors.size();
    errors.resize(std::max(before, receiver + std::size_t{1}), 0.0F);
    bytes_ += (errors.size() - before) * sizeof errors.front();
    errors[receiver] = kept_error(answer.error);
  }
  if (answer.scheduled.empty()) return;
  bytes_ += bytes_of(answer.scheduled);
  direction.scheduled[receiver] = std::move(answer.scheduled);
}

void AnswerStore::copy(Direction const& from, ReceiverNumber known, Direction& direction,
                       ReceiverNumber receiver) {
  keep(direction, receiver, from.sunlit(known));
}

AnswerStore::Direction::Interior& AnswerStore::keep_interior(Direction& direction,
                                                             std::uint64_t window_and_list,
                                                             std::vector<Sunlit> answers) {
  auto& areas = direction.interior_area;
  auto const first = static_cast<std::uint32_t>(areas.size());
  bytes_ += sizeof(Direction::Interior) + answers.size() * sizeof areas.front();
  areas.resize(first + answers.size());
  for (std::size_t i = 0; i < answers.size(); ++i) {
    auto const place = static_cast<std::uint32_t>(first + i);
    areas[place] = static_cast<float>(answers[i].projected_area);
    if (answers[i].scheduled.empty()) continue;
    bytes_ += bytes_of(answers[i].scheduled);
    direction.interior_scheduled[place] = std::move(answers[i].scheduled);
  }
  auto& kept = direction.interior[window_and_list];
  kept = {first, static_cast<std::uint32_t>(answers.size()), 0.0F, std::nullopt};
  // All are of one view.
  if (!answers.empty()) kept.error = kept_error(answers.front().error);
  return kept;
}

}  // namespace gpu_shading::energyplus
