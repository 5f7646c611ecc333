#pragma once

#include <cstddef>
#include <functional>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "gpu_shading/sun_direction.h"
#include "gpu_shading/sunlit.h"

namespace gpu_shading {

// The choice of sampled sun directions over a year.
struct Sampling {
  enum class Density { fine, medium, coarse };

  Density density = Density::medium;
  // Every 14th day at steps of 10, 15 or 20 degrees of azimuth, like Jones & Greenberg's
  // preprocessor; for comparison.
  bool paper_grid = false;

  bool operator==(Sampling const&) const = default;
};

// Number of directions without `paper_grid` if no receiver needs more: 480, 320 and 238, no more
// than the paper's grid of the same density has at 42 degrees north.
std::size_t usual_directions(Sampling::Density density);

// Maximum number of directions: twice as many.
std::size_t max_directions(Sampling::Density density);

// Mean error of a receiver's sunlit fraction above which directions are added: 2.7e-3, 4e-3 and
// 5.4e-3.
double error_goal(Sampling::Density density);

// The sunlit areas of each receiver, in order, for each direction, in order.
using SunlitSource =
    std::function<std::vector<std::vector<Sunlit>>(std::span<SunDirection const> directions)>;

// Sampled fractions of a receiver, either of the beam that passes unscheduled shades alone, or of
// the beam that passes one combination of scheduled shades.
struct SampledFractions {
  std::size_t receiver;
  std::vector<std::pair<int, int>> powers;  // as in ScheduledPart; empty: unscheduled
  // By direction; 0 .. 1, and 0 if the receiver faces away from the sun.
  std::vector<double> fractions;
};

// The sampled directions, round by round: the answers of one round determine the directions of the
// next. The paper's grids have one round. Equal answers give equal directions.
class SampleRounds {
 public:
  // Latitude in radians, north positive. `receivers`: unit normal times net area (m2).
  SampleRounds(Sampling sampling, double latitude, std::vector<glm::dvec3> receivers);
  ~SampleRounds();
  SampleRounds(SampleRounds const&) = delete;
  SampleRounds& operator=(SampleRounds const&) = delete;
  SampleRounds(SampleRounds&&) noexcept;
  SampleRounds& operator=(SampleRounds&&) noexcept;

  // The directions of the current round; empty after the last.
  std::vector<SunDirection> const& directions() const;

  // Takes the answers at these directions, by direction and receiver, and starts the next round.
  void add(std::vector<std::vector<Sunlit>> const& answers);

 private:
  friend class SampledSunlit;
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

// Sunlit areas at any sun position over the years, interpolated between samples. Between the
// solstices they depend on the direction alone, so one sample serves spring and autumn, any
// schedule and any weather.
//
// The interpolated quantity is the sunlit fraction, without the cosine of incidence, of each
// receiver and of each combination of scheduled shades. Where samples share a value, such as that
// behind a shade of constant transmittance, it is cut there into layers, each with kinks at its
// limits. Radial splines (Duchon 1977) are fitted through the directions at which the sun faces the
// receiver, so that there are no seams at sunrise, at midnight in polar day, or where the sun turns
// away: rough or smooth ones, functions of where shadows fall on the receiver's plane or of the
// direction, whichever predicts the samples best from one another (leave-one-out). Six tenths of
// the usual directions lie on arcs of equal declination, offset from one another; the others are
// added in four rounds where these splines differ and where the other samples predict a sample
// worst, above all for the receivers whose error is estimated to be largest. While the estimate of
// any receiver is above error_goal(), up to five more rounds add directions where those receivers
// need them. Fractions are limited to 0 .. 1, and so are their sums.
//
// The paper's grid instead uses cubic B-splines along the azimuth and then across the days.
class SampledSunlit {
 public:
  // Parameters as for SampleRounds. Calls `source` a few times, for many directions at once, and
  // passes on its exceptions.
  SampledSunlit(Sampling sampling, double latitude, std::vector<glm::dvec3> receivers,
                SunlitSource const& source);
  // Constructs it from the answers of all rounds.
  explicit SampledSunlit(SampleRounds rounds);
  ~SampledSunlit();
  SampledSunlit(SampledSunlit const&) = delete;
  SampledSunlit& operator=(SampledSunlit const&) = delete;
  SampledSunlit(SampledSunlit&&) noexcept;
  SampledSunlit& operator=(SampledSunlit&&) noexcept;

  // The same for other receivers, from samples at the same directions.
  SampledSunlit with(std::vector<glm::dvec3> receivers, SunlitSource const& source) const;

  // The areas of every receiver, in order. The direction must be within in_suns_range().
  std::vector<Sunlit> at(SunDirection direction) const;

  // False if the receiver faces away from the sun in every sample; its answers are then 0.
  bool knows(std::size_t receiver) const;

  std::vector<SunDirection> const& directions() const;

  // The samples themselves: first the unscheduled ones of each receiver, in order.
  std::vector<SampledFractions> const& fractions() const;

  // Estimated error of each receiver's fraction, mean over the times of a year when the sun faces
  // it. Empty for the paper's grid and after with().
  std::vector<double> const& expected_errors() const;

  // Whether the sun faces a receiver, for each of directions().
  std::vector<bool> const& lit(std::size_t receiver) const;

 private:
  class Implementation;
  explicit SampledSunlit(std::unique_ptr<Implementation> implementation);

  std::unique_ptr<Implementation> implementation_;
};

// Whether the sun can be in this direction: not below the horizon, and not beyond a solstice's arc
// by more than a tenth of a degree. Latitude in radians.
bool in_suns_range(SunDirection direction, double latitude);

}  // namespace gpu_shading
