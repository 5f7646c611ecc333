#include "sun/sampling/sunlit_splines.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <tuple>

#include "platform/parallel.h"
#include "sun/sampling/fraction_levels.h"

namespace gpu_shading {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Equal for normals that differ only in their last digits.
std::tuple<long, long, long> rounded(glm::dvec3 const& normal) {
  constexpr double steps = 1e6;
  return {std::lround(steps * normal.x), std::lround(steps * normal.y),
          std::lround(steps * normal.z)};
}

glm::dvec3 position_of(glm::dvec3 const& towards_sun, std::optional<glm::dvec3> const& normal) {
  return normal ? glm::dvec3(shadow_fall(*normal, towards_sun), 0.0) : towards_sun;
}

VectorXd limited(VectorXd const& values) { return values.cwiseMax(0.0).cwiseMin(1.0); }

// The prediction of each sample from all the others, minus the sample. Like answers, both are
// limited to 0 .. 1.
MatrixXd missed_by(RadialSpline const& splines, MatrixXd const& values) {
  Eigen::ArrayXXd const told = values.array() - splines.leave_one_out(values).array();
  return (told.max(0.0).min(1.0) - values.array().max(0.0).min(1.0)).abs();
}

// One kind of spline through the layers of receivers that face the same way.
struct Kind {
  std::optional<glm::dvec3> normal;
  RadialSpline splines;
  MatrixXd released;  // values by sample and layer
  MatrixXd missed;

  Kind(RadialKernel kernel, std::optional<glm::dvec3> over, std::vector<glm::dvec3> const& suns,
       MatrixXd const& values)
      : normal(over), splines(kernel, positions_of(suns, over)) {
    released = splines.release_limits(values);
    missed = missed_by(splines, released);
  }

  static std::vector<glm::dvec3> positions_of(std::vector<glm::dvec3> const& suns,
                                              std::optional<glm::dvec3> const& normal) {
    std::vector<glm::dvec3> positions;
    positions.reserve(suns.size());
    for (auto const& sun : suns) positions.push_back(position_of(sun, normal));
    return positions;
  }
};

MatrixXd columns_of(std::vector<VectorXd> const& vectors) {
  MatrixXd matrix(vectors.front().size(), static_cast<Index>(vectors.size()));
  for (Index j = 0; j < matrix.cols(); ++j) matrix.col(j) = vectors[static_cast<std::size_t>(j)];
  return matrix;
}

// The first where several predict as well.
std::vector<Index> best_kinds(std::vector<Kind> const& kinds) {
  std::vector<Index> best(static_cast<std::size_t>(kinds.front().missed.cols()), 0);
  for (std::size_t layer = 0; layer < best.size(); ++layer) {
    auto const missed = [&](Index kind) {
      return kinds[static_cast<std::size_t>(kind)].missed.col(static_cast<Index>(layer)).sum();
    };
    for (Index kind = 1; kind < static_cast<Index>(kinds.size()); ++kind) {
      if (missed(kind) < missed(best[layer])) best[layer] = kind;
    }
  }
  return best;
}

// By kind and layer: how well it predicts relative to the best, squared; 0 for the best itself.
MatrixXd weights_of(std::vector<Kind> const& kinds, std::vector<Index> const& best) {
  constexpr double nothing = 1e-9;
  auto const layers = static_cast<Index>(best.size());
  MatrixXd weights(static_cast<Index>(kinds.size()), layers);
  for (Index kind = 0; kind < weights.rows(); ++kind) {
    weights.row(kind) = kinds[static_cast<std::size_t>(kind)].missed.colwise().sum();
  }
  for (Index layer = 0; layer < layers; ++layer) {
    auto const chosen = best[static_cast<std::size_t>(layer)];
    double const least = weights(chosen, layer) + nothing;
    weights.col(layer) = (least / (weights.col(layer).array() + nothing)).square();
    weights(chosen, layer) = 0.0;
    weights.col(layer) /= weights.col(layer).sum();
  }
  return weights;
}

}  // namespace

glm::dvec2 shadow_fall(glm::dvec3 const& normal, glm::dvec3 const& towards_sun) {
  // A horizontal plane has any number of horizontal lines: use the one to the east.
  constexpr double level = 1e-3;
  glm::dvec3 const along = std::hypot(normal.x, normal.y) > level
                               ? glm::normalize(glm::dvec3(-normal.y, normal.x, 0.0))
                               : glm::dvec3(1.0, 0.0, 0.0);
  double const cosine = std::max(glm::dot(normal, towards_sun), min_cosine);
  return {std::asinh(glm::dot(along, towards_sun) / cosine),
          std::asinh(glm::dot(glm::cross(normal, along), towards_sun) / cosine)};
}

SunlitSplines::SunlitSplines(SunlitTable const& table, Purpose purpose)
    : purpose_(purpose),
      receivers_count_(table.receivers()),
      receivers_(table.columns().size()),
      lowest_level_(table.columns().size(), 0.0) {
  std::map<std::pair<std::tuple<long, long, long>, std::vector<bool>>, std::vector<std::size_t>>
      alike;
  for (std::size_t i = 0; i < receivers_.size(); ++i) {
    auto const receiver = table.columns()[i].receiver;
    receivers_[i] = receiver;
    auto const& lit = table.lit(receiver);
    if (std::ranges::find(lit, true) == lit.end()) continue;
    alike[{rounded(table.normal(receiver)), lit}].push_back(i);
  }
  std::vector<std::vector<std::size_t>> columns;
  columns.reserve(alike.size());
  for (auto& [look, theirs] : alike) columns.push_back(std::move(theirs));
  groups_.resize(columns.size());
  for_each_index(columns.size(),
                 [&](std::size_t i) { groups_[i] = make_group(table, columns[i]); });
  for (auto const& group : groups_) {
    for (auto const& layer : group.layers) {
      if (layer.lowest) lowest_level_[layer.column] = layer.from;
    }
  }
}

