#include "backends/open_backend.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "antialias/antialias.h"
#include "backends/checked/checked_backend.h"
#include "backends/cpu/cpu_backend.h"
#include "backends/modules.h"
#include "filters/perforation/sheet_in_beam.h"
#include "gpu_shading/error.h"
#include "platform/parallel.h"
#include "view/view.h"

namespace gpu_shading {
namespace {

// Whether a ray of a view may pass two sheets with small holes. A device draws these by their
// effective transmittance, which ignores how the holes of two sheets meet; the CPU draws holes of
// any size.
bool passes_two_sheets(ReceiverView const& view, Transmission const& transmission) {
  std::vector<int> const numbers = transmission.screens_among(view.casters);
  if (numbers.size() < 2) return false;
  bool const small_holes = std::any_of(numbers.begin(), numbers.end(), [&](int number) {
    Screens::Entry const& entry = transmission.screens()[number];
    return may_see_effect(entry, view.towards_sun, view.pixel_area());
  });
  return small_holes && any_overlap(transmission.screens(), numbers,
                                    view_in_front(*view.frame, view.tile->map, view.towards_sun));
}

// Leaves some views to the CPU.
class SomeViewsOnCpu : public ViewBackend {
 public:
  SomeViewsOnCpu(std::unique_ptr<ViewBackend> device, std::unique_ptr<ViewBackend> cpu,
                 Transmission const& transmission);

  DeviceInfo const& device() const override { return device_->device(); }
  bool samples_pixels() const override { return device_->samples_pixels(); }
  std::optional<std::size_t> few_casters(bool interiors) const override {
    return device_->few_casters(interiors);
  }

  void add(std::vector<ReceiverView> views) override;
  std::vector<ViewSums> finish() override;
  void forget() override;

 private:
  std::unique_ptr<ViewBackend> device_;
  std::unique_ptr<ViewBackend> cpu_;
  Transmission const& transmission_;
  bool is_for_cpu(ReceiverView const& view) const {
    return view.transmits && view.tile != nullptr && passes_two_sheets(view, transmission_);
  }

  std::vector<char> on_cpu_;  // of each view of this batch
};

SomeViewsOnCpu::SomeViewsOnCpu(std::unique_ptr<ViewBackend> device,
                               std::unique_ptr<ViewBackend> cpu, Transmission const& transmission)
    : device_(std::move(device)), cpu_(std::move(cpu)), transmission_(transmission) {}

void SomeViewsOnCpu::add(std::vector<ReceiverView> views) {
  std::size_t const first = on_cpu_.size();
  on_cpu_.resize(first + views.size());
  for_each_index(views.size(),
                 [&](std::size_t i) { on_cpu_[first + i] = is_for_cpu(views[i]) ? 1 : 0; });
  std::vector<ReceiverView> for_cpu;
  std::vector<ReceiverView> for_device;
  for (std::size_t i = 0; i < views.size(); ++i) {
    (on_cpu_[first + i] != 0 ? for_cpu : for_device).push_back(std::move(views[i]));
  }
  device_->add(std::move(for_device));
  cpu_->add(std::move(for_cpu));
}

std::vector<ViewSums> SomeViewsOnCpu::finish() {
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

void SomeViewsOnCpu::forget() {
  on_cpu_.clear();
  device_->forget();
  cpu_->forget();
}

DeviceModule const& module_of(DeviceId const& device) {
  auto const modules = device_modules();
  auto const found = std::ranges::find(modules, device.module, &NamedModule::name);
  if (found == modules.end()) {
    throw DeviceError(
        fmt::format("device {}: there is no module '{}'", device_name(device), device.module));
  }
  return found->get();
}

// Opens the chosen device by open(module), or else that of the first module that opens one.
template <typename Open>
auto open_device(DeviceChoice const& choice, Warn const& warn, Open open) {
  if (choice.device) return open(module_of(*choice.device));
  decltype(open(module_of({}))) opened;
  for (NamedModule const& named : device_modules()) {
    if (!named.may_have_device()) continue;
    try {
      opened = open(named.get());
    } catch (DeviceError const& error) {
      if (warn) warn(fmt::format("the GPU cannot be used: {}", error.what()));
    }
    if (opened) break;
  }
  return opened;
}

}  // namespace

std::unique_ptr<ViewBackend> open_backend(BackendInput const& input, DeviceChoice const& choice,
                                          Warn const& warn) {
  return open_device(choice, warn,
                     [&](DeviceModule const& module) { return module.open(input, choice); });
}

std::unique_ptr<ViewBackend> open_checked_backend(BackendInput const& input,
                                                  DeviceChoice const& choice, Warn const& warn) {
  auto opened = open_backend(input, choice, warn);
  if (opened->device().id.is_cpu()) return opened;
  using Keep = CheckedBackend::Keep;
  auto checked = std::make_unique<CheckedBackend>(
      std::move(opened), std::make_unique<CpuBackend>(input), input, warn,
      choice.device ? Keep::if_right : Keep::if_right_and_not_slower);
  if (input.transmission.screens().entries().size() < 2) return checked;
  return std::make_unique<SomeViewsOnCpu>(std::move(checked), std::make_unique<CpuBackend>(input),
                                          input.transmission);
}

std::unique_ptr<PictureRaster> open_picture_raster(PictureScene const& scene,
                                                   DeviceChoice const& choice) {
  // Answers came first: their user was told what the device lacks.
  return open_device(choice, {}, [&](DeviceModule const& module) {
    return module.open_for_pictures(scene, choice);
  });
}

}  // namespace gpu_shading
