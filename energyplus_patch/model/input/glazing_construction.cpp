#include <fmt/format.h>

#include "gpu_shading/error.h"
#include "model/input/transparent_shades.h"
#include "platform/text.h"

namespace gpu_shading::energyplus {
namespace {

InputObject const* find(std::vector<InputObject> const& objects, std::string_view type_prefix,
                        std::string const& name) {
  for (auto const& object : objects) {
    if (std::string_view(object.type).starts_with(type_prefix) && same_name(object.name, name)) {
      return &object;
    }
  }
  return nullptr;
}

double number(InputObject const& object, std::string const& field, std::string_view title,
              double low, double high) {
  auto const value = parse_number(object[field]);
  if (!value || *value < low || *value > high) {
    throw Error(fmt::format("{} {}: {} is \"{}\", expected {} to {}", object.type, object.name,
                            title, object[field], low, high));
  }
  return *value;
}

// The panes of a construction for solar radiation and for light.
struct Panes {
  std::vector<GlassLayer> solar;
  std::vector<GlassLayer> visible;
};

// Adds a pane. As in EnergyPlus, dirt lowers the transmittance at normal incidence of the outer
// pane, from which its angular properties follow, and inner panes are clean.
void add_pane(InputObject const& material, Panes& panes, std::vector<std::string>& warnings) {
  if (!same_name(material["optical_data_type"], "SpectralAverage")) {
    throw Error(
        fmt::format("{} {}: Optical Data Type is \"{}\": only SpectralAverage can be used for a "
                    "shade; give its "
                    "angular transmittance as a table",
                    material.type, material.name, material["optical_data_type"]));
  }
  auto const& field = [&](std::string const& name, std::string_view title) {
    return number(material, name, title, 0.0, 1.0);
  };
  GlassLayer pane{
      field("solar_transmittance_at_normal_incidence", "Solar Transmittance at Normal Incidence"),
      field("front_side_solar_reflectance_at_normal_incidence",
            "Front Side Solar Reflectance at Normal Incidence"),
      field("back_side_solar_reflectance_at_normal_incidence",
            "Back Side Solar Reflectance at Normal Incidence")};
  GlassLayer visible = pane;
  if (!material["visible_transmittance_at_normal_incidence"].empty()) {
    visible = {field("visible_transmittance_at_normal_incidence",
                     "Visible Transmittance at Normal Incidence"),
               field("front_side_visible_reflectance_at_normal_incidence",
                     "Front Side Visible Reflectance at Normal Incidence"),
               field("back_side_visible_reflectance_at_normal_incidence",
                     "Back Side Visible Reflectance at Normal Incidence")};
  }
  std::string const dirt_field = "dirt_correction_factor_for_solar_and_visible_transmittance";
  if (!material[dirt_field].empty()) {
    double const dirt =
        field(dirt_field, "Dirt Correction Factor for Solar and Visible Transmittance");
    if (panes.solar.empty()) {
      pane.transmittance *= dirt;
      visible.transmittance *= dirt;
    }
  }
  panes.solar.push_back(pane);
  panes.visible.push_back(visible);
  if (same_name(material["solar_diffusing"], "Yes")) {
    warnings.push_back(
        fmt::format("{} {}: Solar Diffusing is Yes, but a shade transmits the beam undeviated: "
                    "scattering is not modelled",
                    material.type, material.name));
  }
}

SimpleGlazing rating(InputObject const& material) {
  return {number(material, "u_factor", "U-Factor", 1e-6, 7.0),
          number(material, "solar_heat_gain_coefficient", "Solar Heat Gain Coefficient", 1e-6,
                 0.999999)};
}

GlazingTransmittance rated(InputObject const& material) {
  auto const solar = Transmittance::glazing(rating(material));
  auto visible = solar;
  if (!material["visible_transmittance"].empty()) {
    visible = Transmittance::with_normal(
        solar, number(material, "visible_transmittance", "Visible Transmittance", 0.0, 1.0));
  }
  return {Transmittance::fitted_in_cosine(solar), Transmittance::fitted_in_cosine(visible)};
}

// What a construction is made of.
struct Glazing {
  Panes panes;
  InputObject const* rated = nullptr;  // in their place
};

Glazing glazing_of(std::vector<InputObject> const& objects, std::string const& name,
                   std::vector<std::string>& warnings) {
  auto const* const construction = find(objects, "Construction", name);
  if (construction == nullptr) throw Error(fmt::format("there is no Construction \"{}\"", name));
  Glazing glazing;
  for (auto const& layer : construction->list) {
    if (layer.empty()) continue;
    auto const* const material = find(objects, "WindowMaterial:", layer);
    if (material == nullptr) {
      throw Error(fmt::format(
          "Construction {}: layer \"{}\" cannot be used for a shade, expected "
          "WindowMaterial:Glazing, WindowMaterial:Gas or WindowMaterial:SimpleGlazingSystem",
          construction->name, layer));
    }
    if (material->type == "WindowMaterial:SimpleGlazingSystem") return {{}, material};
    if (material->type == "WindowMaterial:Glazing") add_pane(*material, glazing.panes, warnings);
  }
  if (glazing.panes.solar.empty()) {
    throw Error(fmt::format("Construction {}: has no glazing layer", construction->name));
  }
  return glazing;
}

}  // namespace

GlazingTransmittance construction_transmittance(std::vector<InputObject> const& objects,
                                                std::string const& name,
                                                std::vector<std::string>& warnings) {
  auto const [panes, material] = glazing_of(objects, name, warnings);
  if (material != nullptr) return rated(*material);
  return {Transmittance::fitted_in_cosine(Transmittance::glazing(panes.solar)),
          Transmittance::fitted_in_cosine(Transmittance::glazing(panes.visible))};
}

double construction_reflectance(std::vector<InputObject> const& objects, std::string const& name) {
  std::vector<std::string> scattering;
  auto const [panes, material] = glazing_of(objects, name, scattering);
  return material != nullptr ? normal_reflectance(rating(*material))
                             : normal_reflectance(panes.solar);
}

}  // namespace gpu_shading::energyplus
