#include "model/input/plausible_lengths.h"

#include <fmt/format.h>

#include <functional>
#include <string_view>

#include "model/extensions/extension_fields.h"
#include "platform/text.h"

namespace gpu_shading::energyplus {
namespace {

namespace screen = extension::perforated_screen;
namespace site = extension::site_context;
namespace tree = extension::tree;
namespace modules = extension::pvmodules;

struct PlausibleLength {
  std::string_view type;
  std::reference_wrapper<FieldInfo const> field;
  double max;  // m
};

std::vector<PlausibleLength> const& plausible_lengths() {
  static std::vector<PlausibleLength> const lengths{
      {screen::type, screen::hole_size, 1.0},
      {screen::type, screen::hole_length, 1.0},
      {screen::type, screen::pitch, 1.0},
      {screen::type, screen::row_pitch, 1.0},
      {screen::type, screen::tile_width, 100.0},
      {screen::type, screen::tile_height, 100.0},
      {site::type, site::storey_height, 20.0},
      {site::type, site::default_height, 1000.0},
      {tree::type, tree::height, 130.0},
      {tree::type, tree::crown_diameter, 70.0},
      {tree::type, tree::crown_base_height, 100.0},
      {tree::type, tree::trunk_diameter, 12.0},
      {modules::type, modules::module_width, 10.0},
      {modules::type, modules::module_length, 10.0},
      {modules::type, modules::frame_width, 0.5},
      {modules::type, modules::gap, 1.0},
  };
  return lengths;
}

}  // namespace

std::vector<std::string> warn_of_lengths(std::vector<InputObject> const& objects) {
  std::vector<std::string> lines;
  for (auto const& object : objects) {
    for (auto const& [type, field, max] : plausible_lengths()) {
      if (object.type != type) continue;
      auto const value = parse_number(object[field.get().key]);
      if (!value || *value <= max) continue;
      lines.push_back(fmt::format("{}: {} is {} m, more than {} m: {}", object.title(),
                                  field.get().title, *value, max,
                                  ask_for_units(field, *value, max)));
    }
  }
  return lines;
}

}  // namespace gpu_shading::energyplus
