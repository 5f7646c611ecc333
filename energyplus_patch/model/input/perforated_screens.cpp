#include "model/input/perforated_screens.h"

#include <fmt/format.h>

#include <numbers>
#include <set>
#include <utility>

#include "gpu_shading/error.h"
#include "gpu_shading/perforated_screen.h"
#include "model/extensions/extension_fields.h"
#include "model/idf/fields.h"
#include "platform/named_entries.h"
#include "platform/naming.h"
#include "platform/text.h"

namespace gpu_shading::energyplus {
namespace {

namespace field = extension::perforated_screen;

Arrangement arrangement_of(field::Arrangement arrangement) {
  switch (arrangement) {
    case field::Arrangement::straight:
      return Arrangement::Straight;
    case field::Arrangement::staggered45:
      return Arrangement::Staggered45;
    case field::Arrangement::staggered60:
      break;
  }
  return Arrangement::Staggered60;
}

HolePattern read_pattern(InputObject const& object, Hole hole) {
  auto const shape = fmt::format("with Hole Shape {}", object[field::hole_shape.key]);
  expect_blank(object,
               {field::texture_file_name, field::opacity, field::opacity_threshold,
                field::invert_opacity, field::tile_width, field::tile_height},
               shape);
  Perforation perforation;
  perforation.hole = hole;
  perforation.arrangement = arrangement_of(read(object, field::arrangement));
  perforation.size = needed(object, field::hole_size);
  if (hole == Hole::Slotted) {
    perforation.length = needed(object, field::hole_length);
  } else {
    expect_blank(object, {field::hole_length}, shape);
  }
  perforation.pitch = needed(object, field::pitch);
  if (auto const rows = read(object, field::row_pitch)) perforation.row_pitch = *rows;
  return HolePattern(perforation);
}

ScreenTexture read_texture(InputObject const& object, AssetFolder const& folder) {
  expect_blank(
      object,
      {field::arrangement, field::hole_size, field::hole_length, field::pitch, field::row_pitch},
      "with Hole Shape Texture");
  ScreenTexture texture;
  texture.name = read(object, field::texture_file_name);
  if (texture.name.empty()) {
    throw Error(
        fmt::format("{} is blank, expected the name of an image", field::texture_file_name.title));
  }
  texture.path = folder.path / texture.name;
  texture.assets = folder.assets;
  texture.info = naming(field::texture_file_name.title,
                        [&] { return probe_texture(texture.path, texture.assets); });
  if (read(object, field::opacity) == field::Opacity::fractional) {
    expect_blank(object, {field::opacity_threshold}, "with Opacity Fractional");
    texture.threshold.reset();
  } else {
    texture.threshold = read(object, field::opacity_threshold);
  }
  texture.invert = read(object, field::invert_opacity) == field::InvertOpacity::yes;
  texture.width = read(object, field::tile_width);
  texture.height = read(object, field::tile_height);
  return texture;
}

ScreenMaker::Holes read_holes(InputObject const& object, AssetFolder const& folder) {
  switch (read(object, field::hole_shape)) {
    case field::HoleShape::round:
      return read_pattern(object, Hole::Round);
    case field::HoleShape::square:
      return read_pattern(object, Hole::Square);
    case field::HoleShape::slotted:
      return read_pattern(object, Hole::Slotted);
    case field::HoleShape::hexagonal:
      return read_pattern(object, Hole::Hexagonal);
    case field::HoleShape::texture:
      break;
  }
  return read_texture(object, folder);
}

SheetPlane plane_of(field::SheetPlane plane) {
  switch (plane) {
    case field::SheetPlane::outside:
      return SheetPlane::outside;
    case field::SheetPlane::inside:
      return SheetPlane::inside;
    case field::SheetPlane::centre:
      break;
  }
  return SheetPlane::centre;
}

ScreenDetail detail_of(field::Detail detail) {
  switch (detail) {
    case field::Detail::holes:
      return ScreenDetail::holes;
    case field::Detail::effective:
      return ScreenDetail::effective;
    case field::Detail::automatic:
      break;
  }
  return ScreenDetail::automatic;
}

Sheet read_sheet(InputObject const& object) {
  Sheet sheet;
  sheet.thickness = read(object, field::thickness);
  sheet.plane = plane_of(read(object, field::sheet_plane));
  auto const layers = read(object, field::layers);
  if (auto const* const number = std::get_if<int>(&layers)) sheet.layers = *number;
  sheet.detail = detail_of(read(object, field::detail));
  return sheet;
}

ScreenPlacement read_placement(InputObject const& object) {
  constexpr double degree = std::numbers::pi / 180.0;
  return {read(object, field::tile_origin_u), read(object, field::tile_origin_v),
          read(object, field::tile_rotation) * degree};
}

std::shared_ptr<ScreenMaker> read_maker(InputObject const& object, AssetFolder const& folder) {
  // In the order of the fields, so that a missing or extra comma is reported at the first wrong
  // field.
  auto holes = read_holes(object, folder);
  auto const sheet = read_sheet(object);
  auto const placement = read_placement(object);
  return std::make_shared<ScreenMaker>(object.name, object.where(), std::move(holes), sheet,
                                       placement);
}

void add_object(InputObject const& object, ShadingInput const& input,
                TransparentShades const& shades, AssetFolder const& folder,
                PerforatedScreens& screens) {
  auto const maker = read_maker(object, folder);
  auto const pattern = read(object, field::surface_name);
  bool found = false;
  auto const refuse = [&](std::string const& surface, std::string const& other) {
    throw Error(fmt::format("{} {}: {} is named by {} already", field::surface_name.title,
                            in_quotes(pattern), surface, other));
  };
  for_each_match(input.shading_surfaces, pattern, [&](auto const& entry) {
    auto const& surface = entry.first;
    found = true;
    auto const shade = shades.by_surface.find(surface);
    if (shade != shades.by_surface.end()) {
      refuse(surface,
             fmt::format("{} {}", extension::transparent_shade::type, shade->second.object));
    }
    auto const [place, added] = screens.by_surface.try_emplace(
        surface, SurfaceScreen{maker, upper(read(object, field::deployment_schedule_name))});
    if (!added) refuse(surface, place->second.maker->object());
  });
  if (!found) throw no_shading_surface(field::surface_name.title, pattern, input);
}

}  // namespace

std::vector<std::string> PerforatedScreens::warnings() const {
  std::set<std::string> lines;  // an object may name several surfaces
  for (auto const& [surface, screen] : by_surface) {
    lines.insert(screen.maker->warnings().begin(), screen.maker->warnings().end());
  }
  return {lines.begin(), lines.end()};
}

PerforatedScreens read_perforated_screens(std::vector<InputObject> const& objects,
                                          ShadingInput const& input,
                                          TransparentShades const& shades,
                                          AssetFolder const& folder) {
  PerforatedScreens screens;
  for (auto const& object : objects) {
    if (object.type != field::type) continue;
    try {
      add_object(object, input, shades, folder, screens);
    } catch (Error const& error) {
      throw screen_error(object.where(), error.what());
    }
  }
  return screens;
}

}  // namespace gpu_shading::energyplus
