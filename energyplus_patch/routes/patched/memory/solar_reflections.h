#pragma once

#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "calculation/session.h"
#include "gpu_shading/rays.h"
#include "hidden/hidden_reflections.h"
#include "routes/patched/memory/reflection_memory.h"
#include "routes/patched/memory/reflection_results.h"
#include "routes/patched/symbols/energyplus_symbols.h"

namespace gpu_shading::energyplus {

// EnergyPlus's functions of solar reflections, called with what stands in their memory.
struct ReflectionFunctions {
  PointerTo<symbol::beam_diffuse> beam_diffuse = nullptr;
  PointerTo<symbol::beam_specular> beam_specular = nullptr;
  PointerTo<symbol::sky_diffuse> sky_diffuse = nullptr;
};

// Solar reflections of one run, with what EnergyPlus does not know. EnergyPlus's own functions
// still compute what its own surfaces and the ground reflect. They are called with rays that hidden
// casters stop left out, and with others weakened; what hidden casters reflect is added to their
// results, which are averages over the points of a receiving surface.
class SolarReflections {
 public:
  // The session must outlive this, and have hidden casters.
  SolarReflections(ReflectionMemory memory, Session& session, ReflectionFunctions const& original);

  // Each does what EnergyPlus's function does. They return false if its results are not found; they
  // are then EnergyPlus's own.
  bool beam_diffuse(State& state, int hour);
  bool beam_specular(State& state, int hour);
  bool sky_diffuse(State& state);

  ReflectionMemory const& memory() const { return memory_; }

  // Those of EnergyPlus's surfaces in which a window may see the sun's image.
  std::vector<SurfaceId> mirrors_of(std::int32_t window) const;
  // How far along the ray it meets one of them, m.
  std::optional<double> distance_to_mirror(SurfaceId mirror, Ray const& ray);

  // To the sun, at an hour's middle; nothing if it is not up.
  std::optional<glm::dvec3> sun(int hour) const;

 private:
  using Receiver = ReflectionMemory::Receiver;
  struct SpecularResults {
    double* factor = nullptr;
    double* cosine = nullptr;  // of incidence, average
  };
  // What a surface reflects as a mirror to a point.
  struct Image {
    std::size_t point;
    std::int32_t mirror;  // its number
    double passed;        // of the beam on its way, by hidden casters
  };

  HiddenReflections& hidden() const { return *session_.reflections(); }
  std::vector<ReflectionRay> rays() const;
  template <typename Visit>
  void for_each_ray(Visit const& visit) const;

  void weaken(std::vector<ReflectedShare> const& shares, Edits& edits) const;
  void add(std::vector<ReflectedShare> const& shares, DiffuseResults const& results,
           std::size_t offset) const;
  template <typename Call>
  void count(std::vector<ReflectedShare> const& shares, DiffuseResults const& results,
             std::size_t offset, Call const& call) const;

  std::vector<Image> images(Receiver const& receiver, glm::dvec3 const& to_sun, int hour);
  std::vector<bool> find_mirrors() const;
  bool is_mirror(std::int32_t number) const;
  RayScene const& mirror(SurfaceId surface);
  bool reflect_again(State& state, int hour, Receiver const& receiver, glm::dvec3 const& to_sun,
                     std::vector<Image> const& images);

  ReflectionMemory memory_;
  Session& session_;
  ReflectionFunctions original_;
  std::vector<bool> is_mirror_;  // by number
  std::optional<DiffuseResults> beam_;
  std::optional<DiffuseResults> sky_;
  std::optional<std::pair<double*, double*>> specular_pair_;
  std::optional<SpecularResults> specular_;
  std::map<SurfaceId, RayScene> mirrors_;
};

}  // namespace gpu_shading::energyplus
