#pragma once

#include <array>
#include <functional>
#include <glm/vec3.hpp>
#include <optional>
#include <unordered_map>
#include <vector>

// EnergyPlus's own types, always passed by reference.
namespace EnergyPlus {
struct EnergyPlusData;
class InputOutputFile;
}  // namespace EnergyPlus
namespace Courierr {
class Courierr;
}

namespace gpu_shading::energyplus {

using State = EnergyPlus::EnergyPlusData;
using OtherFile = std::optional<std::reference_wrapper<EnergyPlus::InputOutputFile>>;
struct ScheduleObject;

// In place of Penumbra's Surface and Penumbra; defined by penumbra_entries.cpp.
struct SurfaceObject;
struct PenumbraObject;
using Coordinates = std::vector<float>;  // x, y, z of every vertex, one vertex after another
using InteriorAreas = std::unordered_map<unsigned, float>;

// EnergyPlus's Vector3<double>, with the same layout.
struct Vector {
  double x, y, z;

  bool operator==(Vector const&) const = default;
};

inline glm::dvec3 to_glm(Vector const& vector) { return {vector.x, vector.y, vector.z}; }

// EnergyPlus's Illums: what four skies, the sun's light without its disk, and its disk give.
struct Illuminance {
  std::array<double, 4> skies;
  double sun;
  double sun_disk;
};

}  // namespace gpu_shading::energyplus
