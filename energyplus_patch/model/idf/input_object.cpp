#include "model/idf/input_object.h"

#include "platform/text.h"

namespace gpu_shading::energyplus {

std::string const& InputObject::operator[](std::string_view field) const {
  static std::string const blank;
  auto const found = fields.find(field);
  return found == fields.end() ? blank : found->second;
}

std::string InputObject::title() const { return name.empty() ? type : type + " " + name; }

std::string InputObject::where() const { return file.empty() ? title() : file + ": " + title(); }

std::vector<ObjectType> const& known_types() {
  // Field names and their order: EnergyPlus's Energy+.schema.epJSON.
  static std::vector<ObjectType> const types{
      {"Version", {"version_identifier"}},
      {"Building",
       {"name", "north_axis", "terrain", "loads_convergence_tolerance_value",
        "temperature_convergence_tolerance_value", "solar_distribution"}},
      {"SimulationControl",
       {"do_zone_sizing_calculation", "do_system_sizing_calculation", "do_plant_sizing_calculation",
        "run_simulation_for_sizing_periods", "run_simulation_for_weather_file_run_periods"}},
      {"Site:Location", {"name", "latitude", "longitude", "time_zone", "elevation"}},
      {"RunPeriod",
       {"name", "begin_month", "begin_day_of_month", "begin_year", "end_month", "end_day_of_month",
        "end_year", "day_of_week_for_start_day", "use_weather_file_holidays_and_special_days",
        "use_weather_file_daylight_saving_period"}},
      {"RunPeriodControl:DaylightSavingTime", {"start_date", "end_date"}},
      {"GlobalGeometryRules",
       {"starting_vertex_position", "vertex_entry_direction", "coordinate_system"}},
      {"GeometryTransform", {"plane_of_transform", "current_aspect_ratio", "new_aspect_ratio"}},
      {"Compliance:Building", {"building_rotation_for_appendix_g"}},
      {"Zone", {"name", "direction_of_relative_north", "x_origin", "y_origin", "z_origin"}},
      {"ShadowCalculation",
       {"shading_calculation_method", "shading_calculation_update_frequency_method",
        "shading_calculation_update_frequency", "maximum_figures_in_shadow_overlap_calculations",
        "polygon_clipping_algorithm", "pixel_counting_resolution", "sky_diffuse_modeling_algorithm",
        "output_external_shading_calculation_results",
        "disable_self_shading_within_shading_zone_groups",
        "disable_self_shading_from_shading_zone_groups_to_other_zones"},
       "shading_zone_groups",
       "shading_zone_group_zonelist_name"},
      {"ZoneList", {"name"}, "zones", "zone_name"},
      {"BuildingSurface:Detailed",
       {"name", "surface_type", "construction_name", "zone_name", "space_name",
        "outside_boundary_condition"}},
      {"Wall:Detailed",
       {"name", "construction_name", "zone_name", "space_name", "outside_boundary_condition"}},
      {"RoofCeiling:Detailed",
       {"name", "construction_name", "zone_name", "space_name", "outside_boundary_condition"}},
      {"Floor:Detailed",
       {"name", "construction_name", "zone_name", "space_name", "outside_boundary_condition"}},
      {"Wall:Exterior", {"name", "construction_name", "zone_name"}},
      {"Roof", {"name", "construction_name", "zone_name"}},
      {"Wall:Adiabatic", {"name", "construction_name", "zone_name"}},
      {"Wall:Underground", {"name", "construction_name", "zone_name"}},
      {"Wall:Interzone", {"name", "construction_name", "zone_name"}},
      {"Ceiling:Adiabatic", {"name", "construction_name", "zone_name"}},
      {"Ceiling:Interzone", {"name", "construction_name", "zone_name"}},
      {"Floor:GroundContact", {"name", "construction_name", "zone_name"}},
      {"Floor:Adiabatic", {"name", "construction_name", "zone_name"}},
      {"Floor:Interzone", {"name", "construction_name", "zone_name"}},
      {"FenestrationSurface:Detailed",
       {"name", "surface_type", "construction_name", "building_surface_name"}},
      {"Window", {"name", "construction_name", "building_surface_name"}},
      {"GlazedDoor", {"name", "construction_name", "building_surface_name"}},
      {"Door", {"name", "construction_name", "building_surface_name"}},
      {"Shading:Site", {"name"}},
      {"Shading:Building", {"name"}},
      {"Shading:Site:Detailed",
       {"name", "transmittance_schedule_name", "number_of_vertices"},
       "vertices"},
      {"Shading:Building:Detailed",
       {"name", "transmittance_schedule_name", "number_of_vertices"},
       "vertices"},
      {"Shading:Overhang", {"name"}},
      {"Shading:Overhang:Projection", {"name"}},
      {"Shading:Fin", {"name"}},
      {"Shading:Fin:Projection", {"name"}},
      {"Shading:Zone:Detailed",
       {"name", "base_surface_name", "transmittance_schedule_name", "number_of_vertices"},
       "vertices"},
      {"ShadingProperty:Reflectance",
       {"shading_surface_name", "diffuse_solar_reflectance_of_unglazed_part_of_shading_surface",
        "diffuse_visible_reflectance_of_unglazed_part_of_shading_surface",
        "fraction_of_shading_surface_that_is_glazed", "glazing_construction_name"}},
      {"Generator:Photovoltaic", {"name", "surface_name"}},
      {"Generator:PVWatts",
       {"name", "pvwatts_version", "dc_system_capacity", "module_type", "array_type",
        "system_losses", "array_geometry_type", "tilt_angle", "azimuth_angle", "surface_name"}},
      {"SolarCollector:FlatPlate:Water",
       {"name", "solarcollectorperformance_name", "surface_name"}},
      {"SolarCollector:FlatPlate:PhotovoltaicThermal", {"name", "surface_name"}},
      {"SolarCollector:IntegralCollectorStorage",
       {"name", "integralcollectorstorageparameters_name", "surface_name"}},
      {"DaylightingDevice:Shelf",
       {"name", "window_name", "inside_shelf_name", "outside_shelf_name"}},
      {"DaylightingDevice:Tubular", {"name"}},
      {"DaylightingDevice:LightWell", {}},
      {"Daylighting:Controls", {"name", "zone_or_space_name", "daylighting_method"}},
      {"Daylighting:DELight:ComplexFenestration", {"name"}},
      {"Construction:ComplexFenestrationState", {"name"}},
      {"PythonPlugin:Instance", {"name"}},
      {"SurfaceProperty:LocalEnvironment", {"name", "exterior_surface_name"}},
      {"Output:Surfaces:Drawing", {}},
      {"Output:Variable", {"key_value", "variable_name"}},
      {"Output:Table:TimeBins", {"key_value", "variable_name"}},
      {"Output:Table:Monthly",
       {"name", "digits_after_decimal"},
       "variable_details",
       "variable_or_meter_name"},
      {"Output:Table:Annual",
       {"name", "filter", "schedule_name"},
       "variable_details",
       "variable_or_meter_or_ems_variable_or_field_name"},
      {"EnergyManagementSystem:Actuator",
       {"name", "actuated_component_unique_name", "actuated_component_type"}},
      {"EnergyManagementSystem:Sensor",
       {"name", "output_variable_or_output_meter_index_key_name",
        "output_variable_or_output_meter_name"}},
      {"Construction", {"name"}, "layers", "layer"},
      {"WindowMaterial:Glazing",
       {"name", "optical_data_type", "window_glass_spectral_data_set_name", "thickness",
        "solar_transmittance_at_normal_incidence",
        "front_side_solar_reflectance_at_normal_incidence",
        "back_side_solar_reflectance_at_normal_incidence",
        "visible_transmittance_at_normal_incidence",
        "front_side_visible_reflectance_at_normal_incidence",
        "back_side_visible_reflectance_at_normal_incidence",
        "infrared_transmittance_at_normal_incidence",
        "front_side_infrared_hemispherical_emissivity",
        "back_side_infrared_hemispherical_emissivity", "conductivity",
        "dirt_correction_factor_for_solar_and_visible_transmittance", "solar_diffusing"}},
      {"WindowMaterial:Gas", {"name"}},
      {"WindowMaterial:GasMixture", {"name"}},
      {"WindowMaterial:SimpleGlazingSystem",
       {"name", "u_factor", "solar_heat_gain_coefficient", "visible_transmittance"}},
  };
  return types;
}

ObjectType const* find_type(std::string_view type) {
  for (auto const& known : known_types()) {
    if (same_name(known.type, type)) return &known;
  }
  return nullptr;
}

bool is_extension(std::string_view type) {
  return type.size() > extension_prefix.size() &&
         same_name(type.substr(0, extension_prefix.size()), extension_prefix);
}

}  // namespace gpu_shading::energyplus
