#include "gpu_shading/perforated_screen.h"

#include <fmt/format.h>
#include <tbb/collaborative_call_once.h>

#include <mutex>
#include <utility>

#include "filters/perforation/image_cells.h"
#include "filters/perforation/perforation_filter.h"
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
  std::once_flag open_once;
  double open_fraction = 0.0;
  // Threads that wait for the table share the work on it.
  tbb::collaborative_once_flag once;
  std::optional<ScreenTransmittance> transmittance;
  std::once_flag bounds_once;
  std::optional<ImageBounds> bounds;
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
  std::call_once(lazy_->open_once, [&] {
    lazy_->open_fraction = pattern_ ? pattern_->open_fraction() : tile_->open_fraction();
  });
  return lazy_->open_fraction;
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

ImageBounds const& PerforatedScreen::image_bounds() const {
  std::call_once(lazy_->bounds_once, [&] { lazy_->bounds.emplace(*tile_); });
  return *lazy_->bounds;
}

namespace {

void add_number(FilterDigest& digest, std::optional<double> const& value) {
  digest.add(value ? 1.0 : 0.0);
  digest.add(value.value_or(0.0));
}

void add_pattern(FilterDigest& digest, Perforation const& holes) {
  for (double const value :
       {static_cast<double>(holes.hole), static_cast<double>(holes.arrangement), holes.size,
        holes.length, holes.pitch, holes.row_pitch}) {
    digest.add(value);
  }
}

void add_tile(FilterDigest& digest, OpacityTile const& tile) {
  for (double const value : {tile.width(), tile.height(), static_cast<double>(tile.columns()),
                             static_cast<double>(tile.rows())}) {
    digest.add(value);
  }
  add_number(digest, tile.threshold());
  digest.add_shared(tile.opacity().data(),
                    [&](FilterDigest& shared) { shared.add(tile.opacity()); });
}

}  // namespace

BeamFilter::Faces faces_of(PerforatedSheet const& kind) {
  Sheet const& sheet = kind.screen->sheet();
  switch (sheet.plane) {
    case SheetPlane::outside:
      return {-sheet.thickness, 0.0};
    case SheetPlane::inside:
      return {0.0, sheet.thickness};
    case SheetPlane::centre:
      break;
  }
  return {-sheet.thickness / 2.0, sheet.thickness / 2.0};
}

FilterLook look_of(PerforatedSheet const& kind) {
  FilterLook look{FilterLook::Kind::holes, kind.screen->open_fraction()};
  if (kind.screen->pattern()) look.holes = kind.screen->pattern()->perforation();
  return look;
}

void add_values(FilterDigest& digest, PerforatedSheet const& kind) {
  Sheet const& sheet = kind.screen->sheet();
  digest.add(sheet.thickness);
  digest.add(static_cast<double>(sheet.plane));
  add_number(digest, sheet.layers);
  digest.add(static_cast<double>(sheet.detail));
  digest.add(kind.screen->pattern() ? 1.0 : 0.0);
  if (kind.screen->pattern()) {
    add_pattern(digest, kind.screen->pattern()->perforation());
  } else {
    add_tile(digest, *kind.screen->tile());
  }
  digest.add(kind.placement.origin_u);
  digest.add(kind.placement.origin_v);
  digest.add(kind.placement.rotation);
  digest.add(static_cast<double>(kind.deployment));
}

}  // namespace gpu_shading
