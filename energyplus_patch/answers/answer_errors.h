#pragma once

#include <cstddef>
#include <map>
#include <optional>

#include "gpu_shading/scene.h"
#include "gpu_shading/sunlit.h"

namespace gpu_shading::energyplus {

// The errors (Sunlit::error) of the views that a run was answered from.
class AnswerErrors {
 public:
  // `receiver`: the window, if it is a view of the surfaces behind one.
  void add(SurfaceId receiver, std::optional<double> error);
  AnswerErrors& operator+=(AnswerErrors const& other);

  std::size_t sampled() const { return sampled_; }
  std::size_t exact() const { return exact_; }
  std::size_t not_measured() const { return not_measured_; }

  // Sunlit::rounding where no view was sampled.
  double largest() const;
  // The error that this share of sampled views stay within, rounded up by at most 1 %.
  double within(double share) const;

  // Of a receiver; a view whose error was not measured has none.
  double largest_of(SurfaceId receiver) const;
  bool all_measured_of(SurfaceId receiver) const;

 private:
  struct OfReceiver {
    double largest = Sunlit::rounding;
    bool all_measured = true;
  };

  std::size_t sampled_ = 0;
  std::size_t exact_ = 0;
  std::size_t not_measured_ = 0;
  std::map<float, std::size_t> counts_;  // of sampled views, by error
  std::map<SurfaceId, OfReceiver> of_receivers_;
};

}  // namespace gpu_shading::energyplus
