#pragma once

#include <cstddef>
#include <functional>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "gpu_shading/renderer.h"
#include "gpu_shading/sun_direction.h"

namespace gpu_shading {

// Which of the sun's directions over a year are sampled.
struct Sampling {
  enum class Density { fine, medium, coarse };

  Density density = Density::medium;
  // Every 14th day, at every 10, 15 or 20 degrees of azimuth, after Jones & Greenberg's
  // preprocessor; for comparison.
  bool paper_grid = false;

  bool operator==(Sampling const&) const = default;
};

// Directions that our own samples have at most: 480, 320 and 238, no more than the paper's grid of
// the same density has at 42 degrees north.
std::size_t most_directions(Sampling::Density density);

// What the sun sees of each receiver, in order, for each of the directions, in order.
using SunlitSource =
    std::function<std::vector<std::vector<Sunlit>>(std::span<SunDirection const> directions)>;

// Sampled fractions of a receiver: of the beam that passes unscheduled shades alone, or of what
// passes one combination of scheduled ones.
struct SampledFractions {
  std::size_t receiver;
  std::vector<std::pair<int, int>> powers;  // as in ScheduledPart; none: unscheduled
  std::vector<double> fractions;  // by direction; 0 .. 1, and 0 where the receiver is turned away
};

// The directions that are sampled, round by round: what is seen at those of one round tells those
// of the next. A grid of the paper's has one round. The same answers give the same directions.
class SampleRounds {
 public:
  // Latitude in radians, north positive. `receivers`: unit normal times net area (m2).
  SampleRounds(Sampling sampling, double latitude, std::vector<glm::dvec3> receivers);
  ~SampleRounds();
  SampleRounds(SampleRounds const&) = delete;
  SampleRounds& operator=(SampleRounds const&) = delete;
  SampleRounds(SampleRounds&&) noexcept;
  SampleRounds& operator=(SampleRounds&&) noexcept;

  // Of the round at hand; none after the last.
  std::vector<SunDirection> const& directions() const;

  // What is seen at them, by direction and receiver; the next round is at hand then.
  void add(std::vector<std::vector<Sunlit>> const& answers);

 private:
  friend class SampledSunlit;
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

// Sunlit areas at any of the sun's positions over the years, from samples: between the solstices
// they depend on the direction alone, so that one sample serves spring and autumn, morning
// schedules and any weather.
//
// What is interpolated is the sunlit fraction, without the cosine of incidence, of each receiver
// and of each combination of scheduled shades: by radial splines (Duchon 1977) through the
// directions at which the sun faces the receiver, so that nothing is pieced together at sunrise, at
// midnight in polar day, or where the sun turns away. Over where shadows fall on the receiver's
// plane or over the direction, whichever tells a sample better from all the others (leave-one-out).
// Six tenths of the directions lie on arcs of equal declination, every other arc half a step on;
// the others go where all the other samples miss a sample most, over all receivers, in three
// rounds. Fractions are held within 0 .. 1, and so are their sums.
//
// The paper's grid instead has cubic B-splines along the azimuth and then across the days.
class SampledSunlit {
 public:
  // As SampleRounds. Asks `source` a few times, for many directions at once. Throws what it throws.
  SampledSunlit(Sampling sampling, double latitude, std::vector<glm::dvec3> receivers,
                SunlitSource const& source);
  // From all rounds.
  explicit SampledSunlit(SampleRounds rounds);
  ~SampledSunlit();
  SampledSunlit(SampledSunlit const&) = delete;
  SampledSunlit& operator=(SampledSunlit const&) = delete;
  SampledSunlit(SampledSunlit&&) noexcept;
  SampledSunlit& operator=(SampledSunlit&&) noexcept;

  // Other receivers from samples at the same directions.
  SampledSunlit with(std::vector<glm::dvec3> receivers, SunlitSource const& source) const;

  // Of every receiver; pixel_counted_area is 0. For directions that in_suns_range() has.
  std::vector<Sunlit> at(SunDirection direction) const;

  // False where the sun faces the receiver at none of the samples: its answers are then 0.
  bool knows(std::size_t receiver) const;

  std::vector<SunDirection> const& directions() const;

  // The samples themselves; first one unscheduled of each receiver, in order.
  std::vector<SampledFractions> const& fractions() const;

  // Whether the sun faces a receiver at each of directions().
  std::vector<bool> const& lit(std::size_t receiver) const;

 private:
  class Implementation;
  explicit SampledSunlit(std::unique_ptr<Implementation> implementation);

  std::unique_ptr<Implementation> implementation_;
};

// Whether the sun ever stands there: not below the horizon, nor beyond a solstice's arc by more
// than a tenth of a degree. Latitude in radians.
bool in_suns_range(SunDirection direction, double latitude);

}  // namespace gpu_shading
