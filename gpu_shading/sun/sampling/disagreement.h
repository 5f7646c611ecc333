#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

#include "sun/sampling/sun_arcs.h"
#include "sun/sampling/sunlit_splines.h"
#include "sun/sampling/sunlit_table.h"

namespace gpu_shading {

// Where splines through the samples of a table are expected to be wrong, at 2,500 directions over
// the year and at some that graze the receivers: where samples do not predict one another, and
// where different splines differ.
class Disagreement {
 public:
  Disagreement(SunlitTable const& table, SunlitSplines const& splines, double latitude);

  // Estimated error of each receiver's fraction, mean over the times of a year when the sun faces
  // it: half the misses, because a sample is predicted from farther away than what lies between
  // samples, and the uncertainty of splines. The errors of tests/bench/sampling_error are at most
  // twice this.
  std::vector<double> const& expected_errors() const { return expected_errors_; }

  // Returns `count` further directions, one after another where the product of these is largest:
  // the uncertainty of splines there and a share of the misses of nearby samples, summed over the
  // receivers that the sun faces there; the square of the distance to the nearest direction; and
  // how long the sun is at that declination. A receiver weighs more the larger its expected error
  // is, and the more rarely the sun faces it. Receivers whose expected error is below `wanted` are
  // left out.
  std::vector<HourDirection> further_directions(std::size_t count, double wanted) const;

 private:
  static constexpr std::size_t nearby = 4;

  struct Candidate {
    HourDirection direction;
    glm::dvec3 towards_sun{};
    std::array<std::size_t, nearby> samples{};  // nearest first
    double distance_squared = 0.0;              // to the nearest existing direction
    double duration = 0.0;  // of the sun near it, relative to one of the 2,500 at an equinox
  };

  void add_grazing(double latitude, std::size_t evenly_spread);
  std::vector<glm::dvec3> distinct_normals() const;  // a dozen at most
  // The solid angle is that of the directions it stands for, relative to one of the 2,500.
  Candidate candidate_at(HourDirection direction, double latitude, double solid_angle) const;
  double misses_near(Candidate const& candidate, std::size_t receiver) const;
  void estimate(std::size_t receiver);

  SunlitTable const& table_;
  Misses misses_;
  std::vector<Candidate> candidates_;
  std::vector<std::vector<float>> uncertainty_;  // by candidate and receiver
  std::vector<double> expected_errors_;          // by receiver
  std::vector<double> facing_;  // by receiver: share of the year's sun that it faces
};

}  // namespace gpu_shading
