#include "solar/thin_plate.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace gpu_shading {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

// Rows of a polynomial's terms, 1 x y z.
MatrixXd terms_of(std::vector<glm::dvec3> const& nodes, Index terms) {
  MatrixXd rows(static_cast<Index>(nodes.size()), terms);
  for (Index i = 0; i < rows.rows(); ++i) {
    auto const& node = nodes[static_cast<std::size_t>(i)];
    std::array<double, 4> const all{1.0, node.x, node.y, node.z};
    for (Index k = 0; k < terms; ++k) rows(i, k) = all[static_cast<std::size_t>(k)];
  }
  return rows;
}

bool tell_linear(std::vector<glm::dvec3> const& nodes) {
  constexpr std::size_t fewest = 8;
  constexpr double least = 0.01;  // of the singular values, one to another
  if (nodes.size() < fewest) return false;
  Eigen::VectorXd const values = Eigen::JacobiSVD<MatrixXd>(terms_of(nodes, 4)).singularValues();
  return values(3) > least * values(0);
}

double chord_squared(glm::dvec3 const& a, glm::dvec3 const& b) { return glm::dot(a - b, a - b); }

}  // namespace

ThinPlate::ThinPlate(std::vector<glm::dvec3> nodes)
    : nodes_(std::move(nodes)), linear_(tell_linear(nodes_)) {
  auto const n = static_cast<Index>(nodes_.size());
  MatrixXd matrix = MatrixXd::Zero(n + terms(), n + terms());
  for (Index i = 0; i < n; ++i) {
    for (Index j = 0; j < i; ++j) {
      matrix(i, j) = matrix(j, i) = radial(
          chord_squared(nodes_[static_cast<std::size_t>(i)], nodes_[static_cast<std::size_t>(j)]));
    }
  }
  auto const polynomial = terms_of(nodes_, terms());
  matrix.topRightCorner(n, terms()) = polynomial;
  matrix.bottomLeftCorner(terms(), n) = polynomial.transpose();
  system_.compute(matrix);
}

double ThinPlate::radial(double chord_squared) const {
  if (!linear_) return -std::sqrt(chord_squared);
  return chord_squared > 0.0 ? 0.5 * chord_squared * std::log(chord_squared) : 0.0;
}

MatrixXd ThinPlate::extended(MatrixXd const& values) const {
  MatrixXd all = MatrixXd::Zero(values.rows() + terms(), values.cols());
  all.topRows(values.rows()) = values;
  return all;
}

MatrixXd ThinPlate::fit(MatrixXd const& values) const { return system_.solve(extended(values)); }

MatrixXd ThinPlate::leave_one_out(MatrixXd const& values) const {
  auto const n = values.rows();
  // One node has nothing to be told by.
  if (n < 2) return MatrixXd::Zero(n, values.cols());
  MatrixXd const inverse = system_.inverse();
  MatrixXd errors = (inverse * extended(values)).topRows(n);
  for (Index i = 0; i < n; ++i) errors.row(i) /= inverse(i, i);
  return errors;
}

Eigen::VectorXd ThinPlate::at(glm::dvec3 const& direction, MatrixXd const& fitted) const {
  auto const n = static_cast<Index>(nodes_.size());
  Eigen::VectorXd row(n + terms());
  for (Index i = 0; i < n; ++i) {
    row(i) = radial(chord_squared(direction, nodes_[static_cast<std::size_t>(i)]));
  }
  row.tail(terms()) = terms_of({direction}, terms()).transpose();
  return fitted.transpose() * row;
}

}  // namespace gpu_shading