SunlitSplines::Group SunlitSplines::make_group(SunlitTable const& table,
                                               std::vector<std::size_t> const& columns) const {
  auto const receiver = table.columns()[columns.front()].receiver;
  auto const& lit = table.lit(receiver);
  Group group;
  std::vector<glm::dvec3> suns;
  for (std::size_t i = 0; i < lit.size(); ++i) {
    if (!lit[i]) continue;
    group.samples.push_back(i);
    suns.push_back(table.towards_sun()[i]);
  }
  std::vector<VectorXd> values;
  for (auto const column : columns) {
    VectorXd fractions(static_cast<Index>(suns.size()));
    for (Index i = 0; i < fractions.size(); ++i) {
      fractions(i) = table.columns()[column].fractions[group.samples[static_cast<std::size_t>(i)]];
    }
    auto const levels =
        fraction_levels({fractions.data(), static_cast<std::size_t>(fractions.size())});
    for (std::size_t i = 0; i + 1 < levels.size(); ++i) {
      double const height = levels[i + 1] - levels[i];
      group.layers.push_back({column, levels[i], height, i == 0});
      values.push_back(limited((fractions.array() - levels[i]).matrix() / height));
    }
  }
  fit(group, table.normal(receiver), suns, columns_of(values));
  return group;
}

void SunlitSplines::fit(Group& group, glm::dvec3 const& normal, std::vector<glm::dvec3> const& suns,
                        MatrixXd const& values) const {
  std::vector<Kind> kinds;
  for (auto const kernel : {RadialKernel::rough, RadialKernel::smooth}) {
    kinds.emplace_back(kernel, normal, suns, values);
    kinds.emplace_back(kernel, std::nullopt, suns, values);
  }
  auto const best = best_kinds(kinds);
  group.weights = weights_of(kinds, best);
  group.missed.resize(values.rows(), values.cols());
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    auto const& kind = kinds[k];
    if (purpose_ == Purpose::refinement) {
      group.all.push_back({kind.normal, kind.splines.fit(kind.released)});
    }
    std::vector<Index> chosen;
    for (Index layer = 0; layer < values.cols(); ++layer) {
      if (best[static_cast<std::size_t>(layer)] != static_cast<Index>(k)) continue;
      chosen.push_back(layer);
      group.missed.col(layer) = kind.missed.col(layer);
    }
    if (chosen.empty()) continue;
    MatrixXd const released = kind.released(Eigen::all, chosen);
    group.answering.push_back({{kind.normal, kind.splines.fit(released)}, std::move(chosen)});
  }
}

VectorXd SunlitSplines::answers_of(Group const& group, glm::dvec3 const& sun) {
  VectorXd answers(static_cast<Index>(group.layers.size()));
  for (auto const& [splines, layers] : group.answering) {
    answers(layers) = splines.functions.at(position_of(sun, splines.normal));
  }
  return limited(answers);
}

std::vector<double> SunlitSplines::at(SunDirection direction) const {
  auto const sun = to_vector(direction);
  std::vector<double> fractions = lowest_level_;
  for (auto const& group : groups_) {
    VectorXd const answers = answers_of(group, sun);
    for (std::size_t i = 0; i < group.layers.size(); ++i) {
      auto const& layer = group.layers[i];
      fractions[layer.column] += layer.height * answers(static_cast<Index>(i));
    }
  }
  return fractions;
}

std::vector<float> SunlitSplines::uncertainty(SunDirection direction) const {
  auto const sun = to_vector(direction);
  std::vector<float> uncertainty(receivers_count_, 0.0F);
  for (auto const& group : groups_) {
    VectorXd const answers = answers_of(group, sun);
    VectorXd differences = VectorXd::Zero(answers.size());
    for (std::size_t k = 0; k < group.all.size(); ++k) {
      auto const& [normal, functions] = group.all[k];
      VectorXd const others = limited(functions.at(position_of(sun, normal)));
      differences.array() += group.weights.row(static_cast<Index>(k)).transpose().array() *
                             (others - answers).array().abs();
    }
    for (std::size_t i = 0; i < group.layers.size(); ++i) {
      auto const& layer = group.layers[i];
      uncertainty[receivers_[layer.column]] +=
          static_cast<float>(layer.height * differences(static_cast<Index>(i)));
    }
  }
  return uncertainty;
}

Misses SunlitSplines::misses(SunlitTable const& table) const {
  Misses misses(table.receivers(), std::vector<double>(table.directions().size(), 0.0));
  for (auto const& group : groups_) {
    for (std::size_t j = 0; j < group.layers.size(); ++j) {
      auto const& layer = group.layers[j];
      auto& of_receiver = misses[receivers_[layer.column]];
      for (std::size_t i = 0; i < group.samples.size(); ++i) {
        of_receiver[group.samples[i]] +=
            layer.height * group.missed(static_cast<Index>(i), static_cast<Index>(j));
      }
    }
  }
  return misses;
}

}  // namespace gpu_shading
