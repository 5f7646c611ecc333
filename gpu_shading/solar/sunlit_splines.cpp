#include "solar/sunlit_splines.h"

#include <cmath>
#include <map>

namespace gpu_shading {

using Eigen::Index;

SunlitSplines::SunlitSplines(SunlitTable const& table) : columns_(table.columns().size()) {
  std::map<std::vector<bool>, std::vector<std::size_t>> by_lit;
  for (std::size_t i = 0; i < columns_; ++i) {
    by_lit[table.lit(table.columns()[i].receiver)].push_back(i);
  }
  for (auto& [lit, columns] : by_lit) {
    std::vector<std::size_t> samples;
    std::vector<glm::dvec3> nodes;
    for (std::size_t i = 0; i < lit.size(); ++i) {
      if (!lit[i]) continue;
      samples.push_back(i);
      nodes.push_back(table.towards_sun()[i]);
    }
    if (samples.empty()) continue;
    Eigen::MatrixXd values(static_cast<Index>(samples.size()), static_cast<Index>(columns.size()));
    for (Index j = 0; j < values.cols(); ++j) {
      auto const& fractions = table.columns()[columns[static_cast<std::size_t>(j)]].fractions;
      for (Index i = 0; i < values.rows(); ++i) {
        values(i, j) = fractions[samples[static_cast<std::size_t>(i)]];
      }
    }
    ThinPlate splines(std::move(nodes));
    auto fitted = splines.fit(values);
    groups_.push_back(
        {std::move(samples), columns, std::move(splines), std::move(values), std::move(fitted)});
  }
}

std::vector<double> SunlitSplines::at(SunDirection direction) const {
  auto const sun = to_vector(direction);
  std::vector<double> fractions(columns_, 0.0);
  for (auto const& group : groups_) {
    Eigen::VectorXd const values = group.splines.at(sun, group.fitted);
    for (std::size_t i = 0; i < group.columns.size(); ++i) {
      fractions[group.columns[i]] = values(static_cast<Index>(i));
    }
  }
  return fractions;
}

Misses SunlitSplines::misses(SunlitTable const& table) const {
  Misses misses(table.receivers(), std::vector<double>(table.directions().size(), 0.0));
  for (auto const& group : groups_) {
    Eigen::MatrixXd const errors = group.splines.leave_one_out(group.values);
    for (std::size_t j = 0; j < group.columns.size(); ++j) {
      auto& of_receiver = misses[table.columns()[group.columns[j]].receiver];
      for (std::size_t i = 0; i < group.samples.size(); ++i) {
        of_receiver[group.samples[i]] +=
            std::abs(errors(static_cast<Index>(i), static_cast<Index>(j)));
      }
    }
  }
  return misses;
}

}  // namespace gpu_shading
