#include "input/transparent_shades.h"

#include <fmt/format.h>

#include "gpu_shading/error.h"
#include "input/glazing_construction.h"
#include "input/name_pattern.h"
#include "input/naming.h"
#include "input/number.h"

namespace gpu_shading::energyplus {
namespace {

std::vector<double> numbers(std::vector<std::string> const& texts) {
  std::vector<double> result;
  for (auto const& text : texts) {
    auto const value = parse_number(text);
    if (!value)
      throw Error(fmt::format("Value {} is \"{}\", not a number", result.size() + 1, text));
    result.push_back(*value);
  }
  return result;
}

std::string const& only_value(std::vector<std::string> const& values, std::string_view what) {
  if (values.size() != 1) {
    throw Error(fmt::format("{} values, expected one: {}", values.size(), what));
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

struct Made {
  Transmittance transmittance;
  std::string description;
};

Made make(std::string const& model, std::vector<std::string> const& values,
          std::vector<InputObject> const& objects, std::filesystem::path const& folder,
          std::vector<std::string>& warnings) {
  if (same_name(model, "Constant")) {
    only_value(values, "the transmittance");
    auto const value = numbers(values).front();
    return {Transmittance::constant(value), fmt::format("constant {}", value)};
  }
  if (same_name(model, "PolynomialInDegrees")) {
    return {Transmittance::polynomial_in_degrees(numbers(values)), "polynomial in the angle"};
  }
  if (same_name(model, "PolynomialInCosine")) {
    return {Transmittance::polynomial_in_cosine(numbers(values)), "polynomial in the cosine"};
  }
  if (same_name(model, "Table")) return {from_table(numbers(values)), "table"};
  if (same_name(model, "TableFile")) {
    auto const& file = only_value(values, "the file's name");
    return {read_angular_csv(folder / file), fmt::format("table {}", file)};
  }
  if (same_name(model, "Construction")) {
    auto const& name = only_value(values, "the construction's name");
    return {construction_transmittance(objects, name, warnings),
            fmt::format("construction {}", name)};
  }
  throw Error(
      fmt::format("Transmittance Model is \"{}\", expected Constant, PolynomialInDegrees, "
                  "PolynomialInCosine, Table, TableFile or Construction",
                  model));
}

// Blank fields at the end of an IDF object mean nothing.
std::vector<std::string> without_blank_end(std::vector<std::string> values) {
  while (!values.empty() && values.back().empty()) values.pop_back();
  return values;
}

void add_object(InputObject const& object, std::vector<InputObject> const& objects,
                ShadingInput const& input, std::filesystem::path const& folder,
                TransparentShades& shades) {
  auto made = make(object["transmittance_model"], without_blank_end(object.list), objects, folder,
                   shades.warnings);
  auto const transmittance = std::make_shared<Transmittance const>(std::move(made.transmittance));
  auto const& pattern = object["surface_name"];
  bool found = false;
  for (auto const& [surface, unused] : input.shading_surfaces) {
    if (!matches(pattern, surface)) continue;
    found = true;
    auto const [place, added] = shades.by_surface.try_emplace(
        surface, TransparentShade{object.name, made.description, transmittance});
    if (!added) {
      throw Error(fmt::format("Surface Name \"{}\": {} is named by {} already", pattern, surface,
                              place->second.object));
    }
  }
  if (!found) {
    throw Error(fmt::format("Surface Name is \"{}\", which no shading surface of the model matches",
                            pattern));
  }
}

}  // namespace

TransparentShades read_transparent_shades(std::vector<InputObject> const& objects,
                                          ShadingInput const& input,
                                          std::filesystem::path const& folder) {
  TransparentShades shades;
  for (auto const& object : objects) {
    if (object.type != "GPUShading:TransparentShade") continue;
    naming(object.title(), [&] { add_object(object, objects, input, folder, shades); });
  }
  return shades;
}

}  // namespace gpu_shading::energyplus
