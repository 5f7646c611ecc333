#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "gpu_shading/renderer.h"
#include "gpu_shading/sampled_sunlit.h"
#include "gpu_shading/sun_direction.h"

namespace gpu_shading {

// When the sun is less than a tenth of a degree above a receiver's plane, its fraction is a
// quotient of two negligible values.
constexpr double min_cosine = 0.002;

// Sunlit fractions at sampled directions, in columns: for each receiver, one for the beam that
// passes no scheduled shade, and one for each combination of scheduled shades that occurs.
class SunlitTable {
 public:
  using Column = SampledFractions;
  using Powers = std::vector<std::pair<int, int>>;

  // Unit normal times net area of each receiver.
  explicit SunlitTable(std::vector<glm::dvec3> receivers);

  void add(std::span<SunDirection const> directions,
           std::vector<std::vector<Sunlit>> const& answers);

  std::vector<SunDirection> const& directions() const { return directions_; }
  std::vector<glm::dvec3> const& towards_sun() const { return towards_sun_; }
  std::vector<Column> const& columns() const { return columns_; }
  std::size_t receivers() const { return receivers_.size(); }

  // Unit vector; zero if the area is 0.
  glm::dvec3 const& normal(std::size_t receiver) const { return receivers_[receiver].normal; }

  // Whether a fraction can be computed from a rendering.
  bool faces(std::size_t receiver, glm::dvec3 const& sun) const;

  // By direction.
  std::vector<bool> const& lit(std::size_t receiver) const { return lit_[receiver]; }

  // Areas from fractions by column, which may be slightly outside 0 .. 1.
  std::vector<Sunlit> compose(std::span<double const> fractions, glm::dvec3 const& sun) const;

 private:
  struct Receiver {
    glm::dvec3 normal;
    double area;
  };

  Column& column_of(std::size_t receiver, Powers const& powers);

  std::vector<Receiver> receivers_;
  std::vector<SunDirection> directions_;
  std::vector<glm::dvec3> towards_sun_;
  std::vector<std::vector<bool>> lit_;  // by receiver and direction
  std::vector<Column> columns_;         // the unscheduled first, by receiver
  std::map<std::pair<std::size_t, Powers>, std::size_t> scheduled_;  // the others
};

// Interpolation between the samples of a table.
class Interpolant {
 public:
  Interpolant() = default;
  Interpolant(Interpolant const&) = delete;
  Interpolant& operator=(Interpolant const&) = delete;
  virtual ~Interpolant() = default;

  // Values by column of the table, which may be outside 0 .. 1; 0 if nothing is known.
  virtual std::vector<double> at(SunDirection direction) const = 0;
};

}  // namespace gpu_shading
