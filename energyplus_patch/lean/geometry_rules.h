#pragma once

#include <glm/vec3.hpp>
#include <string>
#include <unordered_map>
#include <vector>

#include "gpu_shading/scene.h"
#include "input/input_object.h"

namespace gpu_shading::energyplus {

// How a model's vertices become EnergyPlus's: GlobalGeometryRules, Building and Zone. Angles in
// degrees clockwise from north, lengths in metres. Found by comparing with the vertices that
// EnergyPlus hands over (tests/energyplus/test_lean.py).
struct GeometryRules {
  struct Zone {
    double direction = 0.0;  // of its relative north, from the building's
    glm::dvec3 origin{0.0};
  };

  int first_corner = 0;  // of the vertices as written: places after the upper left corner
  bool clockwise = false;
  bool relative = false;  // else world coordinates: neither building nor zones turn them
  double north_axis = 0.0;
  std::unordered_map<std::string, Zone> zones;  // upper-case names
};

// Throws Error, naming object, field and value, where they cannot be understood.
GeometryRules read_geometry_rules(std::vector<InputObject> const& objects);

// What shading surfaces are attached to, which is what turns and moves them.
enum class Attachment {
  site,      // nothing
  building,  // turned by the building's north axis
  zone,      // placed in a zone
};

// The outline that EnergyPlus makes of an object's vertices: counter-clockwise from the upper left
// corner, in world axes, less those of neighbours within 1 cm that EnergyPlus drops. (It also drops
// vertices on the straight line between their neighbours, which changes no shadow; they are kept.)
// Rounded to the single precision of what EnergyPlus hands over, so that what touches a wall still
// does. `zone` counts only for Attachment::zone.
Ring to_world(GeometryRules const& rules, Ring vertices, Attachment attachment,
              GeometryRules::Zone const& zone = {});

}  // namespace gpu_shading::energyplus
