#pragma once

#include <boost/math/interpolators/cardinal_cubic_b_spline.hpp>
#include <vector>

#include "sun/sampling/sun_arcs.h"
#include "sun/sampling/sunlit_table.h"

namespace gpu_shading {

// The paper's interpolation between samples of its grid: cubic B-splines along each day's azimuths,
// constant beyond its ends, then across the days. A direction alone does not distinguish spring
// from autumn: the mean of both days with its declination is used.
class AzimuthSplines : public Interpolant {
 public:
  // The directions of the table are those of the days in order.
  AzimuthSplines(SunlitTable const& table, std::vector<AzimuthDay> const& days, double latitude,
                 double step);

  std::vector<double> at(SunDirection direction) const override;

 private:
  using Spline = boost::math::interpolators::cardinal_cubic_b_spline<double>;

  struct Day {
    double first;  // azimuths from noon
    double last;
    Spline spline;
  };

  std::vector<double> weights_of(double declination) const;

  double latitude_;
  std::vector<std::vector<Day>> days_of_column_;
  std::vector<Spline> weight_of_day_;  // each sampled day's weight in the spline across the days
  std::vector<double> declinations_;   // by day of the year minus one
};

}  // namespace gpu_shading
