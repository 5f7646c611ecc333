#include "backends/checked/checked_backend.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "gpu_shading/error.h"

namespace gpu_shading {
namespace {

// Nearly edge-on, single precision moves shadows too far to tell anything.
constexpr double least_cosine = 0.05;

bool is_telling(ViewSums const& sums) {
  constexpr double margin = 0.02;
  double lit = 0.0;
  for (LuminanceSums const& part : sums.parts) {
    lit += part.unscheduled;
    for (LuminanceSums::Scheduled const& scheduled : part.scheduled) lit += scheduled.sum;
  }
  double const share = lit / static_cast<double>(sums.receiver_pixels);
  return share > margin && share < 1.0 - margin;
}

std::vector<ViewSums> answer(ViewBackend& backend, std::vector<ReceiverView> views) {
  backend.forget();
  backend.add(std::move(views));
  return backend.finish();
}

}  // namespace

CheckedBackend::CheckedBackend(std::unique_ptr<ViewBackend> device,
                               std::unique_ptr<ViewBackend> reference, BackendInput const& input,
                               Warn warn)
    : device_(std::move(device)),
      reference_(std::move(reference)),
      info_(device_->device()),
      scene_(input.scene),
      transmission_(input.transmission),
      warn_(std::move(warn)) {
  // Tiles must suit both.
  info_.max_resolution = std::min(info_.max_resolution, reference_->device().max_resolution);
}

DeviceInfo const& CheckedBackend::device() const { return device_ ? info_ : reference_->device(); }

bool CheckedBackend::samples_pixels() const {
  return (device_ ? device_ : reference_)->samples_pixels();
}

void CheckedBackend::add(std::vector<ReceiverView> views) {
  if (!device_) return reference_->add(std::move(views));
  for (ReceiverView const& view : views) {
    Checks& checks = checks_[ViewKind(view, transmission_)];
    if (!checks.enough()) checks.kept.push_back({view, added_});
    ++added_;
  }
  device_->add(std::move(views));
}

std::vector<ViewSums> CheckedBackend::finish() {
  if (!device_) return reference_->finish();
  std::vector<ViewSums> sums = device_->finish();
  std::string const fault = find_fault(sums);
  if (!fault.empty()) {
    if (!warn_) throw DeviceError(fault);
    answer_kept(sums);
    device_.reset();
    warn_(fault + "; continuing on the CPU");
  }
  discard_kept();
  return sums;
}

void CheckedBackend::forget() {
  discard_kept();
  reference_->forget();
  if (device_) device_->forget();
}

std::vector<CheckedBackend::Kept const*> CheckedBackend::Checks::choose() const {
  std::vector<Kept const*> clear;
  for (Kept const& one : kept) {
    if (one.view.cosine >= least_cosine) clear.push_back(&one);
  }
  std::size_t const wanted = enough() ? 0 : std::min(most_views - views, telling_views - telling);
  if (clear.size() <= wanted) return clear;
  std::vector<Kept const*> chosen;
  for (std::size_t i = 0; i < wanted; ++i) {
    chosen.push_back(clear[(2 * i + 1) * clear.size() / (2 * wanted)]);
  }
  return chosen;
}

std::string CheckedBackend::find_fault(std::vector<ViewSums> const& sums) {
  struct Chosen {
    ViewKind kind;
    Checks* checks;
    Kept const* kept;
  };
  std::vector<Chosen> chosen;
  std::vector<ReceiverView> views;
  for (auto& [kind, checks] : checks_) {
    for (Kept const* const kept : checks.choose()) {
      chosen.push_back({kind, &checks, kept});
      views.push_back(kept->view);
      views.back().at_pixels = true;
    }
  }
  if (chosen.empty()) return {};
  std::vector<ViewSums> const references = answer(*reference_, std::move(views));
  double worst = 1.0;
  std::string fault;
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    auto const& [kind, checks, kept] = chosen[i];
    ++checks->views;
    if (is_telling(references[i])) ++checks->telling;
    ViewDifference const found =
        compare(kept->view, sums[kept->place], references[i], scene_, transmission_);
    if (found.severity() <= worst) continue;
    worst = found.severity();
    fault = fmt::format(
        "{} computes wrong answers: the {} of {}, {}, is {:.4g} by it and {:.4g} by the CPU, with "
        "a tolerance of {:.2g} (see gpu_shading devices --test)",
        describe(info_), found.quantity, scene_[kept->view.receiver].name, kind.name(),
        found.device, found.reference, found.tolerance);
  }
  return fault;
}

void CheckedBackend::answer_kept(std::vector<ViewSums>& sums) {
  std::vector<ReceiverView> views;
  std::vector<std::size_t> places;
  for (auto& [kind, checks] : checks_) {
    for (Kept& kept : checks.kept) {
      views.push_back(std::move(kept.view));
      places.push_back(kept.place);
    }
  }
  std::vector<ViewSums> answers = answer(*reference_, std::move(views));
  for (std::size_t i = 0; i < places.size(); ++i) sums[places[i]] = std::move(answers[i]);
}

void CheckedBackend::discard_kept() {
  added_ = 0;
  for (auto& [kind, checks] : checks_) checks.kept.clear();
}

}  // namespace gpu_shading
