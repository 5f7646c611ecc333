#pragma once

#include <Eigen/Dense>
#include <glm/vec3.hpp>
#include <vector>

namespace gpu_shading {

// Interpolation of scattered values over directions by thin-plate splines: radial functions r^2 log
// r of the chord's length, and a linear polynomial (Duchon 1977; Wahba, Spline Models for
// Observational Data, 1990). Where the nodes do not tell a linear polynomial, few or on one arc as
// they are, -r and a constant. Linear in the values, so that one fit serves many functions.
class ThinPlate {
 public:
  // Nodes, at least one, are unit vectors; no two the same.
  explicit ThinPlate(std::vector<glm::dvec3> nodes);

  // Values: a row for each node, a column for each function. For at().
  Eigen::MatrixXd fit(Eigen::MatrixXd const& values) const;

  // What each function's spline through all the other nodes misses at each node by (Rippa 1999, eq.
  // 5); for the same arguments.
  Eigen::MatrixXd leave_one_out(Eigen::MatrixXd const& values) const;

  // Of each function of a fit.
  Eigen::VectorXd at(glm::dvec3 const& direction, Eigen::MatrixXd const& fitted) const;

 private:
  double radial(double chord_squared) const;
  Eigen::Index terms() const { return linear_ ? 4 : 1; }
  Eigen::MatrixXd extended(Eigen::MatrixXd const& values) const;

  std::vector<glm::dvec3> nodes_;
  bool linear_;
  Eigen::PartialPivLU<Eigen::MatrixXd> system_;
};

}  // namespace gpu_shading
