#include "backends/checked/checked_backend.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include "gpu_shading/error.h"
#include "platform/stopwatch.h"
#include "view/tile.h"
#include "view/view.h"

namespace gpu_shading {

namespace {

// Projected edges of polygons in pixels; each counts up to the diagonal of a tile.
struct Edges {
  double length = 0.0;
  double swept = 0.0;  // pixels that edges sweep as single precision rounds their ends

  void add(Polygon const& polygon, View const& view, int side) {
    add(polygon.outline, view, side);
    for (Ring const& hole : polygon.holes) add(hole, view, side);
  }

  double tolerance(std::uint64_t pixels) const {
    auto const all = static_cast<double>(pixels);
    return (std::sqrt(std::min(length, all)) + swept) / all;
  }

 private:
  void add(Ring const& ring, View const& view, int side) {
    constexpr double rounding = std::numeric_limits<float>::epsilon();
    double const longest = std::sqrt(2.0) * side;
    auto const place = [&](glm::dvec3 const& vertex) {
      glm::dvec3 const p = vertex - view.origin;
      return to_pixels({at(view.x, p), at(view.y, p)}, side);
    };
    for (std::size_t i = 0; i < ring.size(); ++i) {
      glm::dvec2 const begin = place(ring[i]);
      glm::dvec2 const end = place(ring[(i + 1) % ring.size()]);
      double const seen = std::min(glm::distance(begin, end), longest);
      length += seen;
      swept += rounding * std::max(glm::length(begin), glm::length(end)) * seen;
    }
  }
};

// Sums of the device and of the reference.
using Pair = std::array<double, 2>;

// By combination of schedules.
std::map<std::vector<std::pair<int, int>>, Pair> pairs_of(LuminanceSums const& device,
                                                          LuminanceSums const& reference) {
  std::map<std::vector<std::pair<int, int>>, Pair> pairs;
  pairs[{}] = {device.unscheduled, reference.unscheduled};
  for (auto const& [powers, sum] : device.scheduled) pairs[powers][0] = sum;
  for (auto const& [powers, sum] : reference.scheduled) pairs[powers][1] = sum;
  return pairs;
}

}  // namespace

double ViewDifference::severity() const {
  double const difference = std::abs(device - reference);
  return std::isnan(difference) ? std::numeric_limits<double>::infinity() : difference / tolerance;
}

ViewDifference compare(ReceiverView const& view, ViewSums const& device, ViewSums const& reference,
                       Scene const& scene, Transmission const& transmission) {
  int const side = view.tile->side;
  View const projection = view_in_front(*view.frame, view.tile->map, view.towards_sun);
  Edges edges;
  edges.add(scene[view.receiver].polygon, projection, side);
  auto const all = static_cast<double>(reference.receiver_pixels);
  auto const drawn = static_cast<double>(device.receiver_pixels);
  ViewDifference worst{"size", drawn / all, 1.0, edges.tolerance(reference.receiver_pixels)};
  // Without any pixel the view is asked for again, on a larger tile.
  if (worst.severity() > 1.0 || device.receiver_pixels == 0) return worst;
  for (SurfaceId const id : view.casters) edges.add(scene[id].polygon, projection, side);
  for (SurfaceId const id : view.interiors) edges.add(scene[id].polygon, projection, side);
  if (transmission.any_body(view.casters)) edges.length = all;
  double const within = edges.tolerance(reference.receiver_pixels);
  worst = {"sunlit fraction", 0.0, 0.0, within};
  for (std::size_t i = 0; i < reference.parts.size(); ++i) {
    for (auto const& [powers, sums] : pairs_of(device.parts.at(i), reference.parts[i])) {
      ViewDifference const here{"sunlit fraction", sums[0] / drawn, sums[1] / all, within};
      if (here.severity() > worst.severity()) worst = here;
    }
  }
  return worst;
}

namespace {

// Nearly edge-on, single precision moves shadows too far to tell anything.
constexpr double min_cosine = 0.05;

// "a receiver behind transparent shades"
std::string kind_of(ReceiverView const& view, Transmission const& transmission) {
  std::string const casters = view.crowd != nullptr ? "a crowd of opaque casters"
                              : view.transmits      ? transmission.describe(view.casters)
                                                    : "opaque casters";
  return (view.through ? "an interior behind " : "a receiver behind ") + casters;
}

bool is_partly_lit(ViewSums const& sums) {
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
                               Warn warn, Keep keep)
    : device_(std::move(device)),
      reference_(std::move(reference)),
      info_(device_->device()),
      scene_(input.scene),
      transmission_(input.transmission),
      warn_(std::move(warn)),
      keep_(keep) {
  // Tiles must suit both.
  info_.max_resolution = std::min(info_.max_resolution, reference_->device().max_resolution);
}

DeviceInfo const& CheckedBackend::device() const { return device_ ? info_ : reference_->device(); }

bool CheckedBackend::samples_pixels() const {
  return (device_ ? device_ : reference_)->samples_pixels();
}

std::optional<std::size_t> CheckedBackend::few_casters(bool interiors) const {
  return (device_ ? device_ : reference_)->few_casters(interiors);
}

void CheckedBackend::add(std::vector<ReceiverView> views) {
  if (!device_) return reference_->add(std::move(views));
  for (ReceiverView const& view : views) {
    Checks& checks = checks_[kind_of(view, transmission_)];
    if (!checks.enough()) checks.kept.push_back({view, added_});
    ++added_;
  }
  by_device_.views += views.size();
  Stopwatch const watch(by_device_.seconds);
  device_->add(std::move(views));
}

std::vector<ViewSums> CheckedBackend::finish() {
  if (!device_) return reference_->finish();
  std::vector<ViewSums> sums;
  {
    Stopwatch const watch(by_device_.seconds);
    sums = device_->finish();
  }
  std::string const fault = find_fault(sums);
  if (!fault.empty()) {
    if (!warn_) throw DeviceError(fault);
    answer_kept(sums);
    device_.reset();
    warn_(fault + "; continuing on the CPU");
  }
  discard_kept();
  judge_pace();
  return sums;
}

void CheckedBackend::judge_pace() {
  if (std::exchange(first_batch_, false)) by_device_ = {};
  if (!device_ || !warn_ || keep_ == Keep::if_right || by_device_.views < timed_views ||
      by_reference_.views < partly_lit_views) {
    return;
  }
  keep_ = Keep::if_right;
  double const times = by_device_.each() / by_reference_.each();
  if (times <= slower) return;
  device_.reset();
  warn_(
      fmt::format("{} takes {:.1f} times as long as the CPU to render this model; continuing on "
                  "the CPU (name the device to keep it)",
                  info_.renderer, times));
}

void CheckedBackend::forget() {
  discard_kept();
  reference_->forget();
  if (device_) device_->forget();
}

std::vector<CheckedBackend::Kept const*> CheckedBackend::Checks::choose() const {
  std::vector<Kept const*> clear;
  for (Kept const& one : kept) {
    if (one.view.cosine >= min_cosine) clear.push_back(&one);
  }
  std::size_t const wanted =
      enough() ? 0 : std::min(max_views - views, partly_lit_views - partly_lit);
  if (clear.size() <= wanted) return clear;
  std::vector<Kept const*> chosen;
  for (std::size_t i = 0; i < wanted; ++i) {
    chosen.push_back(clear[(2 * i + 1) * clear.size() / (2 * wanted)]);
  }
  return chosen;
}

std::string CheckedBackend::find_fault(std::vector<ViewSums> const& sums) {
  struct Chosen {
    std::string kind;
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
  by_reference_.views += views.size();
  std::vector<ViewSums> references;
  {
    Stopwatch const watch(by_reference_.seconds);
    references = answer(*reference_, std::move(views));
  }
  double worst = 1.0;
  std::string fault;
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    auto const& [kind, checks, kept] = chosen[i];
    ++checks->views;
    if (is_partly_lit(references[i])) ++checks->partly_lit;
    ViewDifference const found =
        compare(kept->view, sums[kept->place], references[i], scene_, transmission_);
    if (found.severity() <= worst) continue;
    worst = found.severity();
    fault = fmt::format(
        "{} computes wrong answers: the {} of {}, {}, is {:.4g} by it and {:.4g} by the CPU, with "
        "a tolerance of {:.2g} (see gpu_shading devices --test)",
        describe(info_), found.quantity, scene_[kept->view.receiver].name, kind, found.device,
        found.reference, found.tolerance);
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
