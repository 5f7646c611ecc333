#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "gpu_shading/scene.h"
#include "model/idf/input_object.h"

namespace gpu_shading::energyplus {

// How EnergyPlus transforms a model's vertices: GlobalGeometryRules, Building and Zone. Angles in
// degrees clockwise from north, lengths in metres. Derived by comparison with the vertices that
// EnergyPlus passes (tests/energyplus/test_lean.py).
struct GeometryRules {
  struct Zone {
    double direction = 0.0;  // angle of its relative north from the building's
    glm::dvec3 origin{0.0};
  };

  int first_corner = 0;  // index of the first vertex as written, counted from the upper left corner
  bool clockwise = false;
  bool relative = false;  // if false: world coordinates, not rotated by building or zones
  double north_axis = 0.0;
  std::unordered_map<std::string, Zone> zones;  // upper-case names
};

// Throws Error, naming object, field and value, for invalid rules.
GeometryRules read_geometry_rules(std::vector<InputObject> const& objects);

// The vertices of a detailed surface, window or door as they are written; nothing if they are
// invalid.
std::optional<Ring> vertices_of(InputObject const& object);

// Coordinates, m, that single precision moves by 0.25 mm at most. Those beyond are taken from the
// model (FarOutlines).
inline constexpr double single_precision_reach = 8192.0;

// Vertices counterclockwise from the upper left corner, as EnergyPlus orders them.
Ring in_energyplus_order(GeometryRules const& rules, Ring vertices);

// EnergyPlus deletes vertices on the straight line between their neighbours: the limit of the sine
// of the angle there lies between these.
inline constexpr std::array straight_limits{1e-9, 1e-3};

// The vertices that EnergyPlus keeps: it deletes those within 1 cm of a neighbour, and those on a
// straight line. `straight`: the largest sine of the angle there.
Ring without_deleted(Ring ring, double straight);

// What a surface is attached to, which determines its rotation and translation.
enum class Attachment {
  site,      // nothing
  building,  // rotated by the building's north axis
  zone,      // placed in a zone
};

// A surface's outline in world axes: counterclockwise from the upper left corner, as EnergyPlus
// orders it.
struct Outline {
  // Every vertex that the model gives. Coordinates within single_precision_reach are rounded to the
  // single precision of the vertices that EnergyPlus passes, so that surfaces that touch a wall
  // still do.
  Ring vertices;
  // EnergyPlus deletes vertices that are within 1 cm of a neighbour while more than three are left.
  // (It also deletes vertices on the straight line between their neighbours, which changes no
  // shadow.)
  bool simplified = false;
  // Vertices within 1 cm of each other are left then: EnergyPlus calls such a surface degenerate.
  bool degenerate = false;
};

// `zone` is only used for Attachment::zone.
Outline to_world(GeometryRules const& rules, Ring vertices, Attachment attachment,
                 GeometryRules::Zone const& zone = {});

// GeometryTransform moves the vertices of a model in relative coordinates, but EnergyPlus
// keeps the previous areas, by which it divides sunlit areas, and in rotated zones the previous
// azimuths, from which it computes angles of incidence. A warning, or "" for models that are not
// affected.
std::string warn_of_transform(std::vector<InputObject> const& objects);

}  // namespace gpu_shading::energyplus
