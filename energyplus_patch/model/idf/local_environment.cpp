#include "model/idf/local_environment.h"

namespace gpu_shading::energyplus {

NewObject environment_object(LocalEnvironment const& environment) {
  return {local_environment,
          {{"name", environment.name},
           {"exterior_surface_name", environment.surface},
           {"sunlit_fraction_schedule_name", environment.sunlit_schedule},
           {"surrounding_surfaces_object_name", environment.surroundings},
           {"outdoor_air_node_name", ""},
           {"ground_surfaces_object_name", environment.ground}}};
}

NewObject ground_object(std::string const& name, GroundSurface const& ground) {
  return {"SurfaceProperty:GroundSurfaces",
          {{"name", name}},
          "ground_surfaces",
          {{{"ground_surface_name", "GROUND"},
            {"ground_surface_view_factor", ground.view},
            {"ground_surface_temperature_schedule_name", ground.temperature_schedule},
            {"ground_surface_reflectance_schedule_name", ground.reflectance_schedule}}}};
}

}  // namespace gpu_shading::energyplus
