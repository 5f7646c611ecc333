#include "model/input/transparent_shades.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <utility>

#include "gpu_shading/error.h"
#include "gpu_shading/transmittance.h"
#include "model/extensions/extension_fields.h"
#include "model/idf/fields.h"
#include "platform/named_entries.h"
#include "platform/naming.h"
#include "platform/text.h"

namespace gpu_shading::energyplus {
namespace {

namespace field = extension::transparent_shade;

std::vector<double> numbers(std::vector<std::string> const& texts) {
  std::vector<double> result;
  for (auto const& text : texts) {
    auto const value = parse_number(text);
    if (!value || !std::isfinite(*value)) {
      throw Error(fmt::format("{} {} is {}, expected a number", field::value.title,
                              result.size() + 1, in_quotes(text)));
    }
    result.push_back(*value);
  }
  return result;
}

std::string first_value() { return fmt::format("{} 1", field::value.title); }

std::string all_values(std::size_t count) {
  return count < 2 ? first_value() : fmt::format("{} to {}", first_value(), count);
}

std::string const& only_value(std::vector<std::string> const& values, std::string_view what) {
  if (values.size() != 1) {
    throw Error(fmt::format("{} values, expected one: {}; numbers take a decimal point",
                            values.size(), what));
  }
  return values.front();
}

Transmittance from_table(std::vector<double> const& values) {
  if (values.size() % 2 != 0) {
    throw Error(fmt::format("{} values, expected pairs of angle (degrees) and transmittance",
                            values.size()));
  }
  std::vector<double> angles;
  std::vector<double> transmittances;
  for (std::size_t i = 0; i < values.size(); i += 2) {
    angles.push_back(values[i]);
    transmittances.push_back(values[i + 1]);
  }
  return Transmittance::table(std::move(angles), std::move(transmittances));
}

// What `make` returns for the numbers; its errors name their fields.
template <typename Make>
Transmittance from_numbers(std::vector<std::string> const& values, Make const& make) {
  auto const given = numbers(values);
  return naming(all_values(given.size()), [&] { return make(given); });
}

struct Made {
  Transmittance transmittance;
  std::string description;
  std::optional<Transmittance> visible = std::nullopt;  // none: the same
};

Made make(field::TransmittanceModel model, std::vector<std::string> const& values,
          std::vector<InputObject> const& objects, std::filesystem::path const& folder,
          std::vector<std::string>& warnings) {
  using enum field::TransmittanceModel;
  switch (model) {
    case constant: {
      only_value(values, "the transmittance");
      auto const value = numbers(values).front();
      return {naming(first_value(), [&] { return Transmittance::constant(value); }),
              fmt::format("constant {}", value)};
    }
    case polynomial_in_degrees:
      return {from_numbers(values, Transmittance::polynomial_in_degrees),
              "polynomial in the angle"};
    case polynomial_in_cosine:
      return {from_numbers(values, Transmittance::polynomial_in_cosine),
              "polynomial in the cosine"};
    case table:
      return {from_numbers(values, from_table), "table"};
    case table_file: {
      auto const& file = only_value(values, "the file's name");
      return {naming(first_value(), [&] { return read_angular_csv(folder / file); }),
              fmt::format("table {}", file)};
    }
    case construction:
      break;
  }
  auto const& name = only_value(values, "the construction's name");
  auto glazing = construction_transmittance(objects, name, warnings);
  return {std::move(glazing.solar), fmt::format("construction {}", name),
          std::move(glazing.visible)};
}

void add_object(InputObject const& object, std::vector<InputObject> const& objects,
                ShadingInput const& input, std::filesystem::path const& folder,
                TransparentShades& shades) {
  auto made = make(read(object, field::transmittance_model), read(object, field::value), objects,
                   folder, shades.warnings);
  auto const transmittance = std::make_shared<Transmittance const>(std::move(made.transmittance));
  auto const visible = made.visible
                           ? std::make_shared<Transmittance const>(std::move(*made.visible))
                           : transmittance;
  add_filter(field::surface_name.title, read(object, field::surface_name),
             {object.name, fmt::format("transparent ({})", made.description),
              AngularTransmittance{transmittance}, AngularTransmittance{visible},
              read(object, field::transmittance_model) == field::TransmittanceModel::construction},
             input, shades);
}

}  // namespace

TransparentShades read_transparent_shades(std::vector<InputObject> const& objects,
                                          ShadingInput const& input,
                                          std::filesystem::path const& folder) {
  TransparentShades shades;
  for_each_of(objects, field::type, [&](InputObject const& object) {
    add_object(object, objects, input, folder, shades);
  });
  return shades;
}

void add_filter(std::string_view field, std::string const& pattern, TransparentShade const& filter,
                ShadingInput const& input, TransparentShades& shades) {
  bool found = false;
  for_each_match(input.shading_surfaces, pattern, [&](auto const& entry) {
    auto const& surface = entry.first;
    found = true;
    auto const [place, added] = shades.by_surface.try_emplace(surface, filter);
    if (!added) {
      throw Error(fmt::format("{} {}: {} is named by {} already", field, in_quotes(pattern),
                              surface, place->second.object));
    }
  });
  if (!found) throw no_shading_surface(field, pattern, input);
}

}  // namespace gpu_shading::energyplus
