#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <tuple>
#include <vector>

#include "calculation/session.h"
#include "routes/patched/memory/reflection_memory.h"
#include "routes/patched/symbols/energyplus_symbols.h"

namespace gpu_shading::energyplus {

// Of a bare window, and of one with its shade.
using Covers = std::array<Illuminance, 2>;

// The classes of the objects that hold daylighting, identified by their vtable pointers.
struct DaylightClasses {
  // `symbols` must have those of Need::daylight_reflections.
  explicit DaylightClasses(SymbolTable const& symbols)
      : daylighting(symbol::daylighting_data.in(symbols)),
        hours(symbol::illuminances_by_hour.in(symbols)) {}

  std::byte const* daylighting;  // DaylightingData
  std::byte const* hours;        // Array1D<std::array<Illums, 2>>
};

// How much light of the sky surfaces reflect, as EnergyPlus computes it for daylighting. It is
// measured: EnergyPlus's own function is called for one element of a window, with a ray that meets
// nothing but the surface. Nothing is taken from a table of offsets: arrays are found by the
// function's own results.
//
// A placeholder stands for hidden casters. What it reflects can be set.
class SurfaceLuminance {
 public:
  // EnergyPlus's moment, and a ray from a window, of unit length.
  struct Ray {
    State& state;
    int window;
    int hour;  // 1 .. 24; the sun is up
    glm::dvec3 direction;
    Illuminance const& horizontal;  // outdoors
  };

  // The answers that EnergyPlus gets while a surface is measured: that its ray meets the surface,
  // and that the surface's luminance by the sun is 1. With this second answer, a value in its
  // memory is to be set.
  struct Measured {
    std::int32_t number;
    double* at = nullptr;
    double value = 0.0;
  };

  // `measured`: set while a surface is measured. Memory and session must outlive this. Throws
  // Unexpected.
  SurfaceLuminance(Ray const& ray, ReflectionMemory const& memory, Session const& session,
                   DaylightClasses const& classes, PointerTo<symbol::window_element> function,
                   std::optional<Measured>& measured);

  // Luminance by the sky, cd/m2, over its illuminance on the horizontal, lux.
  double sky(Ray const& ray, std::int32_t number);

  // Schedules and shadows may have changed: another day.
  void renew() { known_.clear(); }

  std::int32_t placeholder() const { return placeholder_; }
  // Sets what sky() is of the placeholder.
  void set_placeholder(Ray const& ray, double sky);

  // EnergyPlus's sums over a window's elements: illuminance at the reference point, and luminance
  // of the window.
  Covers& direct(int hour) const { return direct_[hour - 1]; }
  Covers& window(int hour) const { return window_[hour - 1]; }

 private:
  std::vector<Covers> measure(Ray const& ray, Measured const& measured) const;
  void find_sums(Ray const& ray);
  double measure_sky(Ray const& ray, Measured const& measured) const;
  void find_reflectance(Ray const& ray);

  ReflectionMemory const& memory_;
  Session const& session_;
  PointerTo<symbol::window_element> function_;
  std::optional<Measured>& measured_;
  std::vector<Covers*> arrays_;  // by hour, all of this kind
  Covers* direct_ = nullptr;
  Covers* window_ = nullptr;
  std::size_t window_array_ = 0;
  std::int32_t placeholder_ = 0;
  double* reflectance_ = nullptr;  // of the placeholder
  // By surface, side and hour.
  std::map<std::tuple<std::int32_t, bool, int>, double> known_;
};

}  // namespace gpu_shading::energyplus
