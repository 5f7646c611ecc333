#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string_view>

#include "filters/transmittance/pane.h"
#include "gpu_shading/error.h"
#include "gpu_shading/transmittance.h"

namespace gpu_shading {
namespace {

void check(GlassLayer const& layer, std::size_t number) {
  auto const in_range = [&](std::string_view field, double value) {
    if (value >= 0.0 && value <= 1.0) return;
    throw Error(fmt::format("pane {}: {} is {:.9g}, expected 0 to 1", number, field, value));
  };
  auto const in_sum = [&](std::string_view field, double value) {
    if (layer.transmittance + value <= 1.0 + 1e-9) return;
    throw Error(fmt::format(
        "pane {}: transmittance {:.9g} and {} {:.9g} add up to {:.9g}, expected at most 1", number,
        layer.transmittance, field, value, layer.transmittance + value));
  };
  in_range("transmittance", layer.transmittance);
  in_range("front reflectance", layer.front_reflectance);
  in_range("back reflectance", layer.back_reflectance);
  in_sum("front reflectance", layer.front_reflectance);
  in_sum("back reflectance", layer.back_reflectance);
}

std::vector<Pane> panes_of(std::span<GlassLayer const> layers) {
  if (layers.empty()) throw Error("glazing has no panes, expected 1 or more");
  std::vector<Pane> panes;
  for (GlassLayer const& layer : layers) {
    check(layer, panes.size() + 1);
    panes.emplace_back(layer);
  }
  return panes;
}

// Engineering Reference, "Glazing System Properties": pane by pane, those of the previous panes.
PaneProperties of_all(std::vector<Pane> const& panes, double cosine) {
  PaneProperties all{1.0, 0.0, 0.0};
  for (Pane const& pane : panes) {
    PaneProperties const p = pane.at(cosine);
    double const kept = 1.0 - p.front_reflectance * all.back_reflectance;
    // Between perfect mirrors, at grazing incidence, nothing is transmitted: T vanishes faster.
    if (kept <= 0.0) return {0.0, all.front_reflectance, p.back_reflectance};
    all.front_reflectance += all.transmittance * all.transmittance * p.front_reflectance / kept;
    all.transmittance *= p.transmittance / kept;
    all.back_reflectance =
        p.back_reflectance + p.transmittance * p.transmittance * all.back_reflectance / kept;
  }
  return all;
}

}  // namespace

Transmittance Transmittance::glazing(std::span<GlassLayer const> layers) {
  return Transmittance([panes = panes_of(layers)](double angle) {
    // The cosine of the double closest to pi/2 is 6e-17.
    double const cosine = std::cos(angle);
    return of_all(panes, cosine < 1e-15 ? 0.0 : cosine).transmittance;
  });
}

double normal_reflectance(std::span<GlassLayer const> layers) {
  return of_all(panes_of(layers), 1.0).front_reflectance;
}

}  // namespace gpu_shading
