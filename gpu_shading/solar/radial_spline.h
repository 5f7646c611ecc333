#pragma once

#include <Eigen/Dense>
#include <glm/vec3.hpp>
#include <vector>

namespace gpu_shading {

// Interpolation of scattered values in space by radial functions -r^1.75 and a constant: the
// function of least energy through the values, in a norm between those of a membrane and of
// thin-plate splines (Duchon 1977; Wendland, Scattered Data Approximation, 2005, theorem 8.16). It
// overshoots less at kinks than thin-plate splines and stays closer to the values beyond the nodes.
// It is linear in the values, so one fit serves many functions.
class RadialSpline {
 public:
  // At least one node, without duplicates.
  explicit RadialSpline(std::vector<glm::dvec3> nodes);

  // Values: one row per node, one column per function. The result is for at().
  Eigen::MatrixXd fit(Eigen::MatrixXd const& values) const;

  // The same functions where a fraction of 1 means 1 or more, and 0 means 0 or less: values beyond
  // 0 .. 1 with which the spline has less energy, up to the least. While no shadow reaches a
  // receiver, its fraction is 1 however far away the shadow is; the spline through ones bends
  // before the shadow arrives, but the spline with greater values, limited to 1, does not.
  Eigen::MatrixXd release_limits(Eigen::MatrixXd const& values) const;

  // Each function minus its spline through all other nodes, at each node (Rippa 1999, eq. 5); same
  // arguments.
  Eigen::MatrixXd leave_one_out(Eigen::MatrixXd const& values) const;

  // The value of each function of a fit.
  Eigen::VectorXd at(glm::dvec3 const& place, Eigen::MatrixXd const& fitted) const;

 private:
  std::vector<glm::dvec3> nodes_;
  Eigen::PartialPivLU<Eigen::MatrixXd> system_;
  Eigen::MatrixXd inverse_;  // without the constant: weights of the radial functions by value
};

}  // namespace gpu_shading
