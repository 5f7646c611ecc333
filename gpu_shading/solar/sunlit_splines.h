#pragma once

#include <Eigen/Dense>
#include <vector>

#include "solar/disagreement.h"
#include "solar/interpolant.h"
#include "solar/sunlit_table.h"
#include "solar/thin_plate.h"

namespace gpu_shading {

// Thin-plate splines through a table, one fit for all receivers that the sun faces at the same
// samples.
class SunlitSplines : public Interpolant {
 public:
  explicit SunlitSplines(SunlitTable const& table);

  std::vector<double> at(SunDirection direction) const override;

  Misses misses(SunlitTable const& table) const;

 private:
  struct Group {
    std::vector<std::size_t> samples;
    std::vector<std::size_t> columns;
    ThinPlate splines;
    Eigen::MatrixXd values;
    Eigen::MatrixXd fitted;
  };

  std::size_t columns_;
  std::vector<Group> groups_;
};

}  // namespace gpu_shading
