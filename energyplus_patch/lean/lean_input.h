#pragma once

#include <string>
#include <vector>

#include "gpu_shading/scene.h"
#include "input/input_object.h"
#include "input/shading_input.h"
#include "lean/mentions.h"
#include "lean/placeholders.h"
#include "options/options.h"

namespace gpu_shading::energyplus {

// EnergyPlus works for minutes on thousands of shading surfaces whatever renders them. Those that
// it needs for their shadow alone are left out of the input that it reads, and handed to the
// renderer straight from the model.
struct LeanInput {
  Names left_out;                // Shading:...:Detailed objects
  std::vector<Surface> casters;  // the same, with the vertices that EnergyPlus would hand over
  std::vector<Placeholder> placeholders;
  std::string remark;  // for the user: what is left out, or why nothing is; "" says nothing

  bool active() const { return !left_out.empty(); }
  bool is_placeholder(std::string const& surface) const;
};

// With Lean::automatic only from this many surfaces on: each costs EnergyPlus some 5 ms of a year's
// run, what stands in for them about as much as this many. Small models run as they always did.
inline constexpr std::size_t fewest_left_out = 100;

// Surfaces stay that another object or an output names, or of which anything is not understood.
// Nothing is left out where the model needs the surfaces themselves: solar reflections,
// daylighting, complex fenestration, the external shading file, plugins; or where its
// geometry is changed in ways that are not followed here (GeometryTransform, Compliance:Building).
LeanInput plan_lean_input(std::vector<InputObject> const& objects, ShadingInput const& input,
                          Options const& options, MentionFinder const& find_mentions);

// Placeholders for casters that EnergyPlus never had, where nothing else has put them up.
void ensure_placeholders(LeanInput& lean, ShadingInput const& input);

}  // namespace gpu_shading::energyplus
