#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "backends/checked/view_comparison.h"
#include "backends/interface/view_backend.h"

namespace gpu_shading {

using Warn = std::function<void(std::string const&)>;

// A device whose first answers of each kind of view are compared with those of a reference, the
// CPU. Once one is wrong, the reference answers: from the views of that batch whose kinds were
// still being checked on.
class CheckedBackend : public ViewBackend {
 public:
  // Up to so many views of a kind are compared, until this many were partly sunlit; all sunlit or
  // all dark, a view tells little.
  static constexpr std::size_t most_views = 24;
  static constexpr std::size_t telling_views = 8;

  // `warn` gets one line when the reference takes over. Without it, finish() then throws
  // DeviceError.
  CheckedBackend(std::unique_ptr<ViewBackend> device, std::unique_ptr<ViewBackend> reference,
                 BackendInput const& input, Warn warn);

  DeviceInfo const& device() const override;
  bool samples_pixels() const override;

  void add(std::vector<ReceiverView> views) override;
  std::vector<ViewSums> finish() override;
  void forget() override;

 private:
  struct Kept {
    ReceiverView view;
    std::size_t place;  // in the batch
  };
  // Views of one kind.
  struct Checks {
    std::size_t views = 0;    // compared
    std::size_t telling = 0;  // of these, partly sunlit
    std::vector<Kept> kept;   // of this batch

    bool enough() const { return views >= most_views || telling >= telling_views; }
    // Up to so many as are still to be compared, spread over the batch.
    std::vector<Kept const*> choose() const;
  };

  // Compares some of the views that are kept. Returns a line about the worst difference that
  // rounding does not explain, or nothing.
  std::string find_fault(std::vector<ViewSums> const& sums);
  // Has the reference answer all views that are kept.
  void answer_kept(std::vector<ViewSums>& sums);
  void discard_kept();

  std::unique_ptr<ViewBackend> device_;  // none once it was found to be wrong
  std::unique_ptr<ViewBackend> reference_;
  DeviceInfo info_;
  Scene const& scene_;
  Transmission const& transmission_;
  Warn warn_;
  std::size_t added_ = 0;  // views of this batch
  std::map<ViewKind, Checks> checks_;
};

}  // namespace gpu_shading
