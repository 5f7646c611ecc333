#include "sun/sampling/radial_spline.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "platform/parallel.h"

namespace gpu_shading {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

double radial(RadialKernel kernel, glm::dvec3 const& a, glm::dvec3 const& b) {
  double const r = glm::distance(a, b);
  return kernel == RadialKernel::smooth ? r * r * r : -r * std::sqrt(r * std::sqrt(r));
}

// Values of the constant and the coordinates at each node; without z if it is 0 everywhere.
MatrixXd linear_terms(std::vector<glm::dvec3> const& nodes) {
  bool const in_plane =
      std::ranges::all_of(nodes, [](glm::dvec3 const& node) { return node.z == 0.0; });
  MatrixXd terms(static_cast<Index>(nodes.size()), in_plane ? 3 : 4);
  for (Index i = 0; i < terms.rows(); ++i) {
    auto const& node = nodes[static_cast<std::size_t>(i)];
    terms(i, 0) = 1.0;
    for (int axis = 0; axis < terms.cols() - 1; ++axis) terms(i, axis + 1) = node[axis];
  }
  return terms;
}

// Whether a linear function is determined, and not only just, by its values at the nodes.
bool determine_linear(MatrixXd const& terms) {
  constexpr double min_pivot = 1e-3;
  Eigen::ColPivHouseholderQR<MatrixXd> decomposed(terms);
  decomposed.setThreshold(min_pivot);
  return decomposed.rank() == terms.cols();
}

bool is_limit(double value) {
  // Less than any error of rendering.
  constexpr double margin = 1e-4;
  return value < margin || value > 1.0 - margin;
}

// Moves the values at limits beyond them, one after another, each to where the others predict it.
// Each move lowers the energy.
void release(MatrixXd const& inverse, Eigen::Ref<Eigen::VectorXd> values) {
  constexpr int max_sweeps = 50;
  constexpr double small = 1e-3;
  Eigen::VectorXd const given = values;
  Eigen::VectorXd weights = inverse * values;  // of the radial functions
  double largest = 1.0;
  for (int sweep = 0; sweep < max_sweeps && largest > small; ++sweep) {
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

}  // namespace

RadialFunctions::RadialFunctions(RadialKernel kernel, std::vector<glm::dvec3> nodes,
                                 MatrixXd coefficients)
    : kernel_(kernel), nodes_(std::move(nodes)), coefficients_(std::move(coefficients)) {}

Eigen::VectorXd RadialFunctions::at(glm::dvec3 const& position) const {
  auto const n = static_cast<Index>(nodes_.size());
  Eigen::VectorXd row(coefficients_.rows());
  for (Index i = 0; i < n; ++i)
    row(i) = radial(kernel_, position, nodes_[static_cast<std::size_t>(i)]);
  row(n) = 1.0;
  for (int axis = 0; n + axis + 1 < row.size(); ++axis) row(n + axis + 1) = position[axis];
  return coefficients_.transpose() * row;
}

RadialSpline::RadialSpline(RadialKernel kernel, std::vector<glm::dvec3> nodes)
    : kernel_(kernel), nodes_(std::move(nodes)) {
  MatrixXd terms = linear_terms(nodes_);
  if (!determine_linear(terms)) kernel_ = RadialKernel::rough;
  if (kernel_ == RadialKernel::rough) terms = MatrixXd::Ones(terms.rows(), 1);
  auto const n = terms.rows();
  terms_ = terms.cols();
  MatrixXd matrix = MatrixXd::Zero(n + terms_, n + terms_);
  for (Index i = 0; i < n; ++i) {
    for (Index j = 0; j < i; ++j) {
      matrix(i, j) = matrix(j, i) =
          radial(kernel_, nodes_[static_cast<std::size_t>(i)], nodes_[static_cast<std::size_t>(j)]);
    }
  }
  matrix.topRightCorner(n, terms_) = terms;
  matrix.bottomLeftCorner(terms_, n) = terms.transpose();
  system_.compute(matrix);
  inverse_ = system_.inverse().topLeftCorner(n, n);
}

RadialFunctions RadialSpline::fit(MatrixXd const& values) const {
  MatrixXd extended = MatrixXd::Zero(values.rows() + terms_, values.cols());
  extended.topRows(values.rows()) = values;
  return {kernel_, nodes_, system_.solve(extended)};
}

MatrixXd RadialSpline::release_limits(MatrixXd const& values) const {
  auto const n = values.rows();
  MatrixXd released = values;
  if (n < 2) return released;
  for_each_index(static_cast<std::size_t>(values.cols()),
                 [&](std::size_t j) { release(inverse_, released.col(static_cast<Index>(j))); });
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

}  // namespace gpu_shading
