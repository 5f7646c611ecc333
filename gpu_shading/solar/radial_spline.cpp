#include "solar/radial_spline.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

namespace gpu_shading {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

double radial(glm::dvec3 const& a, glm::dvec3 const& b) {
  double const r = glm::distance(a, b);
  return -r * std::sqrt(r);
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
}

MatrixXd RadialSpline::fit(MatrixXd const& values) const { return system_.solve(extended(values)); }

MatrixXd RadialSpline::leave_one_out(MatrixXd const& values) const {
  auto const n = values.rows();
  // A single node cannot be predicted from others.
  if (n < 2) return MatrixXd::Zero(n, values.cols());
  MatrixXd const inverse = system_.inverse();
  MatrixXd errors = (inverse * extended(values)).topRows(n);
  for (Index i = 0; i < n; ++i) errors.row(i) /= inverse(i, i);
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
