#include "sun/sampling/sunlit_table.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace gpu_shading {

SunlitTable::SunlitTable(std::vector<glm::dvec3> receivers) {
  lit_.resize(receivers.size());
  for (std::size_t i = 0; i < receivers.size(); ++i) {
    double const area = glm::length(receivers[i]);
    receivers_.push_back({area > 0.0 ? receivers[i] / area : glm::dvec3(0.0), area});
    columns_.push_back({i, {}, {}});
  }
}

bool SunlitTable::faces(std::size_t receiver, glm::dvec3 const& sun) const {
  return glm::dot(receivers_[receiver].normal, sun) > min_cosine;
}

SunlitTable::Column& SunlitTable::column_of(std::size_t receiver, Powers const& powers) {
  if (powers.empty()) return columns_[receiver];
  auto const [position, added] = scheduled_.try_emplace({receiver, powers}, columns_.size());
  if (added) {
    columns_.push_back({receiver, powers, std::vector<double>(directions_.size(), 0.0)});
  }
  return columns_[position->second];
}

void SunlitTable::add(std::span<SunDirection const> directions,
                      std::vector<std::vector<Sunlit>> const& answers) {
  std::size_t const before = directions_.size();
  for (auto const direction : directions) {
    directions_.push_back(direction);
    towards_sun_.push_back(to_vector(direction));
  }
  for (auto& column : columns_) column.fractions.resize(directions_.size(), 0.0);
  for (std::size_t receiver = 0; receiver < receivers_.size(); ++receiver) {
    auto const& [normal, area] = receivers_[receiver];
    for (std::size_t i = before; i < directions_.size(); ++i) {
      bool const lit = faces(receiver, towards_sun_[i]);
      lit_[receiver].push_back(lit);
      if (!lit) continue;
      auto const& answer = answers[i - before][receiver];
      double const whole = area * glm::dot(normal, towards_sun_[i]);
      auto const keep = [&](Powers const& powers, double projected) {
        column_of(receiver, powers).fractions[i] = std::clamp(projected / whole, 0.0, 1.0);
      };
      keep({}, answer.projected_area);
      for (auto const& part : answer.scheduled) keep(part.powers, part.projected_area);
    }
  }
}

std::vector<Sunlit> SunlitTable::compose(std::span<double const> fractions,
                                         glm::dvec3 const& sun) const {
  std::vector<double> sums(receivers_.size(), 0.0);
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    sums[columns_[i].receiver] += std::clamp(fractions[i], 0.0, 1.0);
  }
  std::vector<double> areas(receivers_.size());
  for (std::size_t i = 0; i < receivers_.size(); ++i) {
    auto const& [normal, area] = receivers_[i];
    areas[i] = area * std::max(glm::dot(normal, sun), 0.0) / std::max(sums[i], 1.0);
  }
  std::vector<Sunlit> answers(receivers_.size());
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    auto const& column = columns_[i];
    double const projected = areas[column.receiver] * std::clamp(fractions[i], 0.0, 1.0);
    auto& answer = answers[column.receiver];
    if (column.powers.empty()) {
      answer.projected_area = projected;
    } else if (projected > 0.0) {
      answer.scheduled.push_back({column.powers, projected});
    }
  }
  return answers;
}

}  // namespace gpu_shading
