#pragma once

#include <Eigen/Dense>
#include <glm/vec3.hpp>
#include <vector>

namespace gpu_shading {

// The function of least energy through scattered values in space (Duchon 1977; Wendland, Scattered
// Data Approximation, 2005, theorem 8.16).
enum class RadialKernel {
  // -r^1.75 and a constant: a norm between those of a membrane and of thin-plate splines. It
  // overshoots less at kinks than smoother ones, and stays closer to the values beyond the nodes.
  rough,
  // r^3 and a linear function: a smoother norm, for functions without kinks. It is `rough` where
  // the
  // nodes do not determine a linear function.
  smooth,
};

// Functions fitted by RadialSpline.
class RadialFunctions {
 public:
  RadialFunctions(RadialKernel kernel, std::vector<glm::dvec3> nodes, Eigen::MatrixXd coefficients);

  // The value of each function.
  Eigen::VectorXd at(glm::dvec3 const& position) const;

 private:
  RadialKernel kernel_;
  std::vector<glm::dvec3> nodes_;
  Eigen::MatrixXd coefficients_;  // by node, then by term of the constant or linear function
};

// Interpolation of scattered values by radial functions. It is linear in the values, so one system
// serves many functions.
class RadialSpline {
 public:
  // At least one node, without duplicates. If all have z = 0, they are in a plane.
  RadialSpline(RadialKernel kernel, std::vector<glm::dvec3> nodes);

  // Values: one row per node, one column per function.
  RadialFunctions fit(Eigen::MatrixXd const& values) const;

  // The same functions where a fraction of 1 means 1 or more, and 0 means 0 or less: values beyond
  // 0 .. 1 with which the spline has less energy, up to the least. While no shadow reaches a
  // receiver, its fraction is 1 however far away the shadow is; the spline through ones bends
  // before the shadow arrives, but the spline with greater values, limited to 1, does not.
  Eigen::MatrixXd release_limits(Eigen::MatrixXd const& values) const;

  // Each function minus its spline through all other nodes, at each node (Rippa 1999, eq. 5); same
  // arguments.
  Eigen::MatrixXd leave_one_out(Eigen::MatrixXd const& values) const;

 private:
  RadialKernel kernel_;
  std::vector<glm::dvec3> nodes_;
  Eigen::Index terms_;  // of the constant or linear function
  Eigen::PartialPivLU<Eigen::MatrixXd> system_;
  Eigen::MatrixXd inverse_;  // without these terms: weights of the radial functions by value
};

}  // namespace gpu_shading
