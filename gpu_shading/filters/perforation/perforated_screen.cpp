#include "gpu_shading/perforated_screen.h"

#include <fmt/format.h>
#include <tbb/collaborative_call_once.h>

#include <utility>

#include "gpu_shading/error.h"
#include "platform/parallel.h"

namespace gpu_shading {
namespace {

void check_layers(std::optional<int> layers) {
  constexpr int most = 64;
  if (!layers || (*layers >= 1 && *layers <= most)) return;
  throw Error(fmt::format("layers is {}, expected 1 to {}", *layers, most));
}

void check_thickness(double thickness) {
  if (thickness >= 0.0 && thickness < 1.0) return;
  throw Error(fmt::format("thickness is {:.9g} m, expected 0 to below 1", thickness));
}

}  // namespace

struct PerforatedScreen::Lazy {
  // Threads that wait for the table share the work on it.
  tbb::collaborative_once_flag once;
  std::optional<ScreenTransmittance> transmittance;
};

PerforatedScreen::PerforatedScreen(HolePattern const& pattern, Sheet const& sheet)
    : sheet_(sheet),
      pattern_(pattern),
      hole_(pattern.perforation().size),
      web_(pattern.web()),
      lazy_(std::make_shared<Lazy>()) {
  check_layers(sheet.layers);
  check_thickness(sheet.thickness);
}

PerforatedScreen::PerforatedScreen(OpacityTile tile, Sheet const& sheet)
    : sheet_(sheet),
      tile_(std::move(tile)),
      hole_(tile_->hole()),
      web_(tile_->web()),
      lazy_(std::make_shared<Lazy>()) {
  check_layers(sheet.layers);
  check_thickness(sheet.thickness);
}

double PerforatedScreen::open_fraction() const {
  return pattern_ ? pattern_->open_fraction() : tile_->open_fraction();
}

ScreenTransmittance const& PerforatedScreen::transmittance() const {
  auto const make = [&] {
    if (pattern_) {
      lazy_->transmittance.emplace(*pattern_, sheet_.thickness);
    } else {
      lazy_->transmittance.emplace(*tile_, sheet_.thickness);
    }
  };
  if (!lacks_threads()) {
    tbb::collaborative_call_once(lazy_->once, make);
  } else if (!lazy_->transmittance) {
    make();
  }
  return *lazy_->transmittance;
}

}  // namespace gpu_shading
