#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <glm/vec3.hpp>
#include <ios>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "routes/patched/binary/symbol_table.h"

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

// EnergyPlus's Illums.
struct Illuminance;

// What a symbol of EnergyPlus serves. If a build lacks one of a need's symbols:
enum class Need {
  run,              // sunlit fractions are passed by another route
  from_25_1,        // before_25_1 serves instead
  before_25_1,      // from_25_1 serves instead
  constants,        // what an EMS or another program sets for a Schedule:Constant is ignored (25.1)
  eio_line,         // the .eio file has no lines on shading
  opaque_warning,   // EnergyPlus warns that pixel counting takes shades as opaque (before 24.2)
  sky_times,        // beam that reveals reflect is wrong where the sky follows schedules
  long_wave,        // nothing shades long-wave radiation where the sky follows shades that change
  sky_patches,      // --gpu-shading-sky perez-patches is an error
  below_ground,     // EnergyPlus warns that placeholders reach below the ground
  surface_ids,      // mirrored shading surfaces are taken as shaded
  run_days,         // the report has no days
  outputs,          // moving shades have no output variables
  reflected_light,  // EnergyPlus's own terms alone reflect light, and the report has beam alone
  daylight_rays,    // hidden casters dim no rays of daylighting
  daylight_memory   // EnergyPlus computes daylighting again where nothing has changed
};

// A function of EnergyPlus.
template <typename Signature>
struct Function {
  using Pointer = Signature*;

  char const* symbol;
  Need need;

  // nullptr if the build lacks it.
  Pointer in(SymbolTable const& symbols) const {
    auto const* const found = symbols.find(symbol);
    return found == nullptr ? nullptr : reinterpret_cast<Pointer>(found->address);
  }
};

// A class of EnergyPlus, by the symbol of its table of virtual functions.
struct Class {
  char const* symbol;
  Need need;

  // What the first word of each object points to; nullptr if the build lacks it.
  std::byte const* in(SymbolTable const& symbols) const {
    auto const* const found = symbols.find(symbol);
    // Two words come before the functions: an offset and the type's information (Itanium C++ ABI).
    return found == nullptr ? nullptr : found->address + 2 * sizeof(void*);
  }
};

namespace symbol {
#define FUNCTION(need, name, signature, symbol) \
  inline constexpr Function<signature> name{symbol, Need::need};
#define CLASS(need, name, symbol) inline constexpr Class name{symbol, Need::need};
#include "routes/patched/symbols/energyplus_symbols.inc"
#undef FUNCTION
#undef CLASS
}  // namespace symbol

// A pointer to a function of the table: its original, where it is redirected.
template <auto const& function>
using PointerTo = typename std::remove_cvref_t<decltype(function)>::Pointer;

// The table without its types.
struct SymbolRow {
  char const* symbol;
  Need need;
};
inline constexpr SymbolRow energyplus_symbols[] = {
#define FUNCTION(need, name, signature, symbol) {symbol, Need::need},
#define CLASS(need, name, symbol) {symbol, Need::need},
#include "routes/patched/symbols/energyplus_symbols.inc"
#undef FUNCTION
#undef CLASS
};

inline std::vector<std::string_view> energyplus_symbol_names() {
  std::vector<std::string_view> names;
  for (auto const& row : energyplus_symbols) names.emplace_back(row.symbol);
  return names;
}

// Whether the build has all symbols of a need.
inline bool has_all(SymbolTable const& symbols, Need need) {
  return std::all_of(std::begin(energyplus_symbols), std::end(energyplus_symbols), [&](auto& row) {
    return row.need != need || symbols.find(row.symbol) != nullptr;
  });
}

}  // namespace gpu_shading::energyplus
