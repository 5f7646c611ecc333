#pragma once

#include <Eigen/Dense>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "solar/disagreement.h"
#include "solar/interpolant.h"
#include "solar/radial_spline.h"
#include "solar/sunlit_table.h"

namespace gpu_shading {

// Splines through a table, over where shadows fall on a receiver's plane or over the sun's
// direction: for each column over that which tells its samples better from one another, shadows
// where neither does. One fit for all receivers that look the same way.
class SunlitSplines : public Interpolant {
 public:
  explicit SunlitSplines(SunlitTable const& table);

  std::vector<double> at(SunDirection direction) const override;

  Misses misses(SunlitTable const& table) const;

 private:
  struct Group {
    std::optional<glm::dvec3> normal;  // over where shadows fall on it; none: over directions
    std::vector<std::size_t> samples;
    std::vector<std::size_t> columns;
    Eigen::MatrixXd fitted;
    Eigen::MatrixXd missed;  // by sample and column
    RadialSpline splines;
  };

  void add_better(SunlitTable const& table, std::vector<std::size_t> const& columns);

  std::size_t columns_;
  std::vector<Group> groups_;
};

}  // namespace gpu_shading
