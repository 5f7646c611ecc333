#include "solar/radial_spline.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

namespace gpu_shading {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

double radial(glm::dvec3 const& a, glm::dvec3 const& b) {
  double const r = glm::distance(a, b);
  return -r * std::sqrt(r * std::sqrt(r));
}

bool is_limit(double value) {
  // Less than any error of rendering.
  constexpr double margin = 1e-4;
  return value < margin || value > 1.0 - margin;
}

// Moves the values at limits beyond them, one after another, each to where the others predict it.
// Each move lowers the energy.
void release(MatrixXd const& inverse, Eigen::Ref<Eigen::VectorXd> values) {
  constexpr int most_sweeps = 50;
  constexpr double small = 1e-3;
  Eigen::VectorXd const given = values;
  Eigen::VectorXd weights = inverse * values;  // of the radial functions
  double largest = 1.0;
  for (int sweep = 0; sweep < most_sweeps && largest > small; ++sweep) {
    largest = 0.0;
    for (Index i = 0; i < given.size(); ++i) {
      if (!is_limit(given(i))) continue;
      double const told = values(i) - weights(i) / inverse(i, i);
      double const next = given(i) > 0.5 ? std::max(told, given(i)) : std::min(told, given(i));
      double const step = next - values(i);
      if (step == 0.0) continue;
      weights += step * inverse.col(i);
      values(i) = next;
      largest = std::max(largest, std::abs(step));
    }
  }
}

// Including the row of the constant.
MatrixXd extended(MatrixXd const& values) {
  MatrixXd all = MatrixXd::Zero(values.rows() + 1, values.cols());
  all.topRows(values.rows()) = values;
  return all;
}

}  // namespace

RadialSpline::RadialSpline(std::vector<glm::dvec3> nodes) : nodes_(std::move(nodes)) {
  auto const n = static_cast<Index>(nodes_.size());
  MatrixXd matrix = MatrixXd::Ones(n + 1, n + 1);
  matrix(n, n) = 0.0;
  for (Index i = 0; i < n; ++i) {
    for (Index j = 0; j <= i; ++j) {
      matrix(i, j) = matrix(j, i) =
          radial(nodes_[static_cast<std::size_t>(i)], nodes_[static_cast<std::size_t>(j)]);
    }
  }
  system_.compute(matrix);
  inverse_ = system_.inverse().topLeftCorner(n, n);
}

MatrixXd RadialSpline::fit(MatrixXd const& values) const { return system_.solve(extended(values)); }

MatrixXd RadialSpline::release_limits(MatrixXd const& values) const {
  auto const n = values.rows();
  MatrixXd released = values;
  if (n < 2) return released;
  for (Index j = 0; j < values.cols(); ++j) release(inverse_, released.col(j));
  return released;
}

MatrixXd RadialSpline::leave_one_out(MatrixXd const& values) const {
  auto const n = values.rows();
  // A single node cannot be predicted from others.
  if (n < 2) return MatrixXd::Zero(n, values.cols());
  MatrixXd errors = inverse_ * values;
  for (Index i = 0; i < n; ++i) errors.row(i) /= inverse_(i, i);
  return errors;
}

Eigen::VectorXd RadialSpline::at(glm::dvec3 const& place, MatrixXd const& fitted) const {
  auto const n = static_cast<Index>(nodes_.size());
  Eigen::VectorXd row(n + 1);
  for (Index i = 0; i < n; ++i) row(i) = radial(place, nodes_[static_cast<std::size_t>(i)]);
  row(n) = 1.0;
  return fitted.transpose() * row;
}

}  // namespace gpu_shading
