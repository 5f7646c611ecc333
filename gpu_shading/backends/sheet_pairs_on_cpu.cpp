#include "backends/sheet_pairs_on_cpu.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "filters/perforation/screens.h"
#include "filters/perforation/sheet_in_beam.h"
#include "platform/parallel.h"
#include "view/view.h"

namespace gpu_shading {

SheetPairsOnCpu::SheetPairsOnCpu(std::unique_ptr<ViewBackend> device,
                                 std::unique_ptr<ViewBackend> cpu, Transmission const& transmission)
    : device_(std::move(device)), cpu_(std::move(cpu)), transmission_(transmission) {}

bool SheetPairsOnCpu::passes_two(ReceiverView const& view) const {
  if (!view.transmits) return false;
  std::vector<int> const numbers = transmission_.screens_among(view.casters);
  if (numbers.size() < 2) return false;
  bool const small_holes = std::any_of(numbers.begin(), numbers.end(), [&](int number) {
    Screens::Entry const& entry = transmission_.screens()[number];
    return may_see_effect(entry, view.towards_sun, view.pixel_area());
  });
  return small_holes && any_overlap(transmission_.screens(), numbers,
                                    view_in_front(*view.frame, view.tile->map, view.towards_sun));
}

void SheetPairsOnCpu::add(std::vector<ReceiverView> views) {
  std::size_t const first = on_cpu_.size();
  on_cpu_.resize(first + views.size());
  for_each_index(views.size(),
                 [&](std::size_t i) { on_cpu_[first + i] = passes_two(views[i]) ? 1 : 0; });
  std::vector<ReceiverView> for_cpu;
  std::vector<ReceiverView> for_device;
  for (std::size_t i = 0; i < views.size(); ++i) {
    (on_cpu_[first + i] != 0 ? for_cpu : for_device).push_back(std::move(views[i]));
  }
  device_->add(std::move(for_device));
  cpu_->add(std::move(for_cpu));
}

std::vector<ViewSums> SheetPairsOnCpu::finish() {
  std::vector<ViewSums> by_cpu = cpu_->finish();
  std::vector<ViewSums> by_device = device_->finish();
  std::vector<ViewSums> sums;
  sums.reserve(on_cpu_.size());
  std::size_t next_of_cpu = 0;
  std::size_t next_of_device = 0;
  for (char const on_cpu : on_cpu_) {
    sums.push_back(std::move(on_cpu != 0 ? by_cpu[next_of_cpu++] : by_device[next_of_device++]));
  }
  on_cpu_.clear();
  return sums;
}

void SheetPairsOnCpu::forget() {
  on_cpu_.clear();
  device_->forget();
  cpu_->forget();
}

}  // namespace gpu_shading
