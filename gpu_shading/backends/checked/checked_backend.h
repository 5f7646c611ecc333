#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

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
// their holes have edges of their own. A device rounds the corners of casters to single precision:
// an edge that ends P pixels away may lie 2^-23 P pixels from its place.
ViewDifference compare(ReceiverView const& view, ViewSums const& device, ViewSums const& reference,
                       Scene const& scene, Transmission const& transmission);

using Warn = std::function<void(std::string const&)>;

// A device whose first answers of each kind of view are compared with those of a reference, the
// CPU. Once one is wrong, the reference answers: from the views of that batch whose kinds were
// still being checked on. So it does from the next batch on once the device is found to be slower.
class CheckedBackend : public ViewBackend {
 public:
  // Up to so many views of a kind are compared, until this many were partly sunlit; all sunlit or
  // all dark, a view tells little.
  static constexpr std::size_t max_views = 24;
  static constexpr std::size_t partly_lit_views = 8;

  // A device that takes more than so many times as long for a view as the reference is slower.
  static constexpr double slower = 2.0;
  // Views after the first batch by which that is judged.
  static constexpr std::size_t timed_views = 200;

  enum class Keep { if_right, if_right_and_not_slower };

  // `warn` gets one line when the reference takes over. Without it, finish() throws DeviceError if
  // an answer is wrong, and a slower device is kept.
  CheckedBackend(std::unique_ptr<ViewBackend> device, std::unique_ptr<ViewBackend> reference,
                 BackendInput const& input, Warn warn, Keep keep = Keep::if_right);

  DeviceInfo const& device() const override;
  bool samples_pixels() const override;
  std::optional<std::size_t> few_casters(bool interiors) const override;

  void add(std::vector<ReceiverView> views) override;
  std::vector<ViewSums> finish() override;
  void forget() override;

 private:
  struct Kept {
    ReceiverView view;
    std::size_t place;  // in the batch
  };
  // Views of one kind: those that need the same parts of a back end.
  struct Checks {
    std::size_t views = 0;       // compared
    std::size_t partly_lit = 0;  // of these, partly sunlit
    std::vector<Kept> kept;      // of this batch

    bool enough() const { return views >= max_views || partly_lit >= partly_lit_views; }
    // Up to so many as are still to be compared, spread over the batch.
    std::vector<Kept const*> choose() const;
  };

  // Compares some of the views that are kept. Returns a line about the worst difference that
  // rounding does not explain, or nothing.
  std::string find_fault(std::vector<ViewSums> const& sums);
  // The time that views took.
  struct Pace {
    std::size_t views = 0;
    double seconds = 0.0;

    double each() const { return seconds / static_cast<double>(views); }
  };
  // Leaves a device that is slower.
  void judge_pace();
  // Has the reference answer all views that are kept.
  void answer_kept(std::vector<ViewSums>& sums);
  void discard_kept();

  std::unique_ptr<ViewBackend> device_;  // none once it was found to be wrong
  std::unique_ptr<ViewBackend> reference_;
  DeviceInfo info_;
  Scene const& scene_;
  Transmission const& transmission_;
  Warn warn_;
  Keep keep_;
  Pace by_device_;  // after the first batch, which also allocates
  Pace by_reference_;
  bool first_batch_ = true;
  std::size_t added_ = 0;                 // views of this batch
  std::map<std::string, Checks> checks_;  // by kind
};

}  // namespace gpu_shading
