#pragma once

#include <chrono>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "support/perforated_case.h"

// Declarations shared by the modes of the program.
namespace gpu_shading {

class Errors {
 public:
  void add(double error) {
    ++count_;
    sum_ += error;
    absolute_ += std::abs(error);
    largest_ = std::max(largest_, std::abs(error));
  }
  std::size_t count() const { return count_; }
  double signed_mean() const { return sum_ / static_cast<double>(count_); }
  double mean() const { return absolute_ / static_cast<double>(count_); }
  double largest() const { return largest_; }

 private:
  std::size_t count_ = 0;
  double sum_ = 0.0;
  double absolute_ = 0.0;
  double largest_ = 0.0;
};

class Stopwatch {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

// Exact projected sunlit surface fractions, one per position.
std::vector<double> exact_fractions(PerforatedCase const& given,
                                    std::span<SunDirection const> suns);

// From a renderer whose first surface is the receiver, of 1 m2.
Errors errors_of(Renderer& renderer, std::span<SunDirection const> suns,
                 std::span<double const> exact);

// Error of holes and of their effective transmittance by pixel size, hole size and number of holes
// over the receiver.
void print_blend_table(std::span<SunDirection const> suns);

// The sheet as opaque polygons compared with the exact answer, and the screen compared with both.
void print_geometry_table(std::span<SunDirection const> suns, int resolution);

}  // namespace gpu_shading
