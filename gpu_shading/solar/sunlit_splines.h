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

// Splines through a table, over the position of shadows on a receiver's plane or over the sun
// direction: for each column, whichever predicts its samples better from one another, or the
// position of shadows if neither does. One fit serves all receivers that face the same way.
class SunlitSplines : public Interpolant {
 public:
  explicit SunlitSplines(SunlitTable const& table);

  std::vector<double> at(SunDirection direction) const override;

  Misses misses(SunlitTable const& table) const;

 private:
  struct Group {
    std::optional<glm::dvec3> normal;  // over the position of shadows on it; empty: over directions
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
