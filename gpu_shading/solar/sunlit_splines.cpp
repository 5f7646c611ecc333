#include "solar/sunlit_splines.h"

#include <array>
#include <cmath>
#include <map>
#include <tuple>

#include "solar/shadow_fall.h"

namespace gpu_shading {
namespace {

using Eigen::Index;

// Equal for normals that differ only in their last digits.
std::tuple<long, long, long> rounded(glm::dvec3 const& normal) {
  constexpr double steps = 1e6;
  return {std::lround(steps * normal.x), std::lround(steps * normal.y),
          std::lround(steps * normal.z)};
}

glm::dvec3 place_of(glm::dvec3 const& towards_sun, std::optional<glm::dvec3> const& normal) {
  return normal ? glm::dvec3(shadow_fall(*normal, towards_sun), 0.0) : towards_sun;
}

// The prediction of each sample from all the others, minus the sample. Like answers, both are
// limited to 0 .. 1.
Eigen::MatrixXd missed_by(RadialSpline const& splines, Eigen::MatrixXd const& values) {
  Eigen::ArrayXXd const told = values.array() - splines.leave_one_out(values).array();
  return (told.max(0.0).min(1.0) - values.array().max(0.0).min(1.0)).abs();
}

Eigen::MatrixXd columns_of(Eigen::MatrixXd const& matrix, std::vector<Index> const& chosen) {
  return matrix(Eigen::all, chosen);
}

}  // namespace

SunlitSplines::SunlitSplines(SunlitTable const& table) : columns_(table.columns().size()) {
  std::map<std::pair<std::tuple<long, long, long>, std::vector<bool>>, std::vector<std::size_t>>
      alike;
  for (std::size_t i = 0; i < columns_; ++i) {
    auto const receiver = table.columns()[i].receiver;
    alike[{rounded(table.normal(receiver)), table.lit(receiver)}].push_back(i);
  }
  for (auto const& [look, columns] : alike) add_better(table, columns);
}

void SunlitSplines::add_better(SunlitTable const& table, std::vector<std::size_t> const& columns) {
  auto const receiver = table.columns()[columns.front()].receiver;
  auto const& lit = table.lit(receiver);
  std::vector<std::size_t> samples;
  for (std::size_t i = 0; i < lit.size(); ++i) {
    if (lit[i]) samples.push_back(i);
  }
  if (samples.empty()) return;
  Eigen::MatrixXd values(static_cast<Index>(samples.size()), static_cast<Index>(columns.size()));
  for (Index j = 0; j < values.cols(); ++j) {
    auto const& fractions = table.columns()[columns[static_cast<std::size_t>(j)]].fractions;
    for (Index i = 0; i < values.rows(); ++i) {
      values(i, j) = fractions[samples[static_cast<std::size_t>(i)]];
    }
  }
  auto const splines_over = [&](std::optional<glm::dvec3> const& normal) {
    std::vector<glm::dvec3> nodes;
    nodes.reserve(samples.size());
    for (auto const sample : samples) {
      nodes.push_back(place_of(table.towards_sun()[sample], normal));
    }
    return RadialSpline(std::move(nodes));
  };
  std::array<std::optional<glm::dvec3>, 2> const normals{table.normal(receiver), std::nullopt};
  std::array<RadialSpline, 2> splines{splines_over(normals[0]), splines_over(normals[1])};
  std::array<Eigen::MatrixXd, 2> const released{splines[0].release_limits(values),
                                                splines[1].release_limits(values)};
  std::array<Eigen::MatrixXd, 2> const missed{missed_by(splines[0], released[0]),
                                              missed_by(splines[1], released[1])};
  std::array<std::vector<Index>, 2> chosen;
  for (Index j = 0; j < values.cols(); ++j) {
    bool const by_shadows = missed[0].col(j).sum() <= missed[1].col(j).sum();
    chosen[by_shadows ? 0 : 1].push_back(j);
  }
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    if (chosen[k].empty()) continue;
    std::vector<std::size_t> theirs;
    theirs.reserve(chosen[k].size());
    for (auto const j : chosen[k]) theirs.push_back(columns[static_cast<std::size_t>(j)]);
    auto fitted = splines[k].fit(columns_of(released[k], chosen[k]));
    groups_.push_back({normals[k], samples, std::move(theirs), std::move(fitted),
                       columns_of(missed[k], chosen[k]), std::move(splines[k])});
  }
}

std::vector<double> SunlitSplines::at(SunDirection direction) const {
  auto const sun = to_vector(direction);
  std::vector<double> fractions(columns_, 0.0);
  for (auto const& group : groups_) {
    Eigen::VectorXd const values = group.splines.at(place_of(sun, group.normal), group.fitted);
    for (std::size_t i = 0; i < group.columns.size(); ++i) {
      fractions[group.columns[i]] = values(static_cast<Index>(i));
    }
  }
  return fractions;
}

Misses SunlitSplines::misses(SunlitTable const& table) const {
  Misses misses(table.receivers(), std::vector<double>(table.directions().size(), 0.0));
  for (auto const& group : groups_) {
    for (std::size_t j = 0; j < group.columns.size(); ++j) {
      auto& of_receiver = misses[table.columns()[group.columns[j]].receiver];
      for (std::size_t i = 0; i < group.samples.size(); ++i) {
        of_receiver[group.samples[i]] += group.missed(static_cast<Index>(i), static_cast<Index>(j));
      }
    }
  }
  return misses;
}

}  // namespace gpu_shading
