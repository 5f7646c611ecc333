#pragma once

#include <Eigen/Dense>
#include <glm/vec3.hpp>
#include <vector>

namespace gpu_shading {

// Interpolation of scattered values in space by radial functions -r^1.5 and a constant: of all
// functions through the values the one of least energy, in a norm between that of a membrane and
// that of thin-plate splines (Duchon 1977; Wendland, Scattered Data Approximation, 2005, theorem
// 8.16). Overshoots less at kinks than thin-plate splines do, and keeps nearer to the values beyond
// the nodes. Linear in the values, so that one fit serves many functions.
class RadialSpline {
 public:
  // At least one; no two the same.
  explicit RadialSpline(std::vector<glm::dvec3> nodes);

  // Values: a row for each node, a column for each function. For at().
  Eigen::MatrixXd fit(Eigen::MatrixXd const& values) const;

  // Each function less its spline through all the other nodes, at each node (Rippa 1999, eq. 5);
  // for the same arguments.
  Eigen::MatrixXd leave_one_out(Eigen::MatrixXd const& values) const;

  // Of each function of a fit.
  Eigen::VectorXd at(glm::dvec3 const& place, Eigen::MatrixXd const& fitted) const;

 private:
  std::vector<glm::dvec3> nodes_;
  Eigen::PartialPivLU<Eigen::MatrixXd> system_;
};

}  // namespace gpu_shading
