#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "calculation/session.h"
#include "gpu_shading/scene.h"
#include "routes/patched/memory/surface_ids.h"
#include "routes/patched/symbols/energyplus_symbols.h"

namespace gpu_shading::energyplus {

// The classes of the objects that hold solar reflections, identified by their vtable pointers.
struct ReflectionClasses {
  // `symbols` must have those of Need::reflections.
  explicit ReflectionClasses(SymbolTable const& symbols)
      : manager(symbol::reflection_manager.in(symbols)),
        surfaces(symbol::surfaces_data.in(symbols)),
        receivers(symbol::receivers.in(symbols)),
        vectors(symbol::vectors.in(symbols)),
        numbers(symbol::numbers.in(symbols)),
        integers(symbol::integers.in(symbols)),
        vectors_2(symbol::vectors_2.in(symbols)),
        numbers_2(symbol::numbers_2.in(symbols)),
        integers_2(symbol::integers_2.in(symbols)) {}

  std::byte const* manager;    // SolarReflectionManagerData
  std::byte const* surfaces;   // SurfacesData
  std::byte const* receivers;  // Array1D<SolReflRecSurfData>
  // ObjexxFCL's arrays of vectors, numbers and integers, with one index and with two.
  std::byte const* vectors;
  std::byte const* numbers;
  std::byte const* integers;
  std::byte const* vectors_2;
  std::byte const* numbers_2;
  std::byte const* integers_2;
};

// Where EnergyPlus keeps its solar reflections (SolarReflectionManager). The memory is EnergyPlus's
// own and stays valid until it initializes reflections again. Numbers of surfaces count from 1.
//
// Nothing is taken from a table of offsets. Objects and arrays are found by the tables of virtual
// functions that they point to; then all values are checked: names of receiving surfaces against
// those that EnergyPlus handed over, rays against the surfaces' normals, hit points against rays
// and distances.
struct ReflectionMemory {
  // A surface that receives reflected solar radiation. Values by point and ray: [ray * points_of
  // arrays + point].
  struct Receiver {
    std::int32_t number = 0;
    SurfaceId surface = 0;
    glm::dvec3 normal{0.0};
    std::int32_t* point_count = nullptr;
    std::int32_t* ray_count = nullptr;
    glm::dvec3* points = nullptr;
    glm::dvec3* directions = nullptr;      // by ray, of unit length
    double* cosines = nullptr;             // by ray, with the normal
    double* solid_angles = nullptr;        // by ray, sr
    glm::dvec3* hits = nullptr;            // by ray and point, m
    std::int32_t* hit_numbers = nullptr;   // of a surface, 0: sky, -1: ground
    double* hit_reflectances = nullptr;    // 0 .. 1
    double* hit_distances = nullptr;       // m
    glm::dvec3* hit_normals = nullptr;     // towards the point
    std::int32_t* obstructions = nullptr;  // numbers of surfaces
    std::int32_t* obstruction_count = nullptr;
  };
  std::vector<Receiver> receivers;
  std::size_t row = 0;                        // points for which arrays by ray and point have room
  std::int32_t surfaces = 0;                  // all of EnergyPlus's
  std::array<glm::dvec3 const*, 24> suns{};   // direction to the sun by hour, 0 .. 23
  std::vector<std::optional<SurfaceId>> ids;  // by number, of surfaces that were handed over
  // Arrays of EnergyPlus's surfaces that may hold its results: by number, and by hour and number.
  std::vector<double*> by_surface;
  std::vector<double*> by_hour;

  std::size_t at(int hour, std::int32_t number) const {
    return static_cast<std::size_t>(hour - 1) * static_cast<std::size_t>(surfaces) +
           static_cast<std::size_t>(number - 1);
  }
};

// Nothing if anything is not as expected. `ids`: the path to EnergyPlus's array of surface ids.
std::optional<ReflectionMemory> find_reflection_memory(State& state, Session const& session,
                                                       StoredResult const& ids,
                                                       ReflectionClasses const& classes);

}  // namespace gpu_shading::energyplus
