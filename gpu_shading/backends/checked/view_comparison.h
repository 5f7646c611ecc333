#pragma once

#include <string>
#include <tuple>

#include "backends/interface/view_backend.h"
#include "filters/transmission.h"
#include "gpu_shading/scene.h"

namespace gpu_shading {

// Where two back ends' answers to one view differ most.
struct ViewDifference {
  char const* quantity = "";
  double device = 0.0;
  double reference = 0.0;
  double tolerance = 0.0;  // the largest difference that rounding explains

  // The difference in tolerances; infinite if it is not a number.
  double severity() const;
};

// Compares the number of the receiver's own pixels ("size", relative to the reference's) and the
// shares of them that are sunlit: of each interior surface, and of each combination of schedules.
//
// With edges of E pixels in length on a tile, either method is within sqrt(E) pixels of the exact
// area in 99 % of views (view/tile_size.h). Both must sample the same pixel centres
// (ReceiverView::at_pixels), and differ only near edges, which they round differently, so that the
// error of one is enough as their tolerance: sqrt(E) of the receiver's N pixels. llvmpipe and the
// CPU differ by at most 0.07 sqrt(E). E is at most N; it is N behind perforated sheets, because
// their holes have edges of their own.
ViewDifference compare(ReceiverView const& view, ViewSums const& device, ViewSums const& reference,
                       Scene const& scene, Transmission const& transmission);

// The parts of a back end that a view needs.
class ViewKind {
 public:
  ViewKind(ReceiverView const& view, Transmission const& transmission);

  bool operator<(ViewKind const& other) const { return parts() < other.parts(); }
  // "a receiver behind transparent shades"
  std::string name() const;

 private:
  std::tuple<bool, bool, bool, bool> parts() const {
    return {interior_, shades_, screens_, schedules_};
  }

  bool interior_ = false;
  bool shades_ = false;
  bool screens_ = false;
  bool schedules_ = false;
};

}  // namespace gpu_shading
