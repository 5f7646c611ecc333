#include "input/perforated_screens.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <set>
#include <utility>

#include "gpu_shading/error.h"
#include "input/fields.h"
#include "input/name_pattern.h"
#include "input/naming.h"
#include "input/number.h"

namespace gpu_shading::energyplus {
namespace {

constexpr std::string_view type = "GPUShading:PerforatedScreen";

constexpr Field hole_shape{"hole_shape", "Hole Shape"};
constexpr Field texture_file_name{"texture_file_name", "Texture File Name"};
constexpr Field arrangement{"arrangement", "Arrangement"};
constexpr Field hole_size{"hole_size", "Hole Size"};
constexpr Field hole_length{"hole_length", "Hole Length"};
constexpr Field pitch{"pitch", "Pitch"};
constexpr Field row_pitch{"row_pitch", "Row Pitch"};
constexpr Field thickness{"thickness", "Thickness"};
constexpr Field sheet_plane{"sheet_plane", "Sheet Plane"};
constexpr Field layers{"layers", "Layers"};
constexpr Field opacity{"opacity", "Opacity"};
constexpr Field opacity_threshold{"opacity_threshold", "Opacity Threshold"};
constexpr Field invert_opacity{"invert_opacity", "Invert Opacity"};
constexpr Field tile_width{"tile_width", "Tile Width"};
constexpr Field tile_height{"tile_height", "Tile Height"};
constexpr Field tile_origin_u{"tile_origin_u", "Tile Origin U"};
constexpr Field tile_origin_v{"tile_origin_v", "Tile Origin V"};
constexpr Field tile_rotation{"tile_rotation", "Tile Rotation"};
constexpr Field detail{"detail", "Detail"};

// m: beyond these it is no sheet of metal, no cloth.
constexpr double longest_hole = 1.0;
constexpr double longest_tile = 100.0;

double needed_length(InputObject const& object, Field const& field) {
  auto const value = number(object, field);
  if (!value) throw Error(fmt::format("{} is blank, expected a length in m", field.title));
  return *value;
}

HolePattern read_pattern(InputObject const& object, Hole hole) {
  auto const shape = fmt::format("with Hole Shape {}", object[hole_shape.name]);
  expect_blank(
      object,
      {texture_file_name, opacity, opacity_threshold, invert_opacity, tile_width, tile_height},
      shape);
  Perforation perforation;
  perforation.hole = hole;
  perforation.arrangement = choice(object, arrangement,
                                   {Key<Arrangement>{"Straight", Arrangement::Straight},
                                    {"Staggered45", Arrangement::Staggered45},
                                    {"Staggered60", Arrangement::Staggered60}},
                                   Arrangement::Staggered60);
  perforation.size = needed_length(object, hole_size);
  if (hole == Hole::Slotted) {
    perforation.length = needed_length(object, hole_length);
  } else {
    expect_blank(object, {hole_length}, shape);
  }
  perforation.pitch = needed_length(object, pitch);
  if (auto const rows = number(object, row_pitch)) {
    // 0 would stand for blank.
    if (*rows == 0.0) throw Error("Row Pitch is 0 m, expected more than 0");
    perforation.row_pitch = *rows;
  }
  return HolePattern(perforation);
}

ScreenTexture read_texture(InputObject const& object, std::filesystem::path const& folder) {
  expect_blank(object, {arrangement, hole_size, hole_length, pitch, row_pitch},
               "with Hole Shape Texture");
  ScreenTexture texture;
  texture.name = object[texture_file_name.name];
  if (texture.name.empty()) {
    throw Error("Texture File Name is blank, expected the name of an image");
  }
  texture.path = folder / texture.name;
  texture.info = naming(texture_file_name.title, [&] { return probe_texture(texture.path); });
  bool const fractional =
      choice(object, opacity, {Key<bool>{"Threshold", false}, {"Fractional", true}}, false);
  auto const threshold = number(object, opacity_threshold);
  if (fractional) {
    expect_blank(object, {opacity_threshold}, "with Opacity Fractional");
    texture.threshold.reset();
  } else if (threshold) {
    texture.threshold = threshold;
  }
  texture.invert = choice(object, invert_opacity, {Key<bool>{"Yes", true}, {"No", false}}, false);
  texture.width = number(object, tile_width);
  texture.height = number(object, tile_height);
  return texture;
}

ScreenMaker::Holes read_holes(InputObject const& object, std::filesystem::path const& folder) {
  auto const hole = choice(object, hole_shape,
                           {Key<std::optional<Hole>>{"Texture", std::nullopt},
                            {"Round", Hole::Round},
                            {"Square", Hole::Square},
                            {"Slotted", Hole::Slotted},
                            {"Hexagonal", Hole::Hexagonal}});
  if (hole) return read_pattern(object, *hole);
  return read_texture(object, folder);
}

std::optional<int> read_layers(InputObject const& object) {
  auto const& text = object[layers.name];
  if (text.empty() || same_name(text, "Auto")) return std::nullopt;
  auto const value = parse_number(text);
  constexpr double most = 64;
  if (!value || *value != std::floor(*value) || *value < 1 || *value > most) {
    throw Error(
        fmt::format("Layers is \"{}\", expected Auto or a whole number from 1 to {}", text, most));
  }
  return static_cast<int>(*value);
}

Sheet read_sheet(InputObject const& object) {
  Sheet sheet;
  sheet.thickness = needed_length(object, thickness);
  sheet.plane = choice(object, sheet_plane,
                       {Key<SheetPlane>{"Centre", SheetPlane::centre},
                        {"Outside", SheetPlane::outside},
                        {"Inside", SheetPlane::inside}},
                       SheetPlane::centre);
  sheet.layers = read_layers(object);
  sheet.detail = choice(object, detail,
                        {Key<ScreenDetail>{"Auto", ScreenDetail::automatic},
                         {"Holes", ScreenDetail::holes},
                         {"Effective", ScreenDetail::effective}},
                        ScreenDetail::automatic);
  return sheet;
}

ScreenPlacement read_placement(InputObject const& object) {
  constexpr double degree = std::numbers::pi / 180.0;
  return {number(object, tile_origin_u).value_or(0.0), number(object, tile_origin_v).value_or(0.0),
          number(object, tile_rotation).value_or(0.0) * degree};
}

std::shared_ptr<ScreenMaker> read_maker(InputObject const& object,
                                        std::filesystem::path const& folder) {
  // In the order of the fields: where a comma is missing or too many, the first one is told.
  auto holes = read_holes(object, folder);
  auto const sheet = read_sheet(object);
  auto const placement = read_placement(object);
  return std::make_shared<ScreenMaker>(object.name, std::move(holes), sheet, placement);
}

void add_object(InputObject const& object, ShadingInput const& input,
                TransparentShades const& shades, std::filesystem::path const& folder,
                PerforatedScreens& screens) {
  auto const maker = read_maker(object, folder);
  auto const& pattern = object["surface_name"];
  bool found = false;
  auto const refuse = [&](std::string const& surface, std::string const& other) {
    throw Error(
        fmt::format("Surface Name \"{}\": {} is named by {} already", pattern, surface, other));
  };
  for (auto const& [surface, unused] : input.shading_surfaces) {
    if (!matches(pattern, surface)) continue;
    found = true;
    auto const shade = shades.by_surface.find(surface);
    if (shade != shades.by_surface.end()) {
      refuse(surface, "GPUShading:TransparentShade " + shade->second.object);
    }
    auto const [place, added] = screens.by_surface.try_emplace(
        surface, SurfaceScreen{maker, upper(object["deployment_schedule_name"])});
    if (!added) refuse(surface, place->second.maker->object());
  }
  if (!found) {
    throw Error(fmt::format("Surface Name is \"{}\", which no shading surface of the model matches",
                            pattern));
  }
}

}  // namespace

std::vector<std::string> PerforatedScreens::warnings() const {
  // An object has several surfaces.
  std::set<std::string> lines(odd_lengths.begin(), odd_lengths.end());
  for (auto const& [surface, screen] : by_surface) {
    lines.insert(screen.maker->warnings().begin(), screen.maker->warnings().end());
  }
  return {lines.begin(), lines.end()};
}

PerforatedScreens read_perforated_screens(std::vector<InputObject> const& objects,
                                          ShadingInput const& input,
                                          TransparentShades const& shades,
                                          std::filesystem::path const& folder) {
  PerforatedScreens screens;
  for (auto const& object : objects) {
    if (object.type != type) continue;
    try {
      add_object(object, input, shades, folder, screens);
      auto const odd = lengths_beyond(object, {{hole_size, longest_hole},
                                               {hole_length, longest_hole},
                                               {pitch, longest_hole},
                                               {row_pitch, longest_hole},
                                               {tile_width, longest_tile},
                                               {tile_height, longest_tile}});
      screens.odd_lengths.insert(screens.odd_lengths.end(), odd.begin(), odd.end());
    } catch (Error const& error) {
      throw screen_error(object.name, error.what());
    }
  }
  return screens;
}

}  // namespace gpu_shading::energyplus
